// voussoir run, voussoir resume.
#include <fmt/format.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "tools/voussoir/directory_lock.h"
#include "tools/voussoir/run_session.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

RunRequest request(const options::variables_map& values, const std::string& directory) {
  RunRequest r;
  r.directory = directory;
  r.threads = threads_asked(values);
  r.quiet = values.count("quiet") > 0;
  r.pictures = values.count("no-pictures") == 0;
  if (values.count("until")) {
    r.until = values["until"].as<double>();
    if (!(r.until >= 0.0)) throw InputError("--until is {}; give a time of 0 s or more", r.until);
  }
  return r;
}

void add_run_options(CommandLine& line) {
  line.described.add_options()("until", options::value<double>()->value_name("T"),
                               "stop at this simulated time (s), with a checkpoint")(
      "no-pictures", "leave out the pictures at the end");
}

/// Said before the first second is over: large cases take longer to build.
void say_begun(const RunRequest& wanted, const std::string& from) {
  if (!wanted.quiet) fmt::print(stderr, "reading {}\n", from);
}

/// A fresh run directory with the resolved case and the assembly. An existing run is never overwritten unasked.
DirectoryLock prepare_directory(const Case& c, const std::string& directory, bool overwrite) {
  std::error_code failed;  // a name that cannot be looked up names no run
  if (fs::exists(directory + "/case.toml", failed) && !overwrite)
    throw InputError(
        "{} already holds a run; go on with it (voussoir resume {}), choose another folder (-o DIR), or give "
        "--overwrite",
        directory, directory);
  // First all that can go wrong and all that is read: it may lie in the folder that is to be emptied.
  const Assembly assembly = make_assembly(c);
  try {
    Simulation(assembly, c.settings, 1, {}).check();
  } catch (const InputError& error) {
    throw InputError("{}: {}", c.path, error.what());
  }
  fs::create_directories(directory, failed);
  if (failed)
    throw InputError("cannot make the folder {}: {}; choose another with -o DIR", directory, failed.message());
  DirectoryLock lock(directory);
  if (overwrite)
    for (const char* old :
         {"case.toml", "assembly.h5", "history.h5", "checkpoints", "vtk", "images", "summary.json", "run.log"})
      if (fs::remove_all(fs::path(directory) / old, failed); failed)
        throw RunError("cannot remove {}/{}: {}; choose another folder with -o DIR", directory, old, failed.message());
  write_assembly(directory + "/assembly.h5", assembly);
  write_resolved_case(c, directory);
  return lock;
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
  const DirectoryLock lock = prepare_directory(c, directory, values.count("overwrite") > 0);
  return RunSession(wanted).run();
}

int resume(const std::vector<std::string>& arguments) {
  CommandLine line("resume", "resume DIR [--until T]", "voussoir resume demo --threads 8");
  add_run_options(line);
  line.positional = line.required = {"DIR"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const std::string directory = values["DIR"].as<std::string>();
  std::error_code ignored;  // a name that cannot be looked up names no run
  if (!fs::exists(directory + "/case.toml", ignored))
    throw InputError("{} is no run directory: it has no case.toml; give the folder that voussoir run wrote", directory);
  const RunRequest wanted = request(values, directory);
  say_begun(wanted, directory);
  const DirectoryLock lock(directory);
  RunSession session(wanted);
  session.resume();
  return session.run();
}

}  // namespace

Verb run_verb() {
  return {"run", "all stages of a case: equilibrium, motion, free vibration", run};
}
Verb resume_verb() {
  return {"resume", "goes on with a run from its newest good checkpoint", resume};
}

}  // namespace voussoir
