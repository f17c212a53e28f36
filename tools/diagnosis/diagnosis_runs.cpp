#include "tools/diagnosis/diagnosis_runs.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "solver/base/error.h"
#include "solver/identify/driven_modes.h"
#include "solver/identify/prepare.h"
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

namespace {

using Say = std::function<void(const std::string&)>;

/// Rows [first, first + count) of the recording.
Recording part(const Recording& record, Eigen::Index first, Eigen::Index count) {
  Recording cut = record;
  cut.values = record.values.middleRows(first, count);
  return cut;
}

/// The ground's acceleration; zero along axes that were not recorded.
GroundMotion ground_of(const Recording& record) {
  GroundMotion motion;
  motion.dt = record.dt;
  motion.acceleration.assign(std::size_t(record.values.rows()), Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis)
    if (const Eigen::Index column = column_of(record, fmt::format("base_{}", "xyz"[axis])); column >= 0)
      for (Eigen::Index i = 0; i < record.values.rows(); ++i)
        motion.acceleration[std::size_t(i)][axis] = record.values(i, column);
  return motion;
}

constexpr double quiet =
    2.0;  // s before the onset; in this time a bridge that starts from rest reaches the recorded motion

/// The sample at which the Arias intensity (1970) of the ground motion passes a hundredth of its total. The bridge is
/// nearly at rest until then.
Eigen::Index onset(const GroundMotion& ground) {
  double whole = 0.0, sum = 0.0;
  for (const Vec3& a : ground.acceleration) whole += a.squaredNorm();
  for (std::size_t i = 0; i < ground.acceleration.size(); ++i)
    if ((sum += ground.acceleration[i].squaredNorm()) > 0.01 * whole) return Eigen::Index(i);
  return 0;
}

/// The settings of the case with one stage under this motion, and with the settings that the effects of the hypothesis
/// change.
SolverSettings settings_for(const DiagnosisInput& input, const GroundMotion& ground,
                            const std::vector<EffectSetting>& effects, double sample_every) {
  SolverSettings settings = input.c.settings;
  StageSettings rest, shaken;
  rest.label = "gravity";
  shaken.kind = StageSettings::Kind::motion;
  shaken.motion = ground;
  shaken.duration = ground.duration();
  shaken.label = "the recorded motion";
  settings.stages = {rest, shaken};
  settings.output.history_every = sample_every;
  settings.output.fields_every = settings.output.checkpoint_every = settings.output.checkpoint_wall = 1e9;
  for (const EffectSetting& effect : effects) apply_effect(settings, effect);
  return settings;
}

/// Velocities of the sensors over time.
struct Velocities {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;
};

double at_time(const Velocities& v, std::size_t sensor, double time) {
  const auto next = std::lower_bound(v.times.begin(), v.times.end(), time);
  if (next == v.times.begin()) return v.rows.front()[sensor];
  if (next == v.times.end()) return v.rows.back()[sensor];
  const auto i = std::size_t(next - v.times.begin());
  const double t = (time - v.times[i - 1]) / (v.times[i] - v.times[i - 1]);
  return (1.0 - t) * v.rows[i - 1][sensor] + t * v.rows[i][sensor];
}

/// Sensors with their faults.
struct Instrument {
  Sensor sensor;
  double delay = 0.0;  // s, of its clock
};
std::vector<Instrument> instruments(std::vector<Sensor> sensors, const std::vector<EffectSetting>& effects) {
  std::vector<Instrument> all;
  for (const EffectSetting& effect : effects) apply_effect(sensors, effect);
  for (const Sensor& sensor : sensors) {
    all.push_back({sensor, 0.0});
    for (const EffectSetting& effect : effects)
      if (effect.name == "sensor_fault" && effect.where == "channel " + sensor.id)
        all.back().delay += effect.values.at("delay");
  }
  return all;
}

/// Mean acceleration about each sample of the recording, over its time step.
Recording accelerations(const Velocities& v, double begin, const Recording& like,
                        const std::vector<Instrument>& instruments) {
  Recording r = like;
  for (std::size_t s = 0; s < instruments.size(); ++s) {
    const Eigen::Index column = column_of(like, instruments[s].sensor.id);
    if (column < 0) continue;
    for (Eigen::Index i = 0; i < r.values.rows(); ++i) {
      const double t = begin + double(i) * like.dt - instruments[s].delay;
      r.values(i, column) = (at_time(v, s, t + 0.5 * like.dt) - at_time(v, s, t - 0.5 * like.dt)) / like.dt;
    }
  }
  return r;
}

Recording simulate(const DiagnosisInput& input, const Assembly& assembly, const std::vector<EffectSetting>& effects,
                   const Recording& recorded, int threads, const std::string& name, const Say& say) {
  const std::vector<Instrument> all = instruments(input.runs.features.sensors, effects);
  const SolverSettings settings = settings_for(input, ground_of(recorded), effects, 0.5 * recorded.dt);
  Velocities velocities;
  Observers observers;
  double begin = -1.0;
  observers.history = [&](const Simulation& run, const Sample& sample) {
    if (run.position().stage == 0) return;
    if (begin < 0.0) begin = run.position().stage_start;
    std::vector<double> row;
    for (const Instrument& i : all)
      row.push_back(
          i.sensor.direction.dot(point_velocity(run.model(), run.state(), i.sensor.block, i.sensor.position)));
    // Velocities belong to the middle of the previous time step.
    velocities.times.push_back(sample.time - 0.5 * run.position().dt);
    velocities.rows.push_back(std::move(row));
  };
  std::chrono::steady_clock::time_point said{};
  observers.progress = [&](const Progress& p) {
    const auto now = std::chrono::steady_clock::now();
    if (!p.timed || now - said < std::chrono::seconds(20)) return;
    said = now;
    say(fmt::format("  {}: {:.1f} of {:.1f} s, {:.0f} s left", name, p.time, p.end, p.left));
  };
  Simulation run(assembly, settings, threads, observers);
  run.check();
  if (run.run() != RunEnd::finished)
    throw RunError("{}: the run under the recorded motion failed: {}", name, run.failure());
  if (velocities.rows.empty()) throw RunError("{}: the run under the recorded motion produced no history", name);
  return accelerations(velocities, begin, recorded, all);
}

/// A little above the highest measured mode, because the measurement says nothing about higher frequencies.
double highest_of(const Features& features, const Recording& record) {
  double highest = 0.0;
  for (const MeasuredFeature& mode : features.modes) highest = std::max(highest, 1.25 * mode.frequency);
  return std::min({highest, 20.0, 0.4 / record.dt});
}

/// All three below the same frequency, on the same samples.
Recording filtered(const Recording& record, double highest) {
  const Prepared p = gathered({record}, highest);
  Recording r = record;
  r.dt = p.dt;
  r.channels = p.channels;
  r.values = p.signals.front();
  return r;
}

void match_channels(const Features& features, RecordedMatch& m) {
  double all = 0.0, before = 0.0, after = 0.0;
  for (const Sensor& sensor : features.sensors) {
    const Eigen::Index c = column_of(m.measured, sensor.id);
    if (c < 0) continue;
    const auto error = [&](const Recording& r) { return (r.values.col(c) - m.measured.values.col(c)).squaredNorm(); };
    const double whole = m.measured.values.col(c).squaredNorm(), b = error(m.before), a = error(m.after);
    if (whole == 0.0) continue;
    m.channels.push_back(
        {sensor.id, std::sqrt(whole / double(m.measured.values.rows())), std::sqrt(b / whole), std::sqrt(a / whole)});
    // Each channel has the same weight. Otherwise channels on the ground, which are large and always right, would
    // dominate.
    all += 1.0, before += b / whole, after += a / whole;
  }
  if (all == 0.0) return;
  m.error_before = std::sqrt(before / all);
  m.error_after = std::sqrt(after / all);
}

/// Of magnitudes, in standard deviations of measurement and model: where the measured one is known to a third of
/// itself. A model whose frequencies are right to a per cent is not right to a per cent beside a peak.
double transfer_gap(const TransferFunctions& measured, const TransferFunctions& computed, const ModelError& error) {
  double sum = 0.0, count = 0.0;
  const std::size_t lines = std::min(measured.values.size(), computed.values.size());
  for (std::size_t line = 1; line + 1 < lines; ++line)
    for (Eigen::Index i = 0; i < measured.values[line].size(); ++i) {
      const double size = std::abs(measured.values[line](i)), own = measured.magnitude_std[line](i);
      const double slope =
          0.5 * double(line) * (std::abs(measured.values[line + 1](i)) - std::abs(measured.values[line - 1](i)));
      const double std = std::hypot(own, std::hypot(error.shape, error.participation) * size, error.frequency * slope);
      const double r = (std::abs(computed.values[line](i)) - size) / std;
      if (!(own < size / 3.0) || !std::isfinite(r)) continue;
      sum += r * r;
      count += 1.0;
    }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

void match_transfer(const ModelError& error, RecordedMatch& m) {
  try {
    TransferSettings same;
    same.window = m.duration / 5.0;
    same.highest_frequency = m.highest_frequency;
    m.measured_h = transfer_functions({m.measured}, same);
    m.before_h = transfer_functions({m.before}, same);
    m.after_h = transfer_functions({m.after}, same);
  } catch (const InputError&) {
    m.measured_h = m.before_h = m.after_h = {};  // too short a part
  }
  m.transfer_before = transfer_gap(m.measured_h, m.before_h, error);
  m.transfer_after = transfer_gap(m.measured_h, m.after_h, error);
}

}  // namespace

std::optional<RecordedMatch> run_recorded(const DiagnosisInput& input, const Fit& best, double seconds, int threads,
                                          const Say& say) {
  const std::vector<Recording>& records = input.measured.records;
  const auto at = std::find_if(records.begin(), records.end(), [](const Recording& r) { return has_base_motion({r}); });
  if (at == records.end() || seconds <= 0.0 || input.measured.sensors.empty()) return std::nullopt;
  const auto started = std::chrono::steady_clock::now();
  const auto wanted = std::min(at->values.rows(), Eigen::Index(std::ceil(seconds / at->dt)) + 1);
  const auto before = Eigen::Index(quiet / at->dt);
  const Eigen::Index first = std::clamp<Eigen::Index>(onset(ground_of(*at)) - before, 0, at->values.rows() - wanted);
  const Recording recorded = part(*at, first, wanted);
  RecordedMatch m;
  m.record = at->name;
  m.from = double(first) * at->dt;
  m.duration = recorded.duration();
  say(fmt::format("The explicit solver computes the response to {:.1f} s of {}, before and after", m.duration,
                  m.record));
  const std::vector<EffectSetting> effects = best.hypothesis.settings(best.best.x);
  const DiagnosisProblem& p = input.runs;
  const double highest = highest_of(p.features, recorded);
  m.highest_frequency = highest;
  m.measured = filtered(recorded, highest);
  m.before = filtered(simulate(input, p.base, {}, recorded, threads, "before", say), highest);
  m.after =
      filtered(simulate(input, best.hypothesis.assembly(p.base, best.best.x), effects, recorded, threads, "after", say),
               highest);
  match_channels(p.features, m);
  match_transfer(input.problem.error, m);
  m.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  say(fmt::format("  difference from the recording: {:.0f} % before, {:.0f} % after", 100.0 * m.error_before,
                  100.0 * m.error_after));
  return m;
}

}  // namespace voussoir
