#include "tools/convergence/specimens.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "geometry/generator.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "solver/step/critical_step.h"

namespace voussoir {

namespace {

constexpr double gravity = 9.81;      // m/s2
constexpr double unbreakable = 1e12;  // Pa
constexpr int sample_count = 40;

/// The assembly of a generator with some of its keys and the strength of its only material set.
Assembly generated(const std::string& name, const std::map<std::string, double>& values, double friction_coefficient,
                   double strength) {
  const Generator& generator = find_generator(name);
  GeneratorInput input = default_input(generator);
  for (const auto& [key, value] : values) input.values.at(key) = value;
  for (auto& [material, m] : input.materials) {
    m.friction_angle = std::atan(friction_coefficient);
    m.tensile_strength = m.cohesion = strength;
  }
  return generator.build(input);
}

SolverSettings undamped(const Vec3& acceleration) {
  SolverSettings settings;
  settings.gravity = acceleration;
  settings.damping.kind = DampingSettings::Kind::none;
  return settings;
}

void finish(Simulation& run, const std::string& what) {
  if (run.run() != RunEnd::finished) throw RunError("{}: {}", what, run.failure());
}

const double* pose_of(const Simulation& run, const std::string& group) {
  const auto block = std::size_t(run.assembly().groups.at(group).front());
  return &run.state().pose[pose_width * std::size_t(run.model().body_of_block[block])];
}

/// Of a group along x, m.
double mean_displacement(const Simulation& run, const std::string& group) {
  const auto& blocks = run.assembly().groups.at(group);
  double sum = 0.0;
  for (std::int64_t block : blocks)
    sum += run.state().pose[pose_width * std::size_t(run.model().body_of_block[std::size_t(block)])];
  return sum / double(blocks.size());
}

/// Middle of the bracket of the multiplier.
double multiplier(const Assembly& assembly, SolverSettings settings, const Loads& pattern, double to,
                  double tolerance) {
  StageSettings collapse;
  collapse.kind = StageSettings::Kind::collapse;
  collapse.loads = pattern;
  collapse.collapse.to = to;
  collapse.collapse.tolerance = tolerance;
  collapse.collapse.confirm = 0.0;
  settings.stages.push_back(collapse);
  Simulation run(assembly, settings, 1, {});
  finish(run, "collapse");
  if (!run.collapse().found) throw RunError("no collapse: {}", run.collapse().account);
  return 0.5 * (run.collapse().multiplier + run.collapse().above);
}

double sideways_multiplier(const Assembly& assembly, int points, double tolerance) {
  SolverSettings settings;
  settings.contact.points_per_side = points;
  settings.step.equilibrium_tolerance = 1e-9;
  settings.stages = {StageSettings{}};
  Loads pattern;
  pattern.acceleration = Vec3(gravity, 0, 0);
  return multiplier(assembly, settings, pattern, 1.0, tolerance);
}

Assembly block_on_a_bed(double friction_coefficient) {
  return generated(
      "column",
      {{"blocks", 1}, {"width", bed_side}, {"depth", bed_side}, {"block_height", 0.5}, {"kn", bed_kn}, {"ks", bed_kn}},
      friction_coefficient, 0.0);
}

Assembly slab(double kn) {
  return generated(
      "column",
      {{"blocks", 1}, {"width", slab_width}, {"depth", 1.0}, {"block_height", slab_height}, {"kn", kn}, {"ks", kn}},
      0.75, 0.0);
}

double slab_weight() {
  const Assembly assembly = slab(1e9);
  return gravity * assembly.blocks[std::size_t(assembly.groups.at("top").front())].mass;
}

/// Of a lean θ: tan(α − θ) = tan α − (1 + tan² α) θ, with tan α = B/H.
constexpr double lean_factor = 1.0 + slab_width * slab_width / (slab_height * slab_height);

constexpr double rocking_width = 0.6, rocking_height = 2.4;  // m

Assembly rocking_block(double kn) {
  return generated("column",
                   {{"blocks", 1},
                    {"width", rocking_width},
                    {"depth", 0.6},
                    {"block_height", rocking_height},
                    {"base_width", 8.0},
                    {"base_depth", 2.0},
                    {"kn", kn},
                    {"ks", 0.4 * kn}},
                   2.0, 0.0);
}

/// Base acceleration A sin(2πt/T) (1 − cos(2πt/T)) along x. It begins and ends with three vanishing derivatives and
/// leaves no velocity, so that only the time step limits the smoothness. In 4000 pieces.
GroundMotion smooth_pulse(double amplitude, double length) {
  GroundMotion motion;
  motion.dt = length / 4000.0;
  for (int i = 0; i <= 4000; ++i) {
    const double phase = 2.0 * pi * i / 4000.0;
    motion.acceleration.emplace_back(amplitude * std::sin(phase) * (1.0 - std::cos(phase)), 0.0, 0.0);
  }
  return motion;
}

double critical(const Assembly& assembly, const SolverSettings& settings) {
  const Simulation run(assembly, settings, 1, {});
  return critical_step(run.model(), run.state()).step;
}

/// The response after gravity, sampled sample_count times until `duration`. The number of time steps at 0.8 of the
/// critical one is rounded up to whole samples. Other shares are in proportion, so that all runs have the same sample
/// times.
PulseResponse respond(const Assembly& assembly, const GroundMotion& motion, double duration, double share) {
  SolverSettings settings = undamped({0, 0, -gravity});
  settings.step.equilibrium_tolerance = 1e-10;
  const double coarsest = 0.8 * critical(assembly, settings);
  const double a_sample = std::ceil(duration / sample_count / coarsest);
  PulseResponse response;
  response.dt = duration / sample_count / std::max(1.0, std::round(a_sample * 0.8 / share));
  settings.step.time_step = response.dt;
  settings.output.history_every = duration / sample_count;
  settings.output.fields_every = 0.0;
  settings.output.checkpoint_every = 0.0;
  StageSettings shaken;
  shaken.kind = StageSettings::Kind::motion;
  shaken.motion = motion;
  shaken.duration = duration * (1.0 + 0.5 / sample_count);  // past the last sample
  settings.stages = {StageSettings{}, shaken};
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    response.displacement.push_back(mean_displacement(run, "top") - s.base_displacement.x());
  };
  Simulation run(assembly, settings, 1, observers);
  finish(run, "motion");
  response.worst_balance = run.worst_balance();
  return response;
}

/// Share of a side's weight on its end, and the distance from there to the next point (share of the side):
/// Gauss–Lobatto, Abramowitz & Stegun 1964, table 25.6.
struct EdgeRow {
  double weight = 0.0, gap = 0.0;
};
EdgeRow edge_row(int points) {
  if (points == 3) return {1.0 / 6.0, 0.5};
  if (points == 4) return {1.0 / 12.0, 0.5 * (1.0 - std::sqrt(1.0 / 5.0))};
  return {1.0 / 20.0, 0.5 * (1.0 - std::sqrt(3.0 / 7.0))};
}

}  // namespace

