#include "tools/voussoir/run_session.h"

#include <fmt/chrono.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/atomic_file.h"
#include "io/hdf5/checkpoint_file.h"
#include "io/vtk/folder.h"
#include "solver/base/error.h"
#include "solver/step/loads.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

std::atomic<bool> stop_flag{false};

void ask_to_stop(int) {
  stop_flag.store(true);
}

const std::vector<std::pair<std::string, double Energies::*>>& energy_columns() {
  static const std::vector<std::pair<std::string, double Energies::*>> columns = {
      {"kinetic", &Energies::kinetic},
      {"gravitational", &Energies::gravitational},
      {"elastic", &Energies::elastic},
      {"damping_springs", &Energies::damping_springs},
      {"friction", &Energies::friction},
      {"fracture", &Energies::fracture},
      {"joint_damping", &Energies::joint_damping},
      {"body_damping", &Energies::body_damping},
      {"clipping", &Energies::clipping},
      {"external_work", &Energies::external_work}};
  return columns;
}

std::string demand_channel(const DemandPoint& point) {
  return fmt::format("demand/{} {}", point.group, "xyz"[point.axis]);
}

std::vector<Channel> history_channels(const Assembly& assembly) {
  std::vector<Channel> channels = {{"time", "s"}};
  for (const auto& column : energy_columns()) channels.push_back({"energy/" + column.first, "J"});
  channels.push_back({"energy/balance_error", "-"});
  for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("base/displacement_{}", axis), "m"});
  for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("base/acceleration_{}", axis), "m/s2"});
  channels.push_back({"contacts", "-"});
  for (const DemandPoint& point : demand_points(assembly)) channels.push_back({demand_channel(point), "m"});
  for (const Sensor& sensor : assembly.sensors) {
    channels.push_back({"sensors/" + sensor.id + "/displacement", "m"});
    channels.push_back({"sensors/" + sensor.id + "/velocity", "m/s"});
    for (char axis : {'x', 'y', 'z'})
      channels.push_back({fmt::format("sensors/{}/rotation_{}", sensor.id, axis), "rad"});
  }
  return channels;
}

/// Mean over the group's blocks of the displacement of their centroids relative to base and gravity state.
double group_displacement(const Simulation& run, const DemandPoint& point) {
  const std::vector<std::int64_t>& blocks = run.assembly().groups.at(point.group);
  double sum = 0.0;
  for (std::int64_t b : blocks)
    sum += relative_displacement(run.model(), run.state(), b, run.assembly().blocks[b].centroid)[point.axis];
  return sum / double(blocks.size());
}

/// Velocity of a sensor's point along its direction at the last half step, m/s.
double sensor_velocity(const Simulation& run, const Sensor& sensor) {
  const std::int32_t body = run.model().body_of_block[sensor.block];
  const double* motion = &run.state().motion[motion_width * std::size_t(body)];
  const double* pose = &run.state().pose[pose_width * std::size_t(body)];
  const Eigen::Quaterniond q(pose[3], pose[4], pose[5], pose[6]);
  const Body& b = run.model().bodies[body];
  const Vec3 momentum(motion[3], motion[4], motion[5]);
  const Vec3 spin = q * (b.inverse_inertia * (q.conjugate() * momentum));
  const Vec3 arm = q * (sensor.position - b.centroid);
  return sensor.direction.dot(Vec3(motion[0], motion[1], motion[2]) + spin.cross(arm));
}

/// Rotation vector of a sensor's block since the reference placement, rad.
Vec3 sensor_rotation(const Simulation& run, const Sensor& sensor) {
  const Eigen::AngleAxisd turn(rotation_of(run.state(), std::size_t(run.model().body_of_block[sensor.block])));
  return turn.angle() * turn.axis();
}

}  // namespace

std::vector<DemandPoint> demand_points(const Assembly& assembly) {
  std::vector<DemandPoint> points;
  for (const auto& [name, blocks] : assembly.groups) {
    if (blocks.empty()) continue;
    if (name.starts_with("keystone")) points.push_back({name, 0});
    if (name.starts_with("spandrel")) points.push_back({name, 1});
  }
  return points;
}

