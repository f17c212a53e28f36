#include "solver/identify/joint_setups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "solver/base/error.h"
#include "solver/identify/choose_modes.h"
#include "solver/identify/joint_subspace.h"

namespace voussoir {

namespace {

/// A setup in a model of all.
struct JointSetup {
  const Prepared* prepared = nullptr;
  std::vector<int> references, moved;    // of its channels in use: those that all setups have, and the rest
  std::vector<Eigen::Index> whole;       // per channel in use: its number among those of all setups
  std::vector<Eigen::MatrixXd> signals;  // scaled
  LaggedProducts products;
  CanonicalWeights weights;
};

struct JointProblem {
  std::vector<JointSetup> setups;
  std::vector<std::string> channels;  // in use in any setup
  Eigen::VectorXd scale;              // m/s2 per channel
  Eigen::MatrixXd future;             // canonical weights of the references
  SsiSettings settings;
  double dt = 0.0;
  int segments = 0;  // of each setup, or more of one
};

std::string used_channel(const SsiProblem& p, std::size_t i) {
  return p.prepared.channels[std::size_t(p.prepared.used[i])];
}

Eigen::Index number_in(std::vector<std::string>& channels, const std::string& name) {
  const auto at = std::find(channels.begin(), channels.end(), name);
  if (at != channels.end()) return at - channels.begin();
  channels.push_back(name);
  return Eigen::Index(channels.size()) - 1;
}

Eigen::VectorXd mean_squares(const std::vector<Eigen::MatrixXd>& signals) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(signals.front().cols());
  double samples = 0.0;
  for (const Eigen::MatrixXd& x : signals) {
    sum += x.colwise().squaredNorm().transpose();
    samples += double(x.rows());
  }
  return sum / samples;
}

/// Which of its channels each setup shares with all, and where they stand among all.
void number_channels(JointProblem& joint, const std::vector<SsiProblem>& problems,
                     const std::vector<std::string>& common) {
  for (const SsiProblem& p : problems) {
    JointSetup setup;
    setup.prepared = &p.prepared;
    std::vector<std::string> own;
    for (std::size_t i = 0; i < p.prepared.used.size(); ++i) {
      own.push_back(used_channel(p, i));
      setup.whole.push_back(number_in(joint.channels, own.back()));
      if (std::find(common.begin(), common.end(), own.back()) == common.end()) setup.moved.push_back(int(i));
    }
    for (const std::string& name : common)
      setup.references.push_back(int(std::find(own.begin(), own.end(), name) - own.begin()));
    joint.setups.push_back(std::move(setup));
  }
}

/// Signals of size one. Excitations differ between setups; so each setup is first brought to the same size at its
/// references, which changes no shape.
void scale_signals(JointProblem& joint) {
  std::vector<Eigen::VectorXd> squares;
  Eigen::VectorXd reference = Eigen::VectorXd::Zero(Eigen::Index(joint.setups.front().references.size()));
  for (const JointSetup& setup : joint.setups) {
    squares.push_back(mean_squares(setup.prepared->signals));
    reference += squares.back()(setup.references) / double(joint.setups.size());
  }
  joint.scale.setZero(Eigen::Index(joint.channels.size()));
  Eigen::VectorXd times = joint.scale;
  std::vector<double> level;  // squared size of a setup over that of all, at the references
  for (std::size_t j = 0; j < joint.setups.size(); ++j) {
    const JointSetup& setup = joint.setups[j];
    level.push_back(squares[j](setup.references).cwiseQuotient(reference).mean());
    for (std::size_t i = 0; i < setup.whole.size(); ++i) {
      joint.scale[setup.whole[i]] += squares[j][Eigen::Index(i)] / level[j];
      times[setup.whole[i]] += 1.0;
    }
  }
  joint.scale = joint.scale.cwiseQuotient(times).cwiseSqrt();
  for (std::size_t j = 0; j < joint.setups.size(); ++j) {
    JointSetup& setup = joint.setups[j];
    const Eigen::VectorXd factor = (joint.scale(setup.whole) * std::sqrt(level[j])).cwiseInverse();
    for (const Eigen::MatrixXd& x : setup.prepared->signals) setup.signals.emplace_back(x * factor.asDiagonal());
  }
}

/// One size of Hankel matrices that suits all setups.
void choose_size(JointProblem& joint, const std::vector<SsiProblem>& problems, const SsiSettings& asked) {
  SsiSettings& s = joint.settings;
  s = problems.front().settings;
  const auto references = int(joint.setups.front().references.size());
  s.largest_order = asked.largest_order == 0 ? 60 : asked.largest_order;
  if (asked.block_rows == 0) {
    s.block_rows = std::numeric_limits<int>::max();
    for (const SsiProblem& p : problems) {
      const int usual =
          usual_block_rows(s, joint.dt, references, int(p.prepared.used.size()), int(p.references.size()));
      s.block_rows = std::min({s.block_rows, usual, most_block_rows(p.prepared)});
    }
  }
  s.largest_order = std::min(s.largest_order, references * (s.block_rows - 1)) / 2 * 2;
}

void correlate(JointProblem& joint, const std::vector<SsiProblem>& problems) {
  const int rows = joint.settings.block_rows;
  std::vector<Eigen::MatrixXd> reference;
  std::vector<int> all;
  for (std::size_t i = 0; i < joint.setups.front().references.size(); ++i) all.push_back(int(i));
  joint.segments = std::numeric_limits<int>::max();
  for (std::size_t j = 0; j < joint.setups.size(); ++j) {
    JointSetup& setup = joint.setups[j];
    setup.products = lagged_products(setup.signals, problems[j].references, 2 * rows - 1, joint.settings.segments);
    setup.weights = canonical_weights(setup.signals, problems[j].references, rows);
    joint.segments = std::min(joint.segments, int(setup.products.sums.size()));
    for (const Eigen::MatrixXd& x : setup.signals) reference.emplace_back(x(Eigen::all, setup.references));
    setup.signals.clear();
  }
  joint.future = canonical_weights(reference, all, rows).future;
}

/// The segments of a setup that belong to those left out of all.
std::vector<bool> own_segments(const std::vector<bool>& left_out, std::size_t own) {
  if (left_out.empty()) return {};
  std::vector<bool> mine(own);
  for (std::size_t s = 0; s < own; ++s) mine[s] = left_out[s * left_out.size() / own];
  return mine;
}

JointSubspace subspace(const JointProblem& joint, const std::vector<bool>& left_out) {
  std::vector<Eigen::MatrixXd> sums;
  for (const JointSetup& setup : joint.setups)
    sums.push_back(covariances(setup.products, own_segments(left_out, setup.products.sums.size())));
  std::vector<JointPart> parts;
  for (std::size_t j = 0; j < sums.size(); ++j)
    parts.push_back({sums[j], joint.setups[j].weights.past, joint.setups[j].references, joint.setups[j].moved,
                     joint.setups[j].whole});
  return JointSubspace(parts, joint.future, joint.scale.size(), joint.settings.block_rows,
                       joint.settings.largest_order);
}

/// A machine in any setup is one.
void listen_everywhere(const JointProblem& joint, IdentifiedMode& mode) {
  bool first = true;
  for (const JointSetup& setup : joint.setups) {
    IdentifiedMode own = mode;
    own.shape = mode.shape(setup.whole);
    listen(*setup.prepared, own);
    const auto rank = [](const IdentifiedMode& m) { return m.intermittent ? 2 : m.harmonic ? 1 : 0; };
    if (first || rank(own) > rank(mode) || (rank(own) == rank(mode) && own.kurtosis < mode.kurtosis)) {
      own.shape = mode.shape;
      mode = own;
    }
    first = false;
  }
}

/// A mode over the channels in use as one over those of the result.
void expand(const std::vector<std::string>& from, const std::vector<std::string>& to, IdentifiedMode& mode) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto n = Eigen::Index(to.size());
  IdentifiedMode all = mode;
  all.shape = Eigen::VectorXcd::Constant(n, {none, none});
  all.shape_std = Eigen::VectorXd::Constant(n, none);
  all.shape_changes = Eigen::MatrixXcd::Zero(n, mode.shape_changes.cols());
  for (std::size_t c = 0; c < from.size(); ++c) {
    const auto at = Eigen::Index(std::find(to.begin(), to.end(), from[c]) - to.begin());
    all.shape[at] = mode.shape[Eigen::Index(c)];
    all.shape_std[at] = mode.shape_std[Eigen::Index(c)];
    if (all.shape_changes.cols() > 0) all.shape_changes.row(at) = mode.shape_changes.row(Eigen::Index(c));
  }
  mode = std::move(all);
}

}  // namespace

