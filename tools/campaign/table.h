// The table of a campaign, one row a run: what was run, what shook it, what came of it.
//
//   run,case,record,event,scale,sample,status,reason,seconds   texts, but for scale and seconds
//   material.KEY                                               what was sampled, in the unit of the case
//   im.NAME                                                    intensity of the scaled ground motion
//   edp.NAME                                                   demand of the structure
//   damage.COMPONENT.MEASURE                                   damage in the end
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
  collapsed,  // ended because the bridge fell: beyond every threshold, with or without numbers
  failed,     // no result
  missing     // not run yet
};
const char* run_status_name(RunStatus status);
/// run, case, … seconds: those that every table has, in their order.
const std::vector<std::string>& fixed_columns();

struct CampaignRun {
  std::string run, case_name, record, event, sample, reason;
  double scale = 1.0;    // of the record; NaN: not said
  double seconds = 0.0;  // of computing; NaN: not said
  RunStatus status = RunStatus::missing;
  int row = 0;  // in the file, from 1
};

/// A column of numbers, a value a run; NaN: none.
struct NumberColumn {
  std::string name;
  std::vector<double> values;
};

struct CampaignTable {
  std::string path;  // for errors
  std::vector<CampaignRun> runs;
  std::vector<NumberColumn> columns;  // im.*, edp.*, damage.*, in the file's order

  /// Null where there is none.
  const NumberColumn* find(std::string_view name) const;
  /// Throws InputError naming what columns there are.
  const NumberColumn& column(std::string_view name) const;
  /// Names that begin so, in the file's order.
  std::vector<std::string> names(std::string_view prefix) const;
  /// In the order in which they first appear.
  std::vector<std::string> cases() const;
};

/// Reads a table. UTF-8 with commas (or semicolons) between cells, quoted as RFC 4180 has it; empty rows and those that
/// begin with # are skipped. `run`, `case`, `record` and `status` must be there; of the other texts those that are
/// missing are empty. Throws InputError "FILE:ROW: …" with the column for a column nobody knows, a word that is no
/// status, a number that is none, a run twice, a wrong number of cells and a table without rows.
CampaignTable parse_table(const std::string& text, const std::string& path);
CampaignTable read_table(const std::string& path);

/// What parse_table() gives back bit for bit, but for line breaks in texts, which become blanks.
std::string table_text(const CampaignTable& table);
/// Atomically, into a folder that is there.
void write_table(const std::string& path, const CampaignTable& table);

}  // namespace voussoir
