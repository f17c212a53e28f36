// What an eigenvalue analysis starts from: a case, a run directory or a checkpoint.
#pragma once
#include <optional>

#include "io/case/case.h"
#include "solver/modal/modes.h"

namespace voussoir {

struct ModalSource {
  Case c;
  Assembly assembly;
  Model model;
  State state;
  PatchTangent tangent = PatchTangent::intact;
  bool damaged = false;                   // from a run: to be compared with the intact assembly
  std::optional<Array<double>> wrenches;  // of the joints, for geometric stiffness
  Loads loads;                            // dead ones, of a run's stage
  std::string name;                       // of the case file, or of the run directory
  std::string about;                      // "cs1-r.toml, intact joints"
};

/// Loads `from` and finds equilibrium where the settings ask for it; a state of a run is brought to rest with its
/// damage kept, unless it is wanted `as_stored`. `modal` overrides what the case says. Throws InputError, RunError.
ModalSource modal_source(const std::string& from, const std::function<void(ModalSettings&)>& modal, bool as_stored,
                         int threads, bool quiet);
/// The same of a case that has been read. Throws InputError, RunError.
ModalSource modal_source(const Case& c, const std::function<void(ModalSettings&)>& modal, int threads, bool quiet);

}  // namespace voussoir
