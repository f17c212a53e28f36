// The convergence studies: which specimens are computed with what varied, and how the errors are laid out.
#pragma once
#include <functional>

#include "tools/convergence/report.h"

namespace voussoir {

struct NamedStudy {
  std::string name, help;  // help: one line
  std::function<Study()> run;
};
Study study_of_dispersal();

/// In the order of docs/convergence.md. Seconds to minutes each, on one thread.
const std::vector<NamedStudy>& convergence_studies();

Study study_of_points();
Study study_of_stiffness();
Study study_of_steps();
Study study_of_rates();

}  // namespace voussoir
