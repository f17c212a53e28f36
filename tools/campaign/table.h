// The table of a campaign. It has one row for each run, with its input, its ground motion and its results.
//
//   run,case,record,event,scale,sample,status,reason,seconds   texts, except scale and seconds
//   material.KEY                                               sampled value, in the unit of the case
//   im.NAME                                                    intensity of the scaled ground motion
//   edp.NAME                                                   demand of the structure
//   damage.COMPONENT.MEASURE                                   damage at the end
//
// Layout and units: docs/formats.md.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

enum class RunStatus {
  done,
  collapsed,  // ended because the bridge fell; exceeds every threshold, with or without numbers
  failed,     // no result
  missing     // not run yet
};
const char* run_status_name(RunStatus status);
/// The columns that every table has, in their order: run, case, … seconds.
const std::vector<std::string>& fixed_columns();

struct CampaignRun {
  std::string run, case_name, record, event, sample, reason;
  double scale = 1.0;    // scale of the record; NaN: not given
  double seconds = 0.0;  // s, computing time; NaN: not given
  RunStatus status = RunStatus::missing;
  int row = 0;  // row in the file, from 1
};

/// Whether the bridge has been computed, to the end or until it fell.
inline bool has_result(const CampaignRun& run) {
  return run.status == RunStatus::done || run.status == RunStatus::collapsed;
}

/// A column of numbers, one value for each run; NaN: no value.
struct NumberColumn {
  std::string name;
  std::vector<double> values;
};

struct CampaignTable {
  std::string path;  // for errors
  std::vector<CampaignRun> runs;
  std::vector<NumberColumn> columns;  // material.*, im.*, edp.*, damage.*, in the order of the file

  /// The column with this name, or null.
  const NumberColumn* find(std::string_view name) const;
  /// The column with this name. Throws InputError that names the existing columns.
  const NumberColumn& column(std::string_view name) const;
  /// Names of columns that begin with `prefix`, in the order of the file.
  std::vector<std::string> names(std::string_view prefix) const;
  /// Names of the cases in the order of their first occurrence.
  std::vector<std::string> cases() const;
};

/// Reads a table. UTF-8 with commas (or semicolons) between cells, quoted as in RFC 4180. Empty rows and rows that
/// begin with # are skipped. `run`, `case`, `record` and `status` are required; missing other texts are empty. Throws
/// InputError "FILE:ROW: …" with the column for an unknown column, an unknown status, a cell that is not a number, a
/// repeated run, a wrong number of cells and a table without rows.
CampaignTable parse_table(const std::string& text, const std::string& path);
CampaignTable read_table(const std::string& path);

/// The table as text. parse_table() returns the same table bit for bit, except that line breaks in texts become blanks
/// and infinite numbers become NaN.
std::string table_text(const CampaignTable& table);
/// Writes the table atomically into an existing folder.
void write_table(const std::string& path, const CampaignTable& table);

}  // namespace voussoir
