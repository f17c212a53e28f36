// voussoir run, voussoir resume.
#include <fmt/format.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "tools/run/run_directory.h"
#include "tools/run/run_session.h"
#include "tools/voussoir/options.h"
#include "tools/voussoir/say_remarks.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

RunRequest request(const options::variables_map& values, const std::string& directory) {
  RunRequest r;
  r.directory = directory;
  r.threads = threads_asked(values);
  r.quiet = values.count("quiet") > 0;
  r.pictures = values.count("no-pictures") == 0;
  r.packing = packing_of(values["compression"].as<std::string>());
  if (values.count("until")) r.until = values["until"].as<double>();
  return r;
}

void add_run_options(CommandLine& line) {
  line.described.add_options()("until", real_option("until", 0.0, 1e9)->value_name("T"),
                               "stop at this simulated time (s), with a checkpoint")(
      "no-pictures", "leave out the pictures at the end")(
      "compression", options::value<std::string>()->value_name("WORD")->default_value("lz4"),
      "compression of the files for ParaView: lz4; zlib (for readers without LZ4, such as meshio; slower, smaller); "
      "none");
}

/// Printed at once, because large cases take a while to build.
void say_begun(const RunRequest& wanted, const std::string& from) {
  if (!wanted.quiet) fmt::print(stderr, "reading {}\n", from);
}

int run(const std::vector<std::string>& arguments) {
  CommandLine line("run", "run CASE [-o DIR] [--until T]", "voussoir run cases/demo.toml -o demo --threads 2");
  line.described.add_options()("output,o", options::value<std::string>()->value_name("DIR"),
                               "run directory (default: the case's name)")("overwrite",
                                                                           "remove an earlier run in that folder");
  add_run_options(line);
  line.positional = line.required = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string file = values["CASE"].as<std::string>();
  const std::string directory =
      values.count("output") ? values["output"].as<std::string>() : fs::path(file).stem().string();
  const RunRequest wanted = request(values, directory);
  say_begun(wanted, file);
  const Case c = read_case(file);
  if (!wanted.quiet && c.generator.empty() && !states_joints(c.assembly_file))
    fmt::print(stderr, "{} states no joints. The program finds them where faces meet.\n", c.assembly_file);
  const DirectoryLock lock = prepare_directory(c, directory, values.count("overwrite") > 0, remarks_to(wanted.quiet));
  return RunSession(wanted).run();
}

int resume(const std::vector<std::string>& arguments) {
  CommandLine line("resume", "resume DIR [--until T]", "voussoir resume demo --threads 8");
  add_run_options(line);
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string directory = values["DIR"].as<std::string>();
  std::error_code ignored;  // a path that cannot be examined is not a run directory
  if (!fs::exists(directory + "/case.toml", ignored))
    throw InputError("{} is not a run directory: it has no case.toml. Give the folder that voussoir run wrote",
                     directory);
  const RunRequest wanted = request(values, directory);
  say_begun(wanted, directory);
  const DirectoryLock lock(directory);
  RunSession session(wanted);
  session.resume();
  return session.run();
}

}  // namespace

Verb run_verb() {
  return {"run", "compute all stages of a case and write a run directory", run};
}
Verb resume_verb() {
  return {"resume", "continue a run from its newest good checkpoint", resume};
}

}  // namespace voussoir
