// Ranking of intensity measures by how well they predict a demand, and of demands by how well they predict the damage.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/campaign/table.h"
#include "tools/fragility/statistics.h"

namespace voussoir {

/// The significance of a further characteristic of the ground motion, in addition to the intensity.
struct Sufficiency {
  std::string characteristic;  // "scale" or a column
  double p = 0.0;              // p-value of the hypothesis that it adds nothing
};

/// An intensity measure and a demand: ln demand = a + b ln im + scatter, over the runs without collapse.
struct MeasurePair {
  std::string im, demand;
  bool complete = true;  // every run of the case with a result has the intensity, above 0
  Line line;             // efficiency: its scatter (Shome & Cornell 1999); practicality: its slope
  std::vector<Sufficiency> sufficiency;
  /// Scatter divided by slope (Padgett, Nielson & DesRoches 2008): the contribution of the scatter to the β of a
  /// fragility. Infinite if the demand does not increase.
  double proficiency() const;
  /// The smallest p-value, NaN if there is none.
  double least_p() const;
  bool sufficient() const { return !(least_p() < 0.05); }
};

/// Intensity measures of a case for one demand in the order of their proficiency, the best first; those that are zero
/// or missing in some runs come last. Columns of characteristics (duration, magnitude, distance) are not used as
/// intensities. Measures with fewer than five runs are left out.
std::vector<MeasurePair> rank_intensities(const CampaignTable& table, const std::string& case_name,
                                          const std::string& demand);

/// The best measure for a demand over these cases: the smallest product of proficiencies among the measures that all
/// cases have. For collapse_demand, or if no line is possible, the measure with the largest likelihood of the counts.
/// A measure that is zero or missing in some runs with a result is chosen only if all are. Throws InputError if the
/// table has no intensity.
std::string best_intensity(const CampaignTable& table, const std::vector<std::string>& cases, const std::string& demand,
                           double threshold);

/// Number of runs of these cases with a result in which the measure is above 0, and of all of them.
struct Coverage {
  std::size_t with = 0, runs = 0;
  bool complete() const { return with == runs; }
};
Coverage coverage(const CampaignTable& table, const std::vector<std::string>& cases, const std::string& im);

/// Association of a demand with a damage, by ranks, so that no form of the relation is assumed.
struct Association {
  std::string damage, demand;
  std::size_t count = 0;
  double correlation = 0.0;  // Spearman's rank correlation
};

/// The demands for one damage in descending order of correlation.
struct DamageRanking {
  std::string damage;
  std::vector<Association> demands;
  double ahead = 0.0;  // share of resamples of the records in which the first correlates more closely than the second;
                       // NaN: no second
};

/// Rankings of the main demands for each column damage.*.broken_share that varies, over the same runs.
std::vector<DamageRanking> rank_demands(const CampaignTable& table, const std::string& case_name, int replicates,
                                        std::uint64_t seed);

/// Demands of the whole bridge: columns edp.NAME without further dots.
std::vector<std::string> main_demands(const CampaignTable& table);
/// Columns im.* that are not characteristics.
std::vector<std::string> intensities(const CampaignTable& table);

}  // namespace voussoir
