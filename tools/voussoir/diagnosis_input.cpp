#include "tools/voussoir/diagnosis_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/identify/fdd.h"
#include "solver/identify/ssi.h"

namespace voussoir {

namespace {

constexpr double default_period_std = 0.01;  // share, where a measurement gives none
constexpr double default_shape_std = 0.05;   // share of the largest component
constexpr double default_damping_std = 0.3;  // share

MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors) {
  MeasuredFeature f;
  f.name = mode.name;
  f.frequency = 1.0 / mode.period;
  f.frequency_std = mode.period_std > 0.0 ? mode.period_std / mode.period : default_period_std;
  f.direction = mode.direction;
  if (mode.damping && *mode.damping > 0.0) {
    f.damping = mode.damping;
    f.damping_std = mode.damping_std > 0.0 ? mode.damping_std / *mode.damping : default_damping_std;
  }
  if (mode.shape.empty()) return f;
  f.shape = Eigen::VectorXd::Constant(Eigen::Index(sensors), std::nan(""));
  f.shape_std = Eigen::VectorXd::Zero(Eigen::Index(sensors));
  double largest = 0.0;
  for (const MeasuredValue& v : mode.shape) largest = std::max(largest, std::abs(v.value));
  for (const MeasuredValue& v : mode.shape) {
    f.shape[Eigen::Index(v.sensor)] = v.value;
    f.shape_std[Eigen::Index(v.sensor)] = v.std > 0.0 ? v.std : default_shape_std * largest;
  }
  return f;
}

/// Modes from the recordings, where none are given.
void identify(Measured& measured) {
  if (!measured.modes.empty() || measured.records.empty()) return;
  const SsiResult found = identify_modes(measured.records);
  const Fdd spectra = decompose_spectra(measured.records);
  for (const PoorChannel& poor : found.poor)
    measured.set_aside.push_back({fmt::format("channel {}", found.channels[std::size_t(poor.channel)]), poor.reason});
  for (const RejectedMode& aside : found.set_aside)
    measured.set_aside.push_back({fmt::format("{:.3f} Hz", aside.mode.frequency), aside.reason});
  for (const IdentifiedMode& m : found.modes) {
    MeasuredMode mode;
    mode.name = fmt::format("{}", measured.modes.size() + 1);
    mode.period = 1.0 / m.frequency;
    mode.period_std = m.frequency_std / (m.frequency * m.frequency);
    mode.damping = m.damping;
    mode.damping_std = m.damping_std;
    for (std::size_t s = 0; s < measured.sensors.size(); ++s) {
      const auto at = std::find(found.channels.begin(), found.channels.end(), measured.sensors[s].id);
      if (at == found.channels.end()) continue;
      const auto channel = Eigen::Index(at - found.channels.begin());
      if (std::isfinite(m.shape[channel].real()))
        mode.shape.push_back({s, m.shape[channel].real(), m.shape_std[channel]});
    }
    const FddPeak peak = peak_near(spectra, m.frequency, m.shape);
    measured.remarks.push_back(fmt::format(
        "mode {}: {:.3f} Hz ± {:.3f}, damping {:.2f} % ± {:.2f}, stable at {} orders; {}", mode.name, m.frequency,
        m.frequency_std, 100.0 * m.damping, 100.0 * m.damping_std, m.hits,
        peak.found
            ? fmt::format("frequency-domain decomposition: {:.3f} Hz, MAC {:.2f}", peak.frequency, peak.assurance)
            : std::string("no peak of the frequency-domain decomposition")));
    measured.modes.push_back(std::move(mode));
  }
  if (measured.modes.empty())
    throw InputError("{}: no mode can be identified from the recordings; record longer, or give modes.csv",
                     measured.directory);
}

/// The case's assembly with blocks of another size.
Assembly remeshed(const Case& c, double block_scale) {
  Case other = c;
  other.generator_input.values.at("block_scale") = block_scale;
  return make_assembly(other);
}

std::int64_t unknowns_of(const Assembly& assembly) {
  return 6 * std::count_if(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return !b.fixed; });
}

bool can_remesh(const Case& c) {
  return !c.generator.empty() && c.generator_input.values.contains("block_scale");
}

Response plain_response(const Assembly& assembly, const std::vector<Sensor>& sensors, int modes) {
  EigenMemory memory;
  return response(assembly, linear_model(assembly), sensors, modes, memory);
}

/// Which mode of `other` is each of `r`: of the same direction, the k-th of it, when their frequencies are near.
std::vector<int> same_modes(const Response& r, const Response& other) {
  std::vector<int> partner(r.words.size(), -1);
  std::vector<bool> taken(other.words.size(), false);
  for (std::size_t i = 0; i < r.words.size(); ++i)
    for (std::size_t j = 0; j < other.words.size(); ++j) {
      if (taken[j] || other.words[j].direction != r.words[i].direction || r.words[i].direction == "local") continue;
      if (std::abs(r.log_frequency[Eigen::Index(i)] - other.log_frequency[Eigen::Index(j)]) > 0.15) continue;
      partner[i] = int(j);
      taken[j] = true;
      break;
    }
  return partner;
}

