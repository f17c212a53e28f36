// The results of voussoir fragility as text, JSON and CSV.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fragility/fragility.h"
#include "tools/fragility/ranking.h"

namespace voussoir {

/// Intensity measures for one demand of a case, the best first.
struct IntensityRanking {
  std::string case_name, demand;
  std::vector<MeasurePair> pairings;
};

struct CaseDamage {
  std::string case_name;
  std::vector<DamageRanking> rankings;
};

struct FragilityReport {
  std::string table;  // path
  std::size_t done = 0, collapsed = 0, failed = 0, missing = 0;
  FragilitySettings settings;
  std::vector<Fragility> curves;              // limit by limit, case by case
  std::vector<IntensityRanking> intensities;  // for the main demands and those of the limits
  std::vector<CaseDamage> damage;
  std::vector<std::string> remarks;  // on the whole
};

std::string report_text(const FragilityReport& report);
/// Layout: docs/formats.md.
nlohmann::json report_json(const FragilityReport& report);
/// One row for each curve.
std::string report_csv(const FragilityReport& report);

/// Groups of curves for one chart each: one limit against one intensity. The threshold may differ between bridges. The
/// groups are in the order of the report.
std::vector<std::vector<const Fragility*>> by_limit(const std::vector<Fragility>& curves);

/// A sentence that says which demand predicts a damage best.
std::string damage_words(const DamageRanking& ranking);
/// "240 runs: 231 done, 4 collapsed, 3 failed, 2 not run yet".
std::string runs_words(const FragilityReport& report);

}  // namespace voussoir
