#include "solver/diagnosis/further.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "geometry/nearest_block.h"
#include "solver/effects/parts.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

// Where no measured mode says better.
constexpr double usual_frequency_std = 0.01, usual_shape_std = 0.05;  // of the logarithm; of the largest component

double median(std::vector<double> all, double otherwise) {
  if (all.empty()) return otherwise;
  std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
  return all[all.size() / 2];
}

/// Along the bridge: crowns, piers and ends where the assembly names them, else seven stations.
std::vector<double> stations(const Assembly& assembly, const Box& box) {
  std::vector<double> at = {box.low.x(), box.high.x()};
  for (const auto& [name, blocks] : assembly.groups)
    if ((name.starts_with("keystone ") || name.starts_with("base pier ")) && !blocks.empty()) {
      const Box own = block_box(assembly.blocks[std::size_t(blocks[0])]);
      at.push_back(0.5 * (own.low.x() + own.high.x()));
    }
  if (at.size() == 2)
    for (int i = 1; i < 6; ++i) at.push_back(box.low.x() + i / 6.0 * (box.high.x() - box.low.x()));
  std::sort(at.begin(), at.end());
  return at;
}

/// Channels along x, y and z on both edges of the deck and at half height of the piers, that are not there yet.
std::vector<Sensor> pool_of(const Assembly& assembly, const std::vector<Sensor>& there) {
  Box box;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    const Box own = block_box(block);
    box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
  }
  std::vector<Sensor> pool;
  const auto add = [&](const Vec3& wanted) {
    const NearestBlock nearest = nearest_block(assembly, wanted);
    if (nearest.block < 0) return;
    const Box own = block_box(assembly.blocks[std::size_t(nearest.block)]);
    Vec3 at = wanted.cwiseMax(own.low).cwiseMin(own.high);
    for (double& x : at) x = std::round(100.0 * x) / 100.0;
    for (int axis = 0; axis < 3; ++axis) {
      Sensor s = {"", at, Vec3::Unit(axis), nearest.block};
      const auto same = [&](const Sensor& other) {
        return (other.position - at).norm() < 0.3 && std::abs(other.direction.dot(s.direction)) > 0.9;
      };
      if (std::none_of(there.begin(), there.end(), same) && std::none_of(pool.begin(), pool.end(), same))
        pool.push_back(s);
    }
  };
  for (const double x : stations(assembly, box)) {
    add({x, box.low.y(), box.high.z()});
    add({x, box.high.y(), box.high.z()});
    add({x, box.low.y(), 0.5 * (box.low.z() + box.high.z())});
  }
  return pool;
}

std::string sensor_text(const Sensor& s, const std::vector<std::string>& parts) {
  return fmt::format("a sensor at ({:.2f}, {:.2f}, {:.2f}) m on {} along {}", s.position.x(), s.position.y(),
                     s.position.z(), parts[std::size_t(s.block)],
                     "xyz"[s.direction.x() != 0.0   ? 0
                           : s.direction.y() != 0.0 ? 1
                                                    : 2]);
}

/// A measured mode as the model has it: its own shape, where it is measured and at further channels.
void make_virtual(MeasuredFeature& mode, const Observed& seen, int computed, Eigen::Index measured, double std) {
  const Eigen::Index all = seen.readings.rows();
  const auto padded = [&](Eigen::VectorXd& v, double value) {
    if (v.size() == 0) return;
    v.conservativeResize(all);
    v.tail(all - measured).setConstant(value);
  };
  if (!has_shape(mode)) {
    mode.shape.resize(0), mode.quadrature.resize(0);
    return;
  }
  padded(mode.shape, std::nan("")), padded(mode.quadrature, std::nan(""));
  double size = 0.0, own = 0.0;
  for (Eigen::Index s = 0; s < measured; ++s)
    if (std::isfinite(mode.shape[s])) {
      size = std::max(size, std::abs(mode.shape[s]));
      if (computed >= 0) own = std::max(own, std::abs(seen.readings(s, computed)));
    }
  mode.unit = size;
  padded(mode.shape_std, std * size);
  if (computed < 0 || own <= 0.0) return;
  for (Eigen::Index s = 0; s < all; ++s)
    if (s >= measured || std::isfinite(mode.shape[s])) mode.shape[s] = size / own * seen.readings(s, computed);
}

void pad_rows(Eigen::MatrixXd& m, Eigen::Index rows) {
  if (m.size() == 0) return;
  const Eigen::Index had = m.rows();
  m.conservativeResize(rows, Eigen::NoChange);
  m.bottomRows(rows - had).setZero();
}

