// Reference-based covariance-driven stochastic subspace identification (Peeters & De Roeck 1999) at all even orders.
#include "solver/identify/ssi.h"

#include <memory>

#include "solver/base/error.h"
#include "solver/identify/choose_modes.h"
#include "solver/identify/joint_setups.h"
#include "solver/identify/setups.h"
#include "solver/identify/ssi_problem.h"

namespace voussoir {

namespace {

constexpr double nearly_all = 0.75;  // share of the channels that recordings taken together have in common
constexpr double most_apart = 2.0;   // SsiResult::apart of setups that one model may hold

void expand(const Prepared& prepared, IdentifiedMode& mode) {
  mode.shape_std = over_all_channels(prepared, mode.shape_std.cast<std::complex<double>>()).real();
  mode.shape = over_all_channels(prepared, mode.shape);
  Eigen::MatrixXcd changes = Eigen::MatrixXcd::Zero(mode.shape.size(), mode.shape_changes.cols());
  if (changes.cols() > 0) changes(prepared.used, Eigen::all) = mode.shape_changes;
  mode.shape_changes = std::move(changes);
}

/// Of recordings taken together.
SsiResult identify_together(const SsiProblem& p) {
  SsiResult result = described(p);
  const auto models = [&p](const std::vector<bool>& left_out) {
    const auto space = std::make_shared<Subspace>(p.subspace(left_out));
    return Models{space->largest_order(), [&p, space](int order) {
                    return space->poles(order, p.prepared.dt, p.prepared.highest_frequency, p.scale);
                  }};
  };
  choose_modes({p.settings, int(p.products.sums.size()), models, [&p](IdentifiedMode& m) { listen(p.prepared, m); }},
               result);
  for (IdentifiedMode& mode : result.modes) expand(p.prepared, mode);
  for (RejectedMode& aside : result.set_aside) expand(p.prepared, aside.mode);
  return result;
}

}  // namespace

SsiResult identify_modes(const std::vector<Recording>& recordings, const SsiSettings& settings) {
  check_recordings(recordings);
  const ChannelCounts counts = count_channels(recordings);
  if (double(counts.common) >= nearly_all * double(counts.all)) return identify_together(set_up(recordings, settings));
  const std::vector<Setup> setups = setups_of(recordings);
  std::vector<SsiProblem> problems;
  std::vector<SsiResult> results;
  for (const Setup& setup : setups) {
    problems.push_back(set_up(setup.recordings, settings));
    results.push_back(identify_together(problems.back()));
  }
  using Merging = SsiSettings::Merging;
  if (settings.merging == Merging::before) return identify_jointly(setups, problems, results, settings);
  SsiResult after = merged(setups, results);
  if (settings.merging == Merging::after || common_references(problems).empty() || after.apart > most_apart)
    return after;
  SsiResult before = identify_jointly(setups, problems, results, settings);
  return before.modes.size() > after.modes.size() ? before : after;
}

}  // namespace voussoir
