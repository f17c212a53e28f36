// The plan of a campaign: its runs, their order, their names and their input.
#pragma once
#include <optional>

#include "tools/campaign/settings.h"

namespace voussoir::campaign {

struct PlannedCase {
  std::string name, slug;  // name in the table; name of its folder in cases/
  std::uint64_t hash = 0;  // of the contents of the case
};

struct PlannedRecord {
  std::string name, event, slug;
  std::uint64_t hash = 0;
  double duration = 0.0;         // s, duration of the run
  std::vector<double> measures;  // at scale 1, of the part that is run; see measures.h; NaN if not defined
};

struct PlannedRun {
  std::string id;  // [A-Za-z0-9._-]; also the name of its folder in runs/
  std::size_t case_number = 0, record = 0;
  double scale = 1.0;          // multiplies the factor of the record
  int sample = 0;              // number of the sample, from 1; 0: nothing is sampled
  std::vector<double> values;  // values of Plan::keys
  std::uint64_t hash = 0;      // of all input that its result depends on
};

struct Plan {
  std::string file;  // name of the campaign file, without its folder
  std::vector<PlannedCase> cases;
  std::vector<PlannedRecord> records;
  std::vector<PlannedRun> runs;
  std::vector<std::string> keys;  // sampled keys
  std::vector<double> periods;    // s
  RunSettings run;
  std::vector<PlannedLimit> limit_states;
  EngineSettings engine;
  std::vector<std::string> left_out;  // reasons why files of a folder of records are not used, each once
};

/// A plan, and the cases and records of its folder.
struct Draft {
  Plan plan;
  std::vector<Case> cases;  // as read
  std::vector<Shaking> records;
  std::string text;  // contents of the campaign file
};

/// The plan with the runs cases × records × scales × samples, in this order. It checks everything that does not need
/// the blocks. Throws InputError.
Draft make_draft(const Settings& settings);

/// A name of letters, digits, points, single underscores and hyphens, at most 40 characters, not beginning with a
/// point or hyphen, and not in `taken`, to which it is added.
std::string slug(const std::string& name, const std::string& fallback, std::vector<std::string>& taken);

/// The case of a run with its motion. DIRECTORY is the folder of the campaign. Throws InputError.
Case case_of(const Plan& plan, const PlannedRun& run, const std::string& directory);

/// The stages of a case before its first stage with a duration. Empty if there are no such stages or no others.
std::optional<Case> before_motion(const Case& c);

/// Reads DIRECTORY/campaign.json. Throws InputError.
Plan read_plan(const std::string& directory);
bool holds_plan(const std::string& directory);
/// Writes cases/, records/, campaign.toml and campaign.json. An earlier plan in the folder must be equal to this plan
/// or a part of it. Throws InputError that names the first run that differs.
void write_draft(const Draft& draft, const std::string& directory);

/// The run with this name. Throws InputError if there is none.
const PlannedRun& find_run(const Plan& plan, const std::string& id);
std::string folder_of(const std::string& directory, const PlannedRun& run);

}  // namespace voussoir::campaign
