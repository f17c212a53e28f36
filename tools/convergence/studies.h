// The convergence studies: their specimens, the varied quantities, and the layout of the errors.
#pragma once
#include <functional>

#include "tools/convergence/report.h"

namespace voussoir {

struct NamedStudy {
  std::string name, help;  // help: one line
  std::function<Study()> run;
};
Study study_of_dispersal();

/// All studies in the order of docs/convergence.md. Each takes seconds to minutes on one thread.
const std::vector<NamedStudy>& convergence_studies();

Study study_of_points();
Study study_of_stiffness();
Study study_of_steps();
Study study_of_rates();

}  // namespace voussoir
