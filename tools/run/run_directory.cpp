#include "tools/run/run_directory.h"

#include <algorithm>
#include <filesystem>

#include "io/case/remarks.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/run/simulation.h"
#include "tools/run/history_rows.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// Throws InputError for a plot of a channel that the run does not record.
void check_plots(const Case& c, const std::vector<Channel>& channels) {
  std::vector<std::string> known;
  for (const Channel& channel : channels) known.push_back(channel.path);
  for (const PlotSpec& plot : c.plots)
    for (const std::string& name : {plot.x, plot.y})
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError("plot '{}' shows '{}', which this run does not record{}", plot.name, name,
                         suggestion(name, known));
}

/// Removes the files that a run, its pages and its modes write in their directory, and no others.
void remove_run(const fs::path& directory) {
  std::vector<std::string> names = {
      "case.toml",    "assembly.h5", "history.h5", "checkpoints",        "vtk",   "images",       "summary.json",
      "run.log",      "report.html", "view.html",  "collapse_curve.csv", "modes", "gravity.json", "joints.csv",
      "stresses.csv", "steps.csv",   "cracks.csv", "report.pdf"};
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, failed))
    if (is_copy_for_case(entry.path().filename().string())) names.push_back(entry.path().filename().string());
  for (const std::string& name : names)
    if (fs::remove_all(directory / name, failed); failed)
      throw RunError("cannot remove {}: {}. Choose another folder with -o DIR", (directory / name).string(),
                     failed.message());
}

}  // namespace

DirectoryLock prepare_directory(const Case& c, const std::string& directory, bool overwrite,
                                const std::function<void(const std::string&)>& remark) {
  std::error_code failed;  // a path that cannot be examined is not a run directory
  if (fs::exists(directory + "/case.toml", failed) && !overwrite)
    throw InputError(
        "{} already holds a run. Continue it (voussoir resume {}), choose another folder (-o DIR), or give --overwrite",
        directory, directory);
  // Read and check everything before the folder is emptied, because input files may be in it.
  const Assembly assembly = make_assembly(c);
  if (remark)
    for (const std::string& text : remarks(c, assembly)) remark(text);
  try {
    Simulation run(assembly, c.settings, 1, {});
    run.check();
    check_plots(c, history_channels(run));
  } catch (const InputError& error) {
    throw InputError("{}: {}", c.path, error.what());
  }
  fs::create_directories(directory, failed);
  if (failed)
    throw InputError("cannot make the folder {}: {}. Choose another one with -o DIR", directory, failed.message());
  DirectoryLock lock(directory);
  if (overwrite) remove_run(directory);
  write_assembly(directory + "/assembly.h5", assembly);
  write_resolved_case(c, directory);
  return lock;
}

}  // namespace voussoir