RunSession::RunSession(const RunRequest& request)
    : request_(request),
      case_(read_case(request.directory + "/case.toml")),
      assembly_(read_assembly(request.directory + "/assembly.h5")),
      assembly_hash_(assembly_hash(assembly_)),
      progress_(request.quiet),
      vtk_(request.directory) {
  simulation_ = std::make_unique<Simulation>(assembly_, case_.settings, request.threads, observers());
  history_ = History(path("history.h5"), history_channels(assembly_));
}

void RunSession::log(const std::string& text) {
  std::ofstream file(path("run.log"), std::ios::app);
  file << fmt::format("{:%Y-%m-%d %H:%M:%S}  {}\n", fmt::localtime(std::time(nullptr)), text);
  if (request_.quiet) return;
  progress_.end();
  fmt::print(stderr, "{}\n", text);
}

Observers RunSession::observers() {
  Observers o;
  o.history = [this](const Simulation&, const Sample& s) { append_history(s); };
  o.fields = [this](Simulation& run) {
    vtk_.write(assembly_, make_snapshot(run.model(), run.state()));
    history_.flush();
  };
  o.checkpoint = [this](Simulation&, bool stage_end) { write_checkpoint(stage_end); };
  o.progress = [this](const Progress& p) { progress_.show(p); };
  o.log = [this](const std::string& text) { log(text); };
  o.stop = &stop_flag;
  return o;
}

void RunSession::append_history(const Sample& s) {
  std::vector<double> row = {s.time};
  for (const auto& column : energy_columns()) row.push_back(s.energies.*column.second);
  row.push_back(s.balance_error);
  for (int c = 0; c < 3; ++c) row.push_back(s.base_displacement[c]);
  for (int c = 0; c < 3; ++c) row.push_back(s.base_acceleration[c]);
  row.push_back(double(s.contacts));
  for (const DemandPoint& point : demand_points(assembly_)) row.push_back(group_displacement(*simulation_, point));
  for (const Sensor& sensor : assembly_.sensors) {
    const Vec3 u = relative_displacement(simulation_->model(), simulation_->state(), sensor.block, sensor.position);
    row.push_back(sensor.direction.dot(u));
    row.push_back(sensor_velocity(*simulation_, sensor));
    const Vec3 turn = sensor_rotation(*simulation_, sensor);
    for (int c = 0; c < 3; ++c) row.push_back(turn[c]);
  }
  history_.append(row);
}

/// Of the last gravity stage, whether it ran now or before a restart.
const Equilibrium& RunSession::equilibrium() const {
  return simulation_->equilibrium().account.empty() ? equilibrium_before_ : simulation_->equilibrium();
}

void RunSession::write_checkpoint(bool stage_end) {
  history_.flush();  // first: a resumed run finds every row up to its checkpoint
  State& state = simulation_->state();
  const RunPosition& p = simulation_->position();
  CheckpointHeader header;
  header.time = state.time();
  header.step = state.step();
  header.stage = p.stage;
  header.stage_time = state.time() - p.stage_start;
  header.assembly_hash = assembly_hash_;
  header.case_hash = case_.hash;
  const Equilibrium& e = equilibrium();
  header.numbers = {
      {"stage_start", p.stage_start},
      {"dt", p.dt},
      {"highest", p.highest},
      {"stiffest", p.stiffest},
      {"stage_begun", p.stage_begun},
      {"worst_balance", simulation_->worst_balance()},
      {"equilibrium_converged", e.converged ? 1.0 : 0.0},
      {"newton_iterations", double(e.iterations)},
      {"relaxation_steps", double(e.steps)},
      {"out_of_balance", e.residual},
      {"wall_seconds",
       before_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count()}};
  const std::string name = checkpoint_name(state.time());
  voussoir::write_checkpoint(path("checkpoints/") + (stage_end ? fmt::format("stage_{:02}_", p.stage) + name : name),
                             header, state.arrays());
  prune_checkpoints(path("checkpoints"), 3);
}

