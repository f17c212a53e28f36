#include "tools/run/stored_state.h"

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "solver/base/error.h"
#include "solver/contact/grouping.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

std::string run_of(const std::string& checkpoint) {
  return fs::weakly_canonical(checkpoint).parent_path().parent_path().string();
}

}  // namespace

bool is_checkpoint_of_run(const std::string& file) {
  std::error_code ignored;
  return fs::weakly_canonical(file).parent_path().filename() == "checkpoints" &&
         fs::exists(run_of(file) + "/case.toml", ignored);
}

StoredState read_stored_state(const std::string& checkpoint) {
  const std::string run = run_of(checkpoint);
  const h5::File h5 = h5::File::open(checkpoint);
  if (h5.has_attribute("/", "format") && h5.text("/", "format") == "voussoir-assembly")
    throw InputError("{} is a block assembly. Name it in a case ([bridge] assembly = \"{}\") and give the case",
                     checkpoint, checkpoint);
  if (!fs::exists(run + "/case.toml") || !fs::exists(run + "/assembly.h5"))
    throw InputError(
        "{} is not in the checkpoints folder of a run directory. The folder above it must hold case.toml and "
        "assembly.h5",
        checkpoint);
  StoredState stored;
  stored.run = run;
  stored.c = read_case(run + "/case.toml", CaseUse::geometry);
  stored.assembly = read_assembly(run + "/assembly.h5");
  stored.model = build_model(stored.assembly, stored.c.settings);
  stored.state = initial_state(stored.model);
  try {
    read_checkpoint(checkpoint, stored.header, stored.state.arrays());
  } catch (const RunError& error) {  // for a reader of results, a damaged checkpoint is wrong input
    throw InputError("{}", error.what());
  }
  if (stored.header.assembly_hash != assembly_hash(stored.assembly))
    throw InputError("{} belongs to another assembly than {}/assembly.h5", checkpoint, run);
  stored.state.unpack(stored.model);
  take_joint_order(stored.model, stored.state);
  return stored;
}

std::string newest_checkpoint(const std::string& directory, const std::string& remedy) {
  const std::vector<std::string> all = list_checkpoints(directory + "/checkpoints");
  if (all.empty()) throw InputError("{} has no checkpoints. {}", directory, remedy);
  return all.front();
}

}  // namespace voussoir
