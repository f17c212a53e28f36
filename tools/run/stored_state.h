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

/// Whether a file is in the checkpoints folder of a run directory.
bool is_checkpoint_of_run(const std::string& file);

/// Reads a checkpoint. Throws InputError if the file is an assembly, is not in the checkpoints folder of a run
/// directory, is damaged, or belongs to another assembly.
StoredState read_stored_state(const std::string& checkpoint);

/// Path of the newest checkpoint of a run directory, which is not opened and may be damaged. If there is none, throws
/// InputError, whose text ends with `remedy`.
std::string newest_checkpoint(const std::string& directory, const std::string& remedy = "Run the case first");

}  // namespace voussoir