void RunSession::resume() {
  const std::vector<std::string> files = list_checkpoints(path("checkpoints"));
  const bool has_rows = fs::exists(path("history.h5")) && History::load(path("history.h5")).rows() > 0;
  if (files.empty() && has_rows)
    throw InputError("{} has no checkpoint to resume from; start again with voussoir run and --overwrite",
                     request_.directory);
  if (files.empty()) {  // ended before its first checkpoint: nothing has been begun
    vtk_.resume_at(-1.0);
    log("no checkpoint yet: starting from the beginning");
    return;
  }
  for (const std::string& file : files) {
    CheckpointHeader header;
    try {
      State& state = simulation_->state();
      read_checkpoint(file, header, state.arrays());
      state.unpack_contacts();
    } catch (const RunError& e) {
      log(fmt::format("{}; trying the one before", e.what()));
      continue;
    }
    if (header.assembly_hash != assembly_hash_)
      throw InputError("{} belongs to another assembly than {}: put back the assembly of this run, or start a new one",
                       file, path("assembly.h5"));
    if (header.case_hash != case_.hash)
      throw InputError("{} belongs to another case than {}: put back the case of this run, or start a new one", file,
                       path("case.toml"));
    go_on_from(header);
    log(fmt::format("resuming at t = {:.4f} s from {}", header.time, file));
    return;
  }
  throw InputError("none of the {} checkpoints in {} can be read; start again with voussoir run and --overwrite",
                   files.size(), path("checkpoints"));
}

/// After the state has been read.
void RunSession::go_on_from(CheckpointHeader& header) {
  RunPosition p;
  p.stage = header.stage;
  p.stage_start = header.numbers["stage_start"];
  p.dt = header.numbers["dt"];
  p.highest = header.numbers["highest"];
  p.stiffest = header.numbers["stiffest"];
  p.stage_begun = header.numbers["stage_begun"];
  equilibrium_before_.converged = header.numbers["equilibrium_converged"] > 0.0;
  equilibrium_before_.iterations = int(header.numbers["newton_iterations"]);
  equilibrium_before_.steps = std::int64_t(header.numbers["relaxation_steps"]);
  equilibrium_before_.residual = header.numbers["out_of_balance"];
  before_seconds_ = header.numbers["wall_seconds"];
  simulation_->restore(p);
  simulation_->note_balance(header.numbers["worst_balance"]);
  if (fs::exists(path("history.h5"))) history_ = History::load(path("history.h5"));
  history_.truncate_after(std::nextafter(header.time, -1.0));  // the row of this very step is sampled again
  vtk_.resume_at(header.time);
}

namespace {

nlohmann::json demand_json(const Assembly& assembly, const History& history) {
  nlohmann::json demand = {{"places", nlohmann::json::object()}};
  std::map<std::string, std::pair<double, double>> sums;
  std::map<std::string, int> counts;
  for (const DemandPoint& point : demand_points(assembly)) {
    const std::vector<double>& values = history.values(demand_channel(point));
    double largest = 0.0;
    for (double v : values) largest = std::max(largest, std::abs(v));
    const double residual = values.empty() ? 0.0 : values.back();
    demand["places"][point.group] = {
        {"axis", std::string(1, "xyz"[point.axis])}, {"largest", largest}, {"residual", residual}};
    const std::string kind = point.axis == 0 ? "keystone_x" : "spandrel_y";
    sums[kind].first += largest;
    sums[kind].second += std::abs(residual);
    ++counts[kind];
  }
  for (const auto& [kind, sum] : sums)
    demand[kind] = {{"largest_mean", sum.first / counts[kind]}, {"residual_mean", sum.second / counts[kind]}};
  return demand;
}

/// Per component: share of the area of its bonded joints whose bond is lost, largest opening and slip (m).
nlohmann::json damage_json(const Assembly& assembly, const Snapshot& snapshot) {
  struct Damage {
    double bonded = 0.0, broken = 0.0, opening = 0.0, slip = 0.0;
  };
  std::map<std::string, Damage> damage;
  for (const PatchSnapshot& p : snapshot.patches)
    for (std::int64_t block : {p.a, p.b}) {
      Damage& d = damage[component_names()[std::size_t(assembly.blocks[block].component)]];
      if (p.had_bond) d.bonded += p.area, d.broken += p.area * (1.0 - p.bonded);
      d.opening = std::max(d.opening, p.largest_opening);
      d.slip = std::max(d.slip, p.largest_slip);
    }
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, d] : damage)
    json[name] = {{"broken_share", d.bonded > 0.0 ? d.broken / d.bonded : 0.0},
                  {"largest_opening", d.opening},
                  {"largest_slip", d.slip}};
  return json;
}