std::vector<std::string> common_references(const std::vector<SsiProblem>& problems) {
  std::vector<std::string> common;
  for (std::size_t i = 0; i < problems.front().prepared.used.size(); ++i) {
    const std::string name = used_channel(problems.front(), i);
    const bool everywhere = std::all_of(problems.begin(), problems.end(), [&](const SsiProblem& p) {
      for (std::size_t k = 0; k < p.prepared.used.size(); ++k)
        if (used_channel(p, k) == name) return true;
      return false;
    });
    if (everywhere) common.push_back(name);
  }
  return common;
}

SsiResult identify_jointly(const std::vector<Setup>& setups, const std::vector<SsiProblem>& problems,
                           const std::vector<SsiResult>& results, const SsiSettings& settings) {
  const std::vector<std::string> common = common_references(problems);
  if (common.empty())
    throw InputError(
        "no channel is usable in all {} setups, but a joint model of the setups needs one. Identify the setups "
        "separately and combine their modes.",
        setups.size());
  JointProblem joint;
  joint.dt = problems.front().prepared.dt;
  number_channels(joint, problems, common);
  scale_signals(joint);
  choose_size(joint, problems, settings);
  correlate(joint, problems);
  SsiResult result = united(results);
  result.joint = true;
  result.settings = joint.settings;
  const double highest = problems.front().prepared.highest_frequency;
  const auto models = [&](const std::vector<bool>& left_out) {
    const auto space = std::make_shared<JointSubspace>(subspace(joint, left_out));
    return Models{space->largest_order(),
                  [&joint, highest, space](int order) { return space->poles(order, joint.dt, highest, joint.scale); }};
  };
  choose_modes({joint.settings, joint.segments, models, [&](IdentifiedMode& m) { listen_everywhere(joint, m); }},
               result);
  for (IdentifiedMode& mode : result.modes) expand(joint.channels, result.channels, mode);
  for (RejectedMode& aside : result.set_aside) expand(joint.channels, result.channels, aside.mode);
  return result;
}

}  // namespace voussoir
