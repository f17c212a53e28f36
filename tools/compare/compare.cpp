#include "tools/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "solver/base/atomic_file.h"
#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "viz/page/html.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

using Compare = Comparison (*)(const CompareRequest&, const std::vector<std::string>&);

struct Kind {
  const char *words, *file;  // file: a file that every folder of this kind has
  const char* ending;        // ending of a file that may be given in place of the folder; empty: none
  Compare compare;
};
constexpr Kind kinds[] = {{"a run", "summary.json", "", compare_runs},
                          {"a modal analysis", "modes.h5", ".h5", compare_modes},
                          {"a campaign", "table.csv", ".csv", compare_campaigns}};

const Kind& kind_of(const std::string& path) {
  std::error_code ignored;
  for (const Kind& kind : kinds)
    if (fs::exists(path + "/" + kind.file, ignored) ||
        (*kind.ending && fs::is_regular_file(path, ignored) && path.ends_with(kind.ending)))
      return kind;
  if (!fs::exists(path, ignored)) throw InputError("there is no file or folder {}", path);
  throw InputError(
      "{} holds no results to compare. Give folders of finished runs (summary.json), of voussoir modal (modes.h5) or "
      "of campaigns (table.csv)",
      path);
}

/// Short names that are all different: as many of the last parts of the paths as are needed.
std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<fs::path> whole;
  for (const std::string& path : paths) whole.push_back(fs::weakly_canonical(path));
  for (std::size_t parts = 1; parts < 20; ++parts) {
    std::vector<std::string> names;
    for (const fs::path& path : whole) {
      fs::path name = path.filename(), rest = path.parent_path();
      for (std::size_t k = 1; k < parts && rest.has_filename(); ++k, rest = rest.parent_path())
        name = rest.filename() / name;
      names.push_back(name.string());
    }
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
  }
  std::set<fs::path> seen;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (!seen.insert(whole[i]).second) throw InputError("the same result is given twice: {}", paths[i]);
  throw InputError("the folders {} have names that cannot be told apart. Rename one", fmt::join(paths, ", "));
}

double difference(const ComparedRow& row, std::size_t i) {
  return row.values[i] - row.values.front();
}

/// The change from the first result, %; NaN if the first value is zero.
double change(const ComparedRow& row, std::size_t i) {
  const double first = row.values.front();
  return first != 0.0 ? 100.0 * difference(row, i) / std::abs(first) : NAN;
}

bool all_equal(const ComparedRow& row) {
  return std::ranges::all_of(row.values, [&](double v) {
    return v == row.values.front() || std::abs(v - row.values.front()) <= 1e-9 * std::abs(row.values.front());
  });
}

std::string csv_of(const Comparison& c) {
  std::string text = "quantity,unit";
  for (const std::string& name : c.names) text += "," + csv_cell(name);
  for (std::size_t i = 1; i < c.names.size(); ++i)
    text += "," + csv_cell("difference of " + c.names[i]) + "," + csv_cell("change of " + c.names[i] + " (%)");
  text += "\n";
  const auto number = [](double v) { return std::isfinite(v) ? fmt::format(",{:.10g}", v) : std::string(","); };
  for (const ComparedRow& row : c.rows) {
    text += csv_cell(row.what) + "," + csv_cell(row.unit);
    for (const double value : row.values) text += number(value);
    for (std::size_t i = 1; i < c.names.size(); ++i) text += number(difference(row, i)) + number(change(row, i));
    text += "\n";
  }
  return text;
}

/// Decimals with which the largest value of a row has four significant digits; whole numbers have none.
int decimals_of(const ComparedRow& row) {
  double largest = 0.0;
  bool whole = true;
  for (const double value : row.values) {
    if (!std::isfinite(value)) continue;
    largest = std::max(largest, std::abs(value));
    whole = whole && value == std::round(value);
  }
  return whole ? 0 : std::clamp(3 - int(std::floor(std::log10(largest))), 0, 12);
}

/// `plus`: before a positive value.
std::string with_decimals(double value, int decimals, const char* plus) {
  if (!std::isfinite(value)) return "none";
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return (zero ? "" : value < 0.0 ? "−" : plus) + digits;
}

/// The unit that all rows have, or nothing.
std::string common_unit(const std::vector<ComparedRow>& rows) {
  const auto same = [&](const ComparedRow& row) { return row.unit == rows.front().unit; };
  return !rows.empty() && std::ranges::all_of(rows, same) ? rows.front().unit : "";
}

std::vector<Cell> head_cells(const std::vector<std::string>& names, const std::string& unit) {
  const std::string of = unit.empty() ? "" : ", " + unit;
  std::vector<Cell> head = {words_cell("quantity")};
  if (unit.empty()) head.push_back(words_cell("unit"));
  for (const std::string& name : names) head.push_back({words_cell(name + of).html, true});
  for (std::size_t i = 1; i < names.size(); ++i) {
    const std::string against = names.size() == 2 ? "" : names[i] + " − " + names[0];
    head.push_back({words_cell((against.empty() ? "difference" : against) + of).html, true});
    head.push_back({words_cell(names.size() == 2 ? "change, %" : "change of " + names[i] + ", %").html, true});
  }
  return head;
}

}  // namespace

std::string compared_text(const ComparedRow& row, double value) {
  return with_decimals(value, decimals_of(row), "");
}

std::string difference_table(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows) {
  const std::string unit = common_unit(rows);
  std::string text = table_row(head_cells(names, unit), "th"), same;
  for (const ComparedRow& row : rows) {
    if (all_equal(row)) {
      same += fmt::format("{}{} ({}{}{})", same.empty() ? "" : ", ", row.what, compared_text(row, row.values.front()),
                          row.unit.empty() ? "" : " ", row.unit);
      continue;
    }
    std::vector<Cell> cells = {words_cell(row.what)};
    if (unit.empty()) cells.push_back(words_cell(row.unit));
    for (const double value : row.values) cells.push_back({compared_text(row, value), true});
    for (std::size_t i = 1; i < names.size(); ++i) {
      cells.push_back({with_decimals(difference(row, i), decimals_of(row), "+"), true});
      cells.push_back({with_decimals(change(row, i), 1, "+"), true});
    }
    text += table_row(cells, "td");
  }
  return "<div class=\"wide\"><table>\n" + text + "</table></div>\n" +
         (same.empty() ? "" : note("The following are the same in all results: " + same + "."));
}

void compare_results(const CompareRequest& request) {
  if (request.from.size() < 2) throw InputError("only one result is given. A comparison needs at least two");
  const Kind& kind = kind_of(request.from.front());
  for (const std::string& path : request.from)
    if (const Kind& other = kind_of(path); &other != &kind)
      throw InputError("{} is {}, but {} is {}. Give results of one kind", request.from.front(), kind.words, path,
                       other.words);
  const std::vector<std::string> names = short_names(request.from);
  make_folder_of(request.directory + "/images/");
  Comparison c = kind.compare(request, names);
  c.names = names;
  write_atomically(request.directory + "/compare.csv", csv_of(c));
  write_atomically(request.directory + "/compare.html", html_page(c.title, c.html));
}

}  // namespace voussoir
