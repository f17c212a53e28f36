#include "tools/compare/compare.h"

#include <fmt/format.h>

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
  throw InputError("the same result is given twice: {}", paths.front());
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

Cell number(double value) {
  return formatted_cell(value, "{:.4g}");
}

Cell signed_number(double value, const char* format) {
  return std::isfinite(value) ? Cell{fmt::format(fmt::runtime(format), value), true} : Cell{"–", true};
}

}  // namespace

std::string difference_table(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows) {
  std::vector<Cell> head = {words_cell("quantity"), words_cell("unit")};
  for (const std::string& name : names) head.push_back({words_cell(name).html, true});
  for (std::size_t i = 1; i < names.size(); ++i)
    head.push_back({words_cell(names.size() == 2 ? "difference" : names[i] + " − " + names[0]).html, true}),
        head.push_back({"%", true});
  std::string text = table_row(head, "th"), same;
  for (const ComparedRow& row : rows) {
    if (all_equal(row)) {
      same += fmt::format("{}{} ({:.4g}{}{})", same.empty() ? "" : ", ", row.what, row.values.front(),
                          row.unit.empty() ? "" : " ", row.unit);
      continue;
    }
    std::vector<Cell> cells = {words_cell(row.what), words_cell(row.unit)};
    for (const double value : row.values) cells.push_back(number(value));
    for (std::size_t i = 1; i < names.size(); ++i)
      cells.push_back(signed_number(difference(row, i), "{:+.4g}")),
          cells.push_back(signed_number(change(row, i), "{:+.1f}"));
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