Bed exact_bed(double eccentricity) {
  const double b = bed_side, e = eccentricity * b, mean = bed_force / (bed_kn * b * b);
  if (e <= b / 6.0) return {12.0 * mean * e / (b * b), mean};
  const double c = 3.0 * (0.5 * b - e), edge = 2.0 * bed_force / (c * b * bed_kn), turn = edge / c;
  return {turn, turn * (c - 0.5 * b)};
}

Bed computed_bed(double eccentricity, int points) {
  SolverSettings settings = undamped(Vec3::Zero());
  settings.contact.points_per_side = points;
  settings.step.equilibrium_tolerance = 1e-10;
  StageSettings loaded;
  loaded.loads = Loads{Vec3::Zero(), {{"top", {0, 0, -bed_force}, Vec3(eccentricity * bed_side, 0, 0)}}, {}};
  settings.stages = {loaded};
  const Assembly assembly = block_on_a_bed(0.6);
  Simulation run(assembly, settings, 1, {});
  finish(run, "bed");
  const double* pose = pose_of(run, "top");
  return {2.0 * std::asin(pose[5]), -pose[2]};
}

double torsion_capacity(int points) {
  const double mu = 0.6, a = bed_side;
  const double exact = mu * bed_force * a * (std::sqrt(2.0) + std::asinh(1.0)) / 6.0;
  SolverSettings settings = undamped(Vec3::Zero());
  settings.contact.points_per_side = points;
  StageSettings pressed;
  pressed.loads = Loads{Vec3::Zero(), {{"top", {0, 0, -bed_force}, Vec3(0, 0, 0)}}, {}};
  settings.stages = {pressed};
  Loads couple;  // at the level of the joint, so that it does not tip
  couple.forces = {{"top", {0, exact / a, 0}, Vec3(0.5 * a, 0, 0)}, {"top", {0, -exact / a, 0}, Vec3(-0.5 * a, 0, 0)}};
  return multiplier(block_on_a_bed(mu), settings, couple, 2.0, 1e-4);
}