/// Of each sensor's displacement: largest size, value at the end, and until when (s) it differed from that by more than
/// 1e-5 of the largest; first_zero (s): when it first changed sign (linear between rows, 0 when it never did). Of its
/// block: largest rotation (rad), and whether it ended more than 45° from where it stood.
nlohmann::json sensors_json(const Assembly& assembly, const History& history) {
  nlohmann::json json = nlohmann::json::object();
  for (const Sensor& sensor : assembly.sensors) {
    const std::vector<double>& u = history.values("sensors/" + sensor.id + "/displacement");
    if (u.empty()) continue;
    double largest = 0.0;
    for (double x : u) largest = std::max(largest, std::abs(x));
    std::size_t last = u.size();
    while (last > 0 && std::abs(u[last - 1] - u.back()) <= 1e-5 * largest) --last;
    double first_zero = 0.0, turned = 0.0, most_turned = 0.0;
    for (std::size_t i = 1; i < u.size() && first_zero == 0.0; ++i)
      if (u[i - 1] * u[i] < 0.0)
        first_zero = history.time()[i - 1] + u[i - 1] / (u[i - 1] - u[i]) * (history.time()[i] - history.time()[i - 1]);
    std::array<const std::vector<double>*, 3> turn;
    for (int c = 0; c < 3; ++c)
      turn[std::size_t(c)] = &history.values(fmt::format("sensors/{}/rotation_{}", sensor.id, "xyz"[c]));
    for (std::size_t i = 0; i < u.size(); ++i) {
      turned = Vec3((*turn[0])[i], (*turn[1])[i], (*turn[2])[i]).norm();
      most_turned = std::max(most_turned, turned);
    }
    json[sensor.id] = {{"largest", largest},
                       {"residual", u.back()},
                       {"moves_until", last > 0 ? history.time()[last - 1] : 0.0},
                       {"first_zero", first_zero},
                       {"largest_rotation", most_turned},
                       {"overturned", turned > 0.25 * std::numbers::pi}};
  }
  return json;
}

/// An earlier part of the run's; empty when there is none.
nlohmann::json summary_of(const std::string& file) {
  std::ifstream in(file);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  return json.is_object() ? json : nlohmann::json::object();
}

/// How far the multiplier went, and which joints move beyond.
nlohmann::json collapse_json(const Simulation& run) {
  const Collapse& c = run.collapse();
  const StageSettings& stage = run.settings().stages.back();
  nlohmann::json json = {{"found", c.found},
                         {"multiplier", c.multiplier},
                         {"above", c.found ? nlohmann::json(c.above) : nlohmann::json()},
                         {"tries", c.tries.size()},
                         {"mechanism", nlohmann::json::array()},
                         {"stands_below", c.stands_below ? nlohmann::json(*c.stands_below) : nlohmann::json()},
                         {"falls_above", c.falls_above ? nlohmann::json(*c.falls_above) : nlohmann::json()}};
  if (stage.collapse.tilt) json["tilt_degrees"] = std::atan(c.multiplier) * 180.0 / std::numbers::pi;
  const Loads loads = loads_at({}, stage, run.model().gravity, c.multiplier);
  double weight = 0.0;
  for (const Body& body : run.model().bodies)
    if (!body.fixed) weight += body.mass * run.model().gravity.norm();
  Vec3 force = Vec3::Zero();
  for (const ForceLoad& load : loads.forces) force += load.force;
  json["force"] = force.norm();
  json["force_over_weight"] = weight > 0.0 ? force.norm() / weight : 0.0;
  json["acceleration_over_gravity"] = loads.acceleration.norm() / std::max(run.model().gravity.norm(), 1e-300);
  for (const MechanismJoint& joint : c.mechanism)
    json["mechanism"].push_back({{"a", joint.a},
                                 {"b", joint.b},
                                 {"kind", joint.slides ? "slide" : "hinge"},
                                 {"edge", edge_name(run.assembly(), joint)},
                                 {"place", {joint.place.x(), joint.place.y(), joint.place.z()}},
                                 {"opening", joint.opening},
                                 {"slip", joint.slip}});
  return json;
}

}  // namespace

