// Which measure of intensity serves best to foretell which demand, and which demand tells most of the damage.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/campaign/table.h"
#include "tools/fragility/statistics.h"

namespace voussoir {

/// How little a characteristic of the ground motion adds to what the intensity says of the demand.
struct Sufficiency {
  std::string characteristic;  // "scale" or a column
  double p = 0.0;              // of the hypothesis that it adds nothing
};

/// A measure of intensity beside a demand: ln demand = a + b ln im + scatter, over the runs that stand.
struct MeasurePair {
  std::string im, demand;
  Line line;  // efficiency: its scatter (Shome & Cornell 1999); practicality: its slope
  std::vector<Sufficiency> sufficiency;
  /// Scatter over slope (Padgett, Nielson & DesRoches 2008), what the scatter means for a fragility's β; infinite where
  /// the demand does not grow.
  double proficiency() const;
  /// The least p-value, NaN where there is none.
  double least_p() const;
  bool sufficient() const { return !(least_p() < 0.05); }
};

/// Intensities of a case for one demand, the best first: in the order of their proficiency. Columns of characteristics
/// (duration, magnitude, distance) are no intensities. Those with fewer than five runs are left out.
std::vector<MeasurePair> rank_intensities(const CampaignTable& table, const std::string& case_name,
                                          const std::string& demand);

/// The best for a demand over these cases: the least product of proficiencies, of those that all cases have. For
/// collapse_demand, or where no line can be drawn, the one by which the counts are most probable. Throws InputError
/// when the table has no intensity.
std::string best_intensity(const CampaignTable& table, const std::vector<std::string>& cases, const std::string& demand,
                           double threshold);

/// How closely a demand follows a damage: by ranks, so that no form of the relation is assumed.
struct Association {
  std::string damage, demand;
  std::size_t count = 0;
  double correlation = 0.0;  // Spearman's
};

/// The demands for one damage, the closest first.
struct DamageRanking {
  std::string damage;
  std::vector<Association> demands;
  double ahead = 0.0;  // share of resamples of records in which the first is closer than the second; NaN: no second
};

/// Of each column damage.*.broken_share that varies, the main demands over the same runs.
std::vector<DamageRanking> rank_demands(const CampaignTable& table, const std::string& case_name, int replicates,
                                        std::uint64_t seed);

/// Demands that stand for the whole bridge: columns edp.NAME without further dots.
std::vector<std::string> main_demands(const CampaignTable& table);
/// Columns im.* that are no characteristics.
std::vector<std::string> intensities(const CampaignTable& table);

}  // namespace voussoir