/// How well modes are known that were measured, and by which channels.
struct Quality {
  std::vector<bool> used;  // by sensor
  double frequency_std = 0.0, shape_std = 0.0;
  bool shaped() const { return std::find(used.begin(), used.end(), true) != used.end(); }
};
Quality quality_of(const Features& features) {
  Quality q;
  q.used.assign(features.sensors.size(), false);
  std::vector<double> frequencies, shapes;
  for (const MeasuredFeature& mode : features.modes) {
    frequencies.push_back(mode.frequency_std);
    if (!has_shape(mode)) continue;
    for (std::size_t s = 0; s < q.used.size(); ++s)
      if (std::isfinite(mode.shape[Eigen::Index(s)])) {
        q.used[s] = true;
        shapes.push_back(mode.shape_std[Eigen::Index(s)] / unit_of(mode));
      }
  }
  q.frequency_std = median(frequencies, usual_frequency_std);
  q.shape_std = median(shapes, usual_shape_std);
  return q;
}

/// Modes of the model that were not measured, up to twice the highest measured frequency.
std::vector<MeasuredFeature> further_modes(const DiagnosisProblem& problem, const Response& plain, const Observed& seen,
                                           const std::vector<int>& paired, const Quality& quality) {
  constexpr std::size_t most = 6;
  double highest = 0.0;
  for (const MeasuredFeature& mode : problem.features.modes) highest = std::max(highest, mode.frequency);
  std::vector<MeasuredFeature> modes;
  for (Eigen::Index c = 0; c < plain.log_frequency.size() && modes.size() < most; ++c) {
    const ModeWords& words = plain.words[std::size_t(c)];
    if (words.direction == "local" || words.order == 0 || plain.log_frequency[c] > std::log(2.0 * highest)) continue;
    if (std::find(paired.begin(), paired.end(), int(c)) != paired.end()) continue;
    MeasuredFeature mode;
    mode.frequency = std::exp(plain.log_frequency[c]);
    mode.frequency_std = quality.frequency_std;
    mode.direction = words.direction;
    mode.name =
        fmt::format("the mode {}, about {:.3f} s ({:.2f} Hz)", words.text(), 1.0 / mode.frequency, mode.frequency);
    double size = 0.0;
    mode.shape = Eigen::VectorXd::Constant(seen.readings.rows(), std::nan(""));
    for (std::size_t s = 0; s < quality.used.size(); ++s)
      if (quality.used[s]) {
        mode.shape[Eigen::Index(s)] = seen.readings(Eigen::Index(s), c);
        size = std::max(size, std::abs(seen.readings(Eigen::Index(s), c)));
      }
    mode.shape_std = Eigen::VectorXd::Constant(seen.readings.rows(), quality.shape_std * size);
    if (!has_shape(mode) || size <= 0.0) mode.shape.resize(0);
    modes.push_back(std::move(mode));
  }
  return modes;
}

/// Which rows there are already, and which each option brings.
void sort_rows(const Assembly& assembly, std::size_t measured, Extended& e) {
  const Features& features = e.problem.features;
  const std::vector<ResidualRow> rows = residual_rows(e.problem);
  std::vector<Extended::Option> channels(features.sensors.size() - measured);
  std::map<int, Extended::Option> modes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ResidualRow& row = rows[i];
    const bool of_channel = row.kind == ResidualRow::Kind::shape || row.kind == ResidualRow::Kind::quadrature;
    if (features.modes[std::size_t(row.mode)].held_back) continue;
    if (e.further[std::size_t(row.mode)])
      modes[row.mode].rows.push_back(int(i));
    else if (of_channel && std::size_t(row.sensor) >= measured)
      channels[std::size_t(row.sensor) - measured].rows.push_back(int(i));
    else
      e.had.push_back(int(i));
  }
  const std::vector<std::string> parts = parts_of_blocks(assembly);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].rows.empty()) continue;
    const Sensor& s = features.sensors[measured + c];
    channels[c].addition.text = sensor_text(s, parts);
    channels[c].addition.sensor = fmt::format("{:g},{:g},{:g},{}", s.position.x(), s.position.y(), s.position.z(),
                                              channels[c].addition.text.back());
    e.options.push_back(std::move(channels[c]));
  }
  for (auto& [mode, option] : modes) {
    option.addition.text = features.modes[std::size_t(mode)].name;
    e.options.push_back(std::move(option));
  }
}

}  // namespace

