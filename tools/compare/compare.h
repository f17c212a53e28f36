// Results side by side: runs, modal analyses or campaigns on one page, with their differences as a table.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// One number of several results.
struct ComparedRow {
  std::string what, unit;      // "largest opening of masonry", "mm"
  std::vector<double> values;  // of each result, in the unit; NaN: it has none
};

/// The sections of a page and the rows behind it.
struct Comparison {
  std::vector<std::string> names;  // of the results; no two alike
  std::string title, html;
  std::vector<ComparedRow> rows;
};

struct CompareRequest {
  std::vector<std::string> from;  // folders or files, two at least; the first is what the others are compared with
  std::string directory;          // to write to
  bool pictures = true;
};

/// Runs (folders with a summary.json), modal analyses (folders with a modes.h5, or such files) or campaigns (folders
/// with a table.csv, or such tables), all of one kind. Writes DIRECTORY/compare.html, compare.csv and pictures. Throws
/// InputError for results of different kinds, or of none.
void compare_results(const CompareRequest& request);

// Of each kind; `names` are set by the caller.
Comparison compare_runs(const CompareRequest& request, const std::vector<std::string>& names);
Comparison compare_modes(const CompareRequest& request, const std::vector<std::string>& names);
Comparison compare_campaigns(const CompareRequest& request, const std::vector<std::string>& names);

/// A table of the rows: values, and of all but the first result the difference from it and that in per cent. What is
/// the same in all is named below.
std::string difference_table(const std::vector<std::string>& names, const std::vector<ComparedRow>& rows);

}  // namespace voussoir
