// A checkpoint of a run, with the case and the assembly that it belongs to.
#pragma once
#include <string>

#include "io/case/case.h"
#include "io/hdf5/checkpoint_file.h"
#include "solver/model/state.h"

namespace voussoir {

struct StoredState {
  std::string run;  // its directory
  Case c;
  Assembly assembly;
  Model model;
  State state;
  CheckpointHeader header;
};

/// Whether a file lies in the checkpoints folder of a run directory.
bool is_checkpoint_of_run(const std::string& file);

/// The state as it was stored. Throws InputError when the file is an assembly, lies elsewhere than in the checkpoints
/// folder of a run directory, is damaged, or belongs to another assembly.
StoredState read_stored_state(const std::string& checkpoint);

/// The newest readable checkpoint of a run directory. Throws InputError, which ends with `remedy`, when there is none.
std::string newest_checkpoint(const std::string& directory, const std::string& remedy = "run it first");

}  // namespace voussoir