/// What blocks 1.25 times as large do to frequencies and shapes: their common shift is one of stiffness, which is
/// fitted; the rest is an error of the model.
void measure_mesh(DiagnosisInput& input, const DiagnosisRequest& request) {
  if (!can_remesh(input.c)) return;
  const DiagnosisProblem& p = input.coarse;
  const Assembly coarser = remeshed(input.c, 1.25 * input.block_scale);
  const std::vector<Sensor>& sensors = p.features.sensors;
  std::vector<Sensor> moved = sensors;
  const std::vector<std::int64_t> blocks = place_sensors(input.measured, coarser);
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i].block = blocks[i];
  const int modes = int(p.features.modes.size()) + 2;
  const Response a = plain_response(p.base, sensors, modes), b = plain_response(coarser, moved, modes);
  const std::vector<int> partner = same_modes(a, b);
  std::vector<double> shifts;
  double squares = 0.0;
  int entries = 0;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    if (partner[i] < 0) continue;
    shifts.push_back(b.log_frequency[partner[i]] - a.log_frequency[Eigen::Index(i)]);
    if (sensors.empty()) continue;
    const Eigen::VectorXd u = a.sensors.col(Eigen::Index(i)), v = b.sensors.col(partner[i]);
    const double scale = u.dot(v) / std::max(v.squaredNorm(), 1e-300), largest = u.cwiseAbs().maxCoeff();
    if (u.dot(v) * u.dot(v) < 0.8 * u.squaredNorm() * v.squaredNorm()) continue;  // close modes that mix otherwise
    squares += (u - scale * v).squaredNorm() / (largest * largest);
    entries += int(u.size());
  }
  if (shifts.empty()) return;
  for (double s : shifts) input.mesh_shift += s / double(shifts.size());
  for (double s : shifts) input.mesh_scatter += (s - input.mesh_shift) * (s - input.mesh_shift);
  input.mesh_scatter = std::sqrt(input.mesh_scatter / double(shifts.size()));
  if (entries > 0) input.mesh_shape = std::sqrt(squares / entries);
  // The stones are those of the case: what is coarser is so many times farther off; and no mesh is better than half.
  const double own = input.c.generator_input.values.at("block_scale");
  const double farther = std::max(0.5, (input.block_scale - own) / (0.25 * input.block_scale));
  input.coarse.error.frequency = std::hypot(request.model_error, farther * input.mesh_scatter);
  input.coarse.error.shape = std::hypot(request.shape_error, farther * input.mesh_shape);
  input.full.error.frequency = std::hypot(request.model_error, 0.5 * input.mesh_scatter);
  input.full.error.shape = std::hypot(request.shape_error, 0.5 * input.mesh_shape);
}

void hold_back(Features& features, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto at = std::find_if(features.modes.begin(), features.modes.end(),
                                 [&](const MeasuredFeature& mode) { return mode.name == name; });
    if (at == features.modes.end()) throw InputError("--hold-back: there is no measured mode '{}'", name);
    at->held_back = true;
  }
}

DiagnosisProblem problem_of(const DiagnosisRequest& request, const DiagnosisInput& input, Assembly assembly) {
  DiagnosisProblem problem;
  problem.features = features_of(input.measured, assembly);
  hold_back(problem.features, request.hold_back);
  problem.base = std::move(assembly);
  problem.error.frequency = request.model_error;
  problem.error.shape = request.shape_error;
  const DampingSettings& damping = input.c.settings.damping;
  using Kind = DampingSettings::Kind;
  if (damping.kind == Kind::maxwell || damping.kind == Kind::rayleigh) problem.damping = damping.ratio;
  problem.modes = std::min(int(problem.features.modes.size()) + 8, 40);
  return problem;
}

}  // namespace

Features features_of(const Measured& measured, const Assembly& assembly) {
  Features features;
  const std::vector<std::int64_t> blocks = place_sensors(measured, assembly);
  for (std::size_t i = 0; i < measured.sensors.size(); ++i)
    features.sensors.push_back(
        {measured.sensors[i].id, measured.sensors[i].position, measured.sensors[i].direction, blocks[i]});
  for (const MeasuredMode& mode : measured.modes) features.modes.push_back(feature_of(mode, measured.sensors.size()));
  std::stable_sort(features.modes.begin(), features.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return features;
}

DiagnosisInput diagnosis_input(const DiagnosisRequest& request) {
  DiagnosisInput input;
  input.c = read_case(request.case_file, CaseUse::geometry);
  input.measured = read_measured(request.measured);
  identify(input.measured);
  Assembly own = make_assembly(input.c);
  if (can_remesh(input.c)) input.block_scale = input.c.generator_input.values.at("block_scale");
  Assembly coarse = own;
  while (can_remesh(input.c) && unknowns_of(coarse) > request.unknowns) {
    // Blocks per volume fall with the cube of their size.
    const double factor = std::cbrt(double(unknowns_of(coarse)) / request.unknowns);
    input.block_scale *= std::max(1.05, factor);
    input.coarsened = true;
    coarse = remeshed(input.c, input.block_scale);
  }
  input.full = problem_of(request, input, std::move(own));
  input.coarse = problem_of(request, input, std::move(coarse));
  measure_mesh(input, request);
  set_shape_errors(input.coarse);
  if (input.coarsened)
    set_shape_errors(input.full);
  else
    input.full = input.coarse;
  return input;
}

}  // namespace voussoir
