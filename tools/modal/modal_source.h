// The input of an eigenvalue analysis: a case, a run directory or a checkpoint.
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
  bool damaged = false;                   // the state is that of a run, to be compared with the intact assembly
  std::optional<Array<double>> wrenches;  // forces and moments of the joints, for the geometric stiffness
  Loads loads;                            // constant loads that act in the state; none for intact joints of a case
  std::string name;                       // name of the case file or of the run directory
  std::string about;                      // "cs1-r.toml, all joints intact"
};

/// Loads `from`, and finds the equilibrium under gravity if the settings ask for it. A state of a run is brought to
/// rest and keeps its damage, unless `as_stored` is true. `modal` overrides the settings of the case. Throws
/// InputError, RunError.
ModalSource modal_source(const std::string& from, const std::function<void(ModalSettings&)>& modal, bool as_stored,
                         int threads, bool quiet);
/// The same of a case that has been read. Throws InputError, RunError.
ModalSource modal_source(const Case& c, const std::function<void(ModalSettings&)>& modal, int threads, bool quiet);

}  // namespace voussoir