Extended extended(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                  const Eigen::VectorXd& x, bool options, int threads) {
  Extended e;
  e.problem = problem;
  e.plain = origin.response();
  if (!options) {
    e.had = split_rows(problem, residual_rows(problem)).fitted;
    return e;
  }
  const Assembly& assembly = origin.assembly();
  const Unknowns& unknowns = origin.model().unknowns;
  Features& features = e.problem.features;
  const std::size_t measured = features.sensors.size();
  const Quality quality = quality_of(features);
  const std::vector<int> paired =
      pair_features(features, e.plain, hypothesis.observe(e.plain, problem.damping, x).readings).computed;
  if (quality.shaped())
    for (Sensor& s : pool_of(assembly, features.sensors)) features.sensors.push_back(std::move(s));
  e.plain.sensors = at_sensors(assembly, unknowns, features.sensors, e.plain.vectors);
  e.plain.motions = motions_at(assembly, unknowns, features.sensors, e.plain.vectors);
  const Observed seen = hypothesis.observe(e.plain, problem.damping, x);
  for (std::size_t m = 0; m < features.modes.size(); ++m)
    make_virtual(features.modes[m], seen, paired[m], Eigen::Index(measured), quality.shape_std);
  std::set<std::string> further;
  for (MeasuredFeature& mode : further_modes(problem, e.plain, seen, paired, quality)) {
    further.insert(mode.name);
    features.modes.push_back(std::move(mode));
  }
  std::stable_sort(features.modes.begin(), features.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  for (const MeasuredFeature& mode : features.modes) e.further.push_back(further.contains(mode.name));
  // The mesh error is not computed for further channels. It is included only in their own errors.
  pad_rows(e.problem.mesh.difference.sensors, e.plain.sensors.rows());
  pad_rows(e.problem.mesh.difference.motions, e.plain.motions.rows());
  set_covariance(e.problem, origin, e.plain, hypothesis, x, threads);
  sort_rows(assembly, measured, e);
  return e;
}

namespace {

/// What is known of all rows once some are measured.
class Known {
 public:
  Known(const Eigen::MatrixXd& covariance, const std::vector<int>& had, const Eigen::MatrixXd& traces)
      : covariance_(&covariance), traces_(&traces) {
    const Eigen::MatrixXd white = whitening_of(Eigen::MatrixXd(covariance(had, had)));
    across_ = white * covariance(had, Eigen::all);
    own_ = white * traces(had, Eigen::all);
  }
  Eigen::VectorXd squares() const { return own_.colwise().squaredNorm().transpose(); }
  /// By which the squares of the distances grow with further rows.
  Eigen::VectorXd growth(const std::vector<int>& rows) const {
    const Eigen::MatrixXd across = across_(Eigen::all, rows);
    const Eigen::MatrixXd left = (*covariance_)(rows, rows) - across.transpose() * across;
    const Eigen::MatrixXd g = (*traces_)(rows, Eigen::all) - across.transpose() * own_;
    return (whitening_of(left) * g).colwise().squaredNorm().transpose();
  }

 private:
  const Eigen::MatrixXd *covariance_, *traces_;
  Eigen::MatrixXd across_, own_;
};

/// Factors of least amounts; of effects that hardly show nothing is promised.
Eigen::ArrayXd factors_of(const Eigen::VectorXd& before, const Eigen::VectorXd& more, const Eigen::ArrayXd& needed) {
  constexpr double shows = 0.1;  // of the distance that is needed
  const Eigen::ArrayXd low = before.array().sqrt().max(shows * needed),
                       high = (before + more).array().sqrt().max(shows * needed);
  return low / high;
}

}  // namespace

std::vector<Addition> best_additions(const Extended& all, bool sensors, const Eigen::MatrixXd& covariance,
                                     const std::vector<Trace>& traces, int count) {
  std::vector<Addition> chosen;
  if (traces.empty()) return chosen;
  Eigen::MatrixXd columns(covariance.rows(), Eigen::Index(traces.size()));
  Eigen::ArrayXd needed(columns.cols());
  for (std::size_t i = 0; i < traces.size(); ++i) {
    columns.col(Eigen::Index(i)) = traces[i].rows;
    needed[Eigen::Index(i)] = traces[i].needed;
  }
  std::vector<int> had = all.had;
  const Known measured(covariance, had, columns);
  const Eigen::VectorXd first = measured.squares();
  std::vector<Extended::Option> options = all.options;
  std::erase_if(options, [&](const Extended::Option& o) { return o.addition.sensor.empty() == sensors; });
  while (int(chosen.size()) < count && !options.empty()) {
    const Known known(covariance, had, columns);
    const Eigen::VectorXd before = known.squares();
    std::size_t best = 0;
    double least = 0.0;
    Eigen::VectorXd growth;
    for (std::size_t i = 0; i < options.size(); ++i) {
      const Eigen::VectorXd own = known.growth(options[i].rows);
      const double mean = factors_of(before, own, needed).log().mean();
      if (mean < least) least = mean, best = i, growth = own;
    }
    if (growth.size() == 0) break;
    Addition a = options[best].addition;
    a.rows = options[best].rows;
    a.factor = std::exp(factors_of(first, before + growth - first, needed).log().mean());
    const Eigen::ArrayXd own = factors_of(first, measured.growth(a.rows), needed);
    std::vector<std::size_t> order(traces.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return own[Eigen::Index(i)] < own[Eigen::Index(j)]; });
    std::set<std::string> said;  // an effect has two sides
    for (const std::size_t i : order)
      if (a.most.size() < 3 && said.insert(traces[i].name + " " + traces[i].where).second)
        a.most.push_back({traces[i].name, traces[i].where, own[Eigen::Index(i)], traces[i].above, i});
    had.insert(had.end(), a.rows.begin(), a.rows.end());
    options.erase(options.begin() + std::ptrdiff_t(best));
    chosen.push_back(std::move(a));
  }
  return chosen;
}

}  // namespace voussoir
