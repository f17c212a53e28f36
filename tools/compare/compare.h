// Comparison of results: runs, modal analyses or campaigns on one page, with a table of their differences.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// One quantity, with its value in each result.
struct ComparedRow {
  std::string what, unit;      // "largest opening of masonry", "mm"
  std::vector<double> values;  // value in each result, in the unit; NaN: the result has none
};

/// The sections of a page, and the rows of its table.
struct Comparison {
  std::vector<std::string> names;  // names of the results, all different
  std::string title, html;
  std::vector<ComparedRow> rows;
};

struct CompareRequest {
  std::vector<std::string> from;  // folders or files, at least two; all are compared with the first
  std::string directory;          // folder to write to
  bool pictures = true;
};

/// Compares runs (folders with a summary.json), modal analyses (folders with a modes.h5, or such files) or campaigns
/// (folders with a table.csv, or such tables). Writes DIRECTORY/compare.html, compare.csv and pictures. Throws
/// InputError if a path is none of these, or if the results are of different kinds.
void compare_results(const CompareRequest& request);

// The comparison of each kind. The caller sets the member `names` of the result.
Comparison compare_runs(const CompareRequest& request, const std::vector<std::string>& names);
Comparison compare_modes(const CompareRequest& request, const std::vector<std::string>& names);
Comparison compare_campaigns(const CompareRequest& request, const std::vector<std::string>& names);

/// A value with as many decimals as all values of its row have: four significant digits of the largest one.
std::string compared_text(const ComparedRow& row, double value);

/// An HTML table of the rows: the values, and for all results but the first the difference from the first, also in per
/// cent. The unit stands in the heads of the columns if all rows have the same one. Quantities that are the same in all
/// results are named below the table.
std::string difference_table(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows);

}  // namespace voussoir
