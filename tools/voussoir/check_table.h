// The results of `voussoir check` as text, Markdown and JSON.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/ladder/rung.h"

namespace voussoir {

struct CheckRow {
  std::string rung;
  ladder::Finding finding;
  std::string trouble;  // why there is no value; empty if there is one
  bool pass() const { return trouble.empty() && finding.within(); }
  /// Outside its tolerance, and recorded as a known miss. False for a quantity without a value.
  bool known_miss() const { return trouble.empty() && !finding.within() && !finding.check.miss.empty(); }
};

void print_check_heading();
/// Prints one line. Below it, it prints the reason why there is no value or why the value is outside its tolerance, or
/// a note that a known miss is within its tolerance.
void print_check_row(const CheckRow& row);
/// "31 of 33 quantities within their tolerance, 2 known misses".
std::string check_count(const std::vector<CheckRow>& rows);
/// The list in check.json (docs/formats.md).
nlohmann::json check_json(const std::vector<CheckRow>& rows);
/// A Markdown table below a line with the date (local time) and the commit of the source tree `sources`. If git reports
/// no commit, the line has the version of the program.
std::string check_markdown(const std::vector<CheckRow>& rows, const std::string& sources);

}  // namespace voussoir
