#include "tools/voussoir/check_table.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "solver/base/counted.h"

namespace voussoir {

namespace {

constexpr const char* layout = "{:<18} {:<44} {:>10} {:>10} {:<6} {:>10} {:>8}  {:<6}  {}\n";

std::string number_text(double value) {
  return fmt::format("{:.5g}", value);
}

std::string got_text(const CheckRow& row) {
  return row.trouble.empty() ? number_text(row.finding.got) : "none";
}

std::string error_text(const CheckRow& row) {
  if (!row.trouble.empty()) return "none";
  const double error = row.finding.error();
  return row.finding.check.absolute ? fmt::format("{:+.2g}", error) : fmt::format("{:+.2g} %", 100.0 * error);
}

std::string tolerance_text(const Check& check) {
  return check.absolute ? fmt::format("{:.3g}", check.tolerance) : fmt::format("{:.3g} %", 100.0 * check.tolerance);
}

/// The verdict of a row: a known miss is in lower case.
const char* verdict(const CheckRow& row) {
  return row.pass() ? "ok" : row.known_miss() ? "miss" : "MISS";
}

/// The commit of a folder, from git; empty if there is none. "-dirty" is appended if a tracked file was changed.
std::string commit_of(const std::string& folder) {
  std::string quoted;
  for (char c : folder) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  const std::string command = "git -C '" + quoted + "' describe --always --dirty --exclude '*' 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  char buffer[128] = {};
  std::string said = std::fgets(buffer, sizeof buffer, pipe) ? buffer : "";
  const bool failed = pclose(pipe) != 0;
  said.erase(std::find(said.begin(), said.end(), '\n'), said.end());
  return failed ? "" : said;
}

/// Text with escaped bars, because a bar ends a column in Markdown.
std::string cell(const std::string& text) {
  std::string safe;
  for (char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "-" || number == "none" ? number : number + " " + unit;
}

std::string markdown_row(const CheckRow& row) {
  const Check& c = row.finding.check;
  std::string result = verdict(row);
  if (row.known_miss()) result += ": " + c.miss;
  if (!row.trouble.empty()) result += ": " + row.trouble;
  std::replace(result.begin(), result.end(), '\n', ' ');
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", row.rung, cell(c.quantity), number_text(c.expected),
                     cell(with_unit(got_text(row), c.unit)), error_text(row), tolerance_text(c), cell(result),
                     cell(c.source));
}

}  // namespace

void print_check_heading() {
  fmt::print(layout, "rung", "quantity", "expected", "got", "unit", "error", "allowed", "", "source");
}

void print_check_row(const CheckRow& row) {
  const Check& c = row.finding.check;
  fmt::print(layout, row.rung, c.quantity, number_text(c.expected), got_text(row), c.unit, error_text(row),
             tolerance_text(c), verdict(row), c.source);
  if (!row.trouble.empty()) fmt::print("  {}\n", row.trouble);
  if (row.known_miss()) fmt::print("  known miss: {}\n", c.miss);
  if (row.pass() && !c.miss.empty())
    fmt::print("  This known miss is within its tolerance now. Remove its `miss` (\"{}\")\n", c.miss);
  std::fflush(stdout);
}

std::string check_count(const std::vector<CheckRow>& rows) {
  const auto good = std::count_if(rows.begin(), rows.end(), [](const CheckRow& row) { return row.pass(); });
  const auto known = std::count_if(rows.begin(), rows.end(), [](const CheckRow& row) { return row.known_miss(); });
  std::string text =
      fmt::format("{} of {} within their tolerance", good, counted(rows.size(), "quantity", "quantities"));
  if (known > 0) text += ", " + counted(known, "known miss", "known misses");
  return text;
}

nlohmann::json check_json(const std::vector<CheckRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const CheckRow& row : rows) {
    const Check& c = row.finding.check;
    const bool valued = row.trouble.empty();
    list.push_back({{"name", row.rung},
                    {"quantity", c.quantity},
                    {"unit", c.unit},
                    {"expected", c.expected},
                    {"got", valued ? nlohmann::json(row.finding.got) : nlohmann::json()},
                    {"error", valued ? nlohmann::json(row.finding.error()) : nlohmann::json(row.trouble)},
                    {"tolerance", c.tolerance},
                    {"absolute", c.absolute},
                    {"source", c.source},
                    {"known_miss", c.miss.empty() ? nlohmann::json() : nlohmann::json(c.miss)},
                    {"pass", row.pass()}});
  }
  return list;
}

std::string check_markdown(const std::vector<CheckRow>& rows, const std::string& sources) {
  const std::string commit = commit_of(sources);
  std::string text =
      fmt::format("Printed by `voussoir check` on {:%Y-%m-%d}, {}: {}.\n\n", fmt::localtime(std::time(nullptr)),
                  commit.empty() ? "version " VOUSSOIR_VERSION : "commit " + commit, check_count(rows));
  text += "| rung | quantity | expected | got | error | tolerance | result | source |\n";
  text += "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const CheckRow& row : rows) text += markdown_row(row);
  return text;
}

}  // namespace voussoir