double arch_multiplier(double kn, int points) {
  const Assembly arch = generated("arch",
                                  {{"mean_radius", 10.0},
                                   {"thickness_ratio", 0.15},
                                   {"embrace_angle", 157.5},
                                   {"voussoirs", 7},
                                   {"kn", kn},
                                   {"ks", kn}},
                                  std::tan(80.0 * pi / 180.0), 0.0);
  return sideways_multiplier(arch, points, 2e-6);
}

double slab_multiplier(double kn, int points) {
  return sideways_multiplier(slab(kn), points, 2e-7);
}

double slab_loss(double kn, int points) {
  const EdgeRow row = edge_row(points);
  return lean_factor * slab_weight() / (row.weight * row.gap * kn * slab_width * slab_width);
}

double slab_loss_of_an_elastic_face(double kn) {
  const double lean = std::pow(std::sqrt(2.0 * slab_weight() / kn) / (3.0 * slab_height * lean_factor), 2.0 / 3.0);
  return 3.0 * lean_factor * lean;
}

double exact_rocking_quarter(double width, double height, double start) {
  const double alpha = std::atan(width / height), p2 = 3.0 * gravity / (2.0 * std::hypot(width, height));
  // ½ θ'² = p² (cos(α − θ0) − cos(α − θ)); θ = θ0 (1 − x²) takes the root's singularity out. Midpoint rule.
  double sum = 0.0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n, theta = start * (1 - x * x);
    sum += 2 * start * x / std::sqrt(2 * p2 * (std::cos(alpha - start) - std::cos(alpha - theta))) / n;
  }
  return sum;
}

double exact_rocking_quarter() {
  return exact_rocking_quarter(rocking_width, rocking_height, 0.5 * std::atan(rocking_width / rocking_height));
}

double rocking_quarter(double kn, bool reclip) {
  const double step = 2e-6;  // s
  SolverSettings settings = undamped({0, 0, -gravity});
  if (!reclip) settings.contact.reclip_angle = 0.5;
  settings.step.time_step = settings.output.history_every = step;
  settings.output.fields_every = settings.output.checkpoint_every = 0.0;
  StageSettings swing;
  swing.kind = StageSettings::Kind::free;
  swing.duration = 1.0;
  swing.placements = {{"top", Vec3::Zero(), 0.5 * std::atan(rocking_width / rocking_height), Vec3::UnitY(),
                       Vec3(0.5 * rocking_width, 0, 0)}};
  settings.stages = {StageSettings{}, swing};
  std::atomic<bool> stop = false;
  double before = 0.0, crossing = 0.0;
  Observers observers;
  observers.stop = &stop;
  observers.history = [&](const Simulation& run, const Sample& s) {
    const double now = pose_of(run, "top")[5];
    if (before > 0.0 && now < 0.0 && crossing == 0.0) crossing = s.time - step * now / (now - before), stop = true;
    before = now;
  };
  const Assembly assembly = rocking_block(kn);
  Simulation run(assembly, settings, 1, observers);
  if (run.run() == RunEnd::failed || crossing == 0.0) throw RunError("rocking: no impact. {}", run.failure());
  return crossing;
}

