// [[check]]: expected results of a case. A case with checks is a rung of the validation ladder.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

class TableReader;

struct Check {
  std::string quantity;  // in words
  std::string value;     // its place in summary.json: "collapse.multiplier"
  std::string unit = "-";
  std::string source;  // origin of the expected value
  double expected = 0.0;
  double tolerance = 0.0;  // share of the expected value, or in its unit
  bool absolute = false;   // the tolerance is in the value's unit
  bool slow = false;       // only in the long ladder
  std::string miss;        // reason why it is known to be outside its tolerance; empty: no known miss
  std::string text;        // the case (TOML) that is run for it: that of the file, with `set` of the check merged in
};

/// The checks of a case file, in order. Throws InputError "FILE:LINE: …".
std::vector<Check> read_checks(const std::string& path);

/// The same for a table that is already parsed, without the texts of the cases; marks the key as known.
std::vector<Check> read_checks(TableReader& root);

}  // namespace voussoir
