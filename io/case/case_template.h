// A case to begin with: all keys of the generator `bridge` with their defaults and what they mean.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct CaseTemplate {
  std::vector<double> clear_spans = {8.0, 10.0, 8.0};  // m, from left to right
  std::string shape = "segmental";                     // of all vaults
  double width = 0.0;                                  // m; 0: the generator's default
};

/// The text of a case that can be run as it stands. Keys, defaults, ranges and words come from the generator's own
/// tables. Throws InputError for no spans or too many, for lengths beyond their range, and for a shape that needs more
/// than a span.
std::string case_template(const CaseTemplate& wanted);

}  // namespace voussoir
