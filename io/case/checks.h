// [[check]]: what a case should give. A case with checks is a rung of the validation ladder.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

class TableReader;

struct Check {
  std::string quantity;  // in words
  std::string value;     // where it stands in summary.json: "collapse.multiplier"
  std::string unit = "-";
  std::string source;  // of the expected value
  double expected = 0.0;
  double tolerance = 0.0;  // share of the expected value, or in its unit
  bool absolute = false;   // the tolerance is in the value's unit
  bool slow = false;       // only in the long ladder
  std::string miss;        // why it is known to be outside its tolerance; empty: it should be within
  std::string text;        // the case (TOML) that is run for it: the file's, with the check's `set` merged in
};

/// The checks of a case file, in order. Throws InputError "FILE:LINE: …".
std::vector<Check> read_checks(const std::string& path);

/// The same of a table already parsed, without their case texts; marks the key as known.
std::vector<Check> read_checks(TableReader& root);

}  // namespace voussoir