void RunSession::write_summary(RunEnd end) {
  Simulation& run = *simulation_;
  const Snapshot snapshot = make_snapshot(run.model(), run.state());
  const double wall =
      before_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const Equilibrium& e = equilibrium();
  nlohmann::json json = {{"program_version", VOUSSOIR_VERSION},
                         {"finished", end == RunEnd::finished},
                         {"end_time", run.state().time()},
                         {"steps", run.state().step()},
                         {"time_step", run.position().dt},
                         {"wall_seconds", wall},
                         {"threads", run.threads()},
                         {"state_hash", fmt::format("{:016x}", hash_arrays(run.state().arrays()))},
                         {"energy_error", run.worst_balance()},
                         {"blocks", assembly_.blocks.size()},
                         {"joints", assembly_.joints.size()},
                         {"contacts", run.state().contacts.size()},
                         {"equilibrium",
                          {{"converged", e.converged},
                           {"newton_iterations", e.iterations},
                           {"relaxation_steps", e.steps},
                           {"out_of_balance", e.residual}}},
                         {"demand", demand_json(assembly_, history_)},
                         {"sensors", sensors_json(assembly_, history_)},
                         {"damage", damage_json(assembly_, snapshot)}};
  if (!run.collapse().tries.empty())
    json["collapse"] = collapse_json(run);
  else if (const nlohmann::json before = summary_of(path("summary.json")); before.contains("collapse"))
    json["collapse"] = before["collapse"];  // found before a restart
  write_atomically(path("summary.json"), json.dump(2) + "\n");
}

/// The simulation and its files; what cannot be written ends it with words on how to go on.
RunEnd RunSession::simulate() {
  try {
    for (const char* folder : {"checkpoints/", "vtk/"}) make_folder_of(path(folder));
    const RunEnd end = simulation_->run(request_.until);
    progress_.end();
    history_.flush();
    const bool stopped = end == RunEnd::interrupted && stop_flag.load();
    if (end == RunEnd::interrupted && !stopped) write_checkpoint(false);  // --until
    if (!stopped) write_summary(end);
    return end;
  } catch (const RunError& error) {
    progress_.end();
    throw RunError("{}\nWhat was written before is whole; go on with: voussoir resume {}", error.what(),
                   request_.directory);
  }
}

int RunSession::run() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  const RunEnd end = simulate();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  if (end == RunEnd::failed)
    throw RunError("{}\nThe last good checkpoints are in {}", simulation_->failure(), path("checkpoints"));
  if (end == RunEnd::interrupted && stop_flag.load()) {
    log(fmt::format("stopped at t = {:.4f} s; go on with: voussoir resume {}", simulation_->state().time(),
                    request_.directory));
    return 1;
  }
  log(fmt::format("{} at t = {:.3f} s: {} steps in {}, largest energy error {:.2e}",
                  end == RunEnd::finished ? "done" : "paused", simulation_->state().time(), simulation_->state().step(),
                  duration_text(wall), simulation_->worst_balance()));
  if (end == RunEnd::finished && request_.pictures) {
    const std::string missing = make_pictures(request_.directory, *simulation_,
                                              make_snapshot(simulation_->model(), simulation_->state()), history_);
    log(missing.empty() ? fmt::format("pictures in {}", path("images")) : "no pictures: " + missing);
  }
  return 0;
}

}  // namespace voussoir