LetGo let_go(double share) {
  const double kn = 4e9, start = 1e-5;
  const Assembly assembly = generated("column", {{"blocks", 1}, {"kn", kn}, {"ks", 0.4 * kn}}, 0.6, unbreakable);
  SolverSettings settings = undamped(Vec3::Zero());
  LetGo result;
  const Block& block = assembly.blocks[std::size_t(assembly.groups.at("top").front())];
  result.exact = std::sqrt(kn * 1.0 / block.mass);
  const double quarter = 0.5 * pi / result.exact;
  // A whole number of time steps to the quarter after a cycle.
  const auto steps = std::size_t(std::ceil(5.0 * quarter / (share * critical(assembly, settings))));
  result.dt = 5.0 * quarter / double(steps);
  settings.step.time_step = settings.output.history_every = result.dt;
  StageSettings swing;
  swing.kind = StageSettings::Kind::free;
  swing.duration = 40.0 * quarter;
  swing.placements = {{"top", {0, 0, start}}};
  settings.stages = {swing};
  std::vector<double> x;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample&) { x.push_back(pose_of(run, "top")[2] / start); };
  Simulation run(assembly, settings, 1, observers);
  finish(run, "released block");
  // Equal steps through a harmonic: x(n+1) + x(n−1) = 2 cos(ω Δt) x(n) exactly; the cosine by least squares.
  double up = 0.0, down = 0.0;
  for (std::size_t n = 1; n + 1 < x.size(); ++n) up += (x[n + 1] + x[n - 1]) * x[n], down += 2.0 * x[n] * x[n];
  result.frequency = std::acos(up / down) / result.dt;
  result.displacement = x.at(steps);
  result.expected = std::cos(result.exact * 5.0 * quarter);
  return result;
}

PulseResponse column_response(double share) {
  static const Assembly column = generated("column", {{"kn", 4e9}, {"ks", 1.6e9}}, 0.6, unbreakable);
  return respond(column, smooth_pulse(2.0, 0.1), 0.4, share);
}

PulseResponse rocking_response(double share) {
  static const Assembly block = rocking_block(1e9);
  return respond(block, smooth_pulse(3.0, 0.4), 0.8, share);
}

PulseResponse wall_response(double share, double scale) {
  static const Assembly wall =
      generated("wall", {{"length_blocks", 4}, {"courses", 4}, {"kn", 4e9}, {"ks", 1.6e9}}, 0.4, 0.0);
  return respond(wall, smooth_pulse(6.0 * scale, 0.4), 0.6, share);
}

double peak(const PulseResponse& response) {
  double largest = 0.0;
  for (double u : response.displacement) largest = std::max(largest, std::abs(u));
  return largest;
}

double difference(const PulseResponse& response, const PulseResponse& reference) {
  double most = 0.0;
  for (std::size_t i = 0; i < reference.displacement.size(); ++i)
    most = std::max(most, std::abs(response.displacement.at(i) - reference.displacement[i]));
  return most / peak(reference);
}

Push push_wall(double duration, double local) {
  static const Assembly wall = generated("wall",
                                         {{"length_blocks", 5},
                                          {"courses", 9},
                                          {"block_length", 0.2},
                                          {"thickness", 0.2},
                                          {"block_height", 0.1},
                                          {"beam_height", 0.2},
                                          {"kn", 7.56e9},
                                          {"ks", 3.0e9}},
                                         std::tan(31.7989 * pi / 180.0), 0.0);
  SolverSettings settings = undamped({0, 0, -gravity});
  if (local > 0.0) settings.damping.kind = DampingSettings::Kind::local, settings.damping.coefficient = local;
  settings.guides = {{"beam", {false, false, true}}};
  settings.output.history_every = std::max(2e-4, duration / 4000.0);
  settings.output.fields_every = settings.output.checkpoint_every = 0.0;
  StageSettings loaded, pushed;
  loaded.loads = Loads{Vec3::Zero(), {{"beam", {0, 0, -1e5}, {}}}, {}};
  pushed.kind = StageSettings::Kind::free;
  pushed.duration = duration;
  pushed.drives = {{"beam", Vec3::Zero(), {0.01, 0, 0}}};
  settings.stages = {loaded, pushed};
  Push push;
  Observers observers;
  observers.history = [&](const Simulation& run, const Sample& s) {
    if (!run.settings().stages[std::size_t(s.stage)].timed()) return;
    const std::vector<std::string>& held = run.held_groups();
    push.end = s.reactions.at(std::size_t(std::ranges::find(held, "beam") - held.begin())).x();
    push.peak = std::max(push.peak, push.end);
  };
  Simulation run(wall, settings, 1, observers);
  finish(run, "push");
  return push;
}

}  // namespace voussoir
