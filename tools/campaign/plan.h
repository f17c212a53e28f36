// The plan of a campaign: which runs there are, in which order, under which names, and what makes each of them.
#pragma once
#include <optional>

#include "tools/campaign/settings.h"

namespace voussoir::campaign {

struct PlannedCase {
  std::string name, slug;  // as in the table; of its folder in cases/
  std::uint64_t hash = 0;  // of all that the case says
};

struct PlannedRecord {
  std::string name, event, slug;
  std::uint64_t hash = 0;
  double duration = 0.0;         // s that are run
  std::vector<double> measures;  // at scale 1, of that part: see measures.h; NaN for none
};

struct PlannedRun {
  std::string id;  // [A-Za-z0-9._-], also its folder in runs/
  std::size_t case_number = 0, record = 0;
  double scale = 1.0;          // times the record's own factor
  int sample = 0;              // from 1; 0: nothing is sampled
  std::vector<double> values;  // of Plan::keys
  std::uint64_t hash = 0;      // of all that its result depends on
};

struct Plan {
  std::string file;  // the campaign file's name, without its folder
  std::vector<PlannedCase> cases;
  std::vector<PlannedRecord> records;
  std::vector<PlannedRun> runs;
  std::vector<std::string> keys;  // that are sampled
  std::vector<double> periods;    // s
  RunSettings run;
  std::vector<PlannedLimit> limit_states;
  EngineSettings engine;
  std::vector<std::string> left_out;  // of the folder of records, each reason once
};

/// A plan and what its folder is to hold of cases and records.
struct Draft {
  Plan plan;
  std::vector<Case> cases;  // as read
  std::vector<Shaking> records;
  std::string text;  // of the campaign file
};

/// cases × records × scales × samples, in that order. Everything that can be said before a block is laid is checked:
/// throws InputError.
Draft make_draft(const Settings& settings);

/// A name of letters, digits, points, single underscores and hyphens only, at most 40 of them, not beginning with a
/// point or hyphen; `taken` becomes longer by it.
std::string slug(const std::string& name, const std::string& fallback, std::vector<std::string>& taken);

/// The case of a run, with its motion: DIRECTORY is the campaign's folder. Throws InputError.
Case case_of(const Plan& plan, const PlannedRun& run, const std::string& directory);

/// The stages of a case before the first that takes time, alone; none where there are no such or no other stages.
std::optional<Case> before_motion(const Case& c);

/// Reads DIRECTORY/campaign.json. Throws InputError.
Plan read_plan(const std::string& directory);
bool holds_plan(const std::string& directory);
/// Writes cases/, records/, campaign.toml and campaign.json. An earlier plan there must be the same or a part of this
/// one. Throws InputError naming the first run that would be another.
void write_draft(const Draft& draft, const std::string& directory);

/// Throws InputError when there is none of that name.
const PlannedRun& find_run(const Plan& plan, const std::string& id);
std::string folder_of(const std::string& directory, const PlannedRun& run);

}  // namespace voussoir::campaign
