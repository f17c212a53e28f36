// A case to begin with: all keys of the generator `bridge` with their defaults and meanings.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct CaseTemplate {
  std::vector<double> clear_spans = {8.0, 10.0, 8.0};  // m, from left to right
  std::string shape = "segmental";                     // of all vaults
  double width = 0.0;                                  // m; 0: the generator's default
};

/// The text of a case that can be run without changes. Keys, defaults, ranges and words come from the tables of the
/// generator. Throws InputError for no spans or too many, for lengths beyond their range, and for the shape "surveyed",
/// which needs an intrados.
std::string case_template(const CaseTemplate& wanted);

}  // namespace voussoir
