#include "tools/run/run_session.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/joint_counts.h"
#include "io/case/remarks.h"
#include "io/hdf5/assembly_file.h"
#include "io/hdf5/checkpoint_file.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"
#include "solver/base/json_file.h"
#include "solver/step/make_snapshot.h"
#include "tools/run/gravity_report.h"
#include "tools/run/history_rows.h"
#include "tools/run/inventory.h"
#include "tools/run/provenance.h"
#include "tools/run/run_page.h"
#include "tools/run/steps_report.h"
#include "tools/run/stop_request.h"
#include "tools/run/stress_table.h"
#include "tools/run/summary.h"
#include "tools/run/thrust.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

std::atomic<bool> late_flag{false};

void time_is_up(int) {
  late_flag.store(true);
  stop_request().store(true);
}

}  // namespace

void RunSession::forget_stop() {
  stop_request().store(false), late_flag.store(false);
}

RunSession::RunSession(const RunRequest& request)
    : request_(request),
      case_(read_case(request.directory + "/case.toml")),
      assembly_(read_assembly(request.directory + "/assembly.h5")),
      assembly_hash_(assembly_hash(assembly_)),
      progress_(request.quiet),
      vtk_(request.directory, request.packing) {
  simulation_ = std::make_unique<Simulation>(assembly_, case_.settings, request.threads, observers());
  if (simulation_->quasi_static()) deck_ = DeckLine(assembly_);
  history_ = History(path("history.h5"), history_channels(*simulation_));
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
    vtk_.write(assembly_, make_snapshot(run.model(), run.state()), request_.threads);
    history_.flush();
  };
  o.ended = [this](const Simulation&, std::int64_t stage) {
    if (case_.settings.stages[std::size_t(stage)].kind == StageSettings::Kind::gravity) report_gravity();
  };
  o.checkpoint = [this](Simulation&, bool stage_end) { write_checkpoint(stage_end); };
  o.progress = [this](const Progress& p) {
    progress_.show(p);
    if (request_.progress) request_.progress(p);
  };
  o.log = [this](const std::string& text) { log(text); };
  o.stop = &stop_request();
  return o;
}

void RunSession::append_history(const Sample& s) {
  history_.append(history_row(*simulation_, s, deck_));
  if (!fallen_ && has_fallen()) {
    fallen_ = true;
    stop_request().store(true);
  }
}

double RunSession::fallen_share() const {
  return voussoir::fallen_share(simulation_->model(), simulation_->state(), request_.fall_displacement);
}

/// The equilibrium of the last gravity stage, computed in this session or before a restart.
const Equilibrium& RunSession::equilibrium() const {
  return simulation_->equilibrium().account.empty() ? equilibrium_before_ : simulation_->equilibrium();
}

/// Writes the report of the gravity stage that has just ended to the log and, after those of earlier ones, to
/// gravity.json.
void RunSession::report_gravity() {
  const Simulation& run = *simulation_;
  const nlohmann::json report =
      gravity_report(run, make_snapshot(run.model(), run.state()), case_.settings.output.gravity_modes);
  nlohmann::json all = json_if_any(path("gravity.json"));
  if (!all.is_array()) all = nlohmann::json::array();
  while (!all.empty() && all.back().value("stage", 0) >= report["stage"]) all.erase(all.size() - 1);  // run again
  all.push_back(report);
  write_json(path("gravity.json"), all);
  log(gravity_text(report));
}

void RunSession::write_checkpoint(bool stage_end) {
  history_.flush();  // first, so that a resumed run finds every row up to its checkpoint
  const std::string name = checkpoint_name(simulation_->state().time());
  const std::string file = stage_end ? fmt::format("stage_{:02}_", simulation_->position().stage) + name : name;
  voussoir::write_checkpoint(path("checkpoints/") + file, own_header(), simulation_->state().arrays());
  prune_checkpoints(path("checkpoints"), 3);
}

CheckpointHeader RunSession::own_header() {
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
      {"stiffest_node", p.stiffest_node},
      {"stage_begun", p.stage_begun},
      {"stops", p.stops},
      {"along", p.along},
      {"multiplier", p.multiplier},
      {"worst_balance", simulation_->worst_balance()},
      {"history_rows", double(history_.rows())},
      {"frames", double(vtk_.blocks().frames().size())},
      {"equilibrium_converged", e.converged ? 1.0 : 0.0},
      {"newton_iterations", double(e.iterations)},
      {"relaxation_steps", double(e.steps)},
      {"out_of_balance", e.residual},
      {"wall_seconds",
       before_seconds_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count()}};
  return header;
}

void RunSession::resume() {
  const std::vector<std::string> files = list_checkpoints(path("checkpoints"));
  const bool has_rows = fs::exists(path("history.h5")) && History::load(path("history.h5")).rows() > 0;
  if (files.empty() && has_rows)
    throw InputError(
        "{} has no checkpoint from which the run could be resumed. Start again with voussoir run and --overwrite",
        request_.directory);
  if (files.empty()) {  // the run was stopped before its first checkpoint
    vtk_.keep_first(0);
    log("there is no checkpoint yet, so the run starts from the beginning");
    return;
  }
  for (const std::string& file : files) {
    CheckpointHeader header;
    try {
      State& state = simulation_->state();
      read_checkpoint(file, header, state.arrays());
      state.unpack(simulation_->model());
    } catch (const RunError& e) {
      log(fmt::format("{} The program tries the checkpoint before it.", e.what()));
      continue;
    }
    if (header.assembly_hash != assembly_hash_)
      throw InputError("{} belongs to another assembly than {}. Restore the assembly of this run, or start a new run",
                       file, path("assembly.h5"));
    if (header.case_hash != case_.hash)
      throw InputError("{} belongs to another case than {}. Restore the case of this run, or start a new run", file,
                       path("case.toml"));
    go_on_from(header);
    log(fmt::format("resuming at t = {:.4f} s from {}", header.time, file));
    return;
  }
  throw InputError("none of the {} in {} can be read. Start again with voussoir run and --overwrite",
                   counted(files.size(), "checkpoint"), path("checkpoints"));
}

void RunSession::begin_where(const std::string& other) {
  const std::vector<std::string> files = list_checkpoints(other + "/checkpoints");
  if (files.empty())
    throw InputError(
        "{} has no checkpoint from which the run could start. Remove the folder, then it is computed again", other);
  CheckpointHeader header;
  State& state = simulation_->state();
  read_checkpoint(files.front(), header, state.arrays());
  if (header.assembly_hash != assembly_hash_)
    throw InputError("{} belongs to another assembly than {}", files.front(), path("assembly.h5"));
  for (const char* name : {"history.h5", "gravity.json", "vtk"})
    if (fs::exists(other + "/" + name))
      fs::copy(other + "/" + name, path(name), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  state.unpack(simulation_->model());
  go_on_from(header);
  before_seconds_ = 0.0;  // the time of the shared stages is not counted again
  for (const char* folder : {"checkpoints/", "vtk/"}) make_folder_of(path(folder));
  voussoir::write_checkpoint(path("checkpoints/") + fs::path(files.front()).filename().string(), own_header(),
                             state.arrays());
  log("equilibrium under gravity taken from " + other);
}

/// Restores position, history and frames after the state has been read.
void RunSession::go_on_from(const CheckpointHeader& header) {
  RunPosition p;
  p.stage = header.stage;
  p.stage_start = header.number("stage_start");
  p.dt = header.number("dt");
  p.highest = header.number("highest");
  p.stiffest = header.number("stiffest");
  p.stiffest_node = header.number("stiffest_node");
  p.stage_begun = header.number("stage_begun");
  if (header.numbers.contains("stops"))  // earlier versions had no quasi-static stages
    p.stops = header.number("stops"), p.along = header.number("along"), p.multiplier = header.number("multiplier");
  equilibrium_before_.converged = header.number("equilibrium_converged") > 0.0;
  equilibrium_before_.iterations = int(header.count("newton_iterations"));
  equilibrium_before_.steps = header.count("relaxation_steps");
  equilibrium_before_.residual = header.number("out_of_balance");
  before_seconds_ = header.number("wall_seconds");
  simulation_->restore(p);
  simulation_->note_balance(header.number("worst_balance"));
  if (fs::exists(path("history.h5"))) history_ = History::load(path("history.h5"));
  history_.keep_first(std::size_t(header.count("history_rows")));
  vtk_.keep_first(std::size_t(header.count("frames")));
}

namespace {

/// A member of the summary of an earlier part of the run; empty if there is none.
nlohmann::json summary_of(const std::string& file) {
  const nlohmann::json json = json_if_any(file);
  return json.is_object() ? json : nlohmann::json::object();
}

std::string curve_table(const Collapse& collapse) {
  std::string text = "multiplier,along_m,largest_m,settled\n";
  for (const CollapsePoint& p : collapse.curve)
    text += fmt::format("{:.10g},{:.10g},{:.10g},{}\n", p.multiplier, p.along, p.largest, int(p.settled));
  return text;
}

}  // namespace

void RunSession::write_summary(RunEnd end) {
  Simulation& run = *simulation_;
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
                         {"joint_kinds", joint_kinds_json(assembly_)},
                         {"contacts", run.state().contact_count()},
                         {"equilibrium",
                          {{"converged", e.converged},
                           {"newton_iterations", e.iterations},
                           {"relaxation_steps", e.steps},
                           {"out_of_balance", e.residual}}}};
  json["remarks"] = nlohmann::json::array();
  for (const std::string& remark : remarks(case_, assembly_))  // the path of the folder is left out
    json["remarks"].push_back(remark.starts_with(path("")) ? remark.substr(path("").size()) : remark);
  if (fallen_) json["fallen"] = {{"time", run.state().time()}, {"share_of_mass", fallen_share()}};
  const RunCosts& costs = run.costs();
  json["seconds_of_this_part"] = {
      {"equilibrium", costs.equilibrium}, {"steps", costs.steps},   {"contact_searches", costs.searches},
      {"history", costs.history},         {"fields", costs.fields}, {"reports", costs.reports},
      {"checkpoints", costs.checkpoints}};
  if (const MassScaling& scaling = run.mass_scaling(); scaling.at_work())
    json["mass_scaling"] = {{"share", scaling.share},     {"blocks", scaling.bodies},
                            {"heavier", scaling.heavier}, {"nodes", scaling.nodes},
                            {"largest", scaling.largest}, {"largest_rotary", scaling.largest_rotary}};
  json["inventory"] = inventory_json(run);
  json["provenance"] = provenance_json(request_.directory);
  json.update(summary_of_state(run, make_snapshot(run.model(), run.state()), history_));
  if (!json.contains("collapse"))
    if (const nlohmann::json before = summary_of(path("summary.json")); before.contains("collapse"))
      json["collapse"] = before["collapse"];  // found before a restart
  if (nlohmann::json gravity = json_if_any(path("gravity.json")); gravity.is_array())
    json["gravity"] = std::move(gravity);
  if (!run.collapse().curve.empty()) write_atomically(path("collapse_curve.csv"), curve_table(run.collapse()));
  if (nlohmann::json steps = steps_json(case_.settings.stages, history_); !steps.empty()) {
    json["quasi_static"] = std::move(steps);
    write_atomically(path("steps.csv"), steps_table(case_.settings.stages, history_));
  }
  if (const RestForces rest = rest_at_end(run); !rest.empty()) {
    write_atomically(path("stresses.csv"), joint_stress_table(assembly_, rest));
    if (const std::vector<BedJoint> beds = voussoir::bed_joints(assembly_, rest); !beds.empty())
      write_atomically(path("joints.csv"), bed_joint_table(beds));
  }
  write_json(path("summary.json"), json);
}

std::vector<BedJoint> RunSession::bed_joints() const {
  const RestForces rest = rest_at_end(*simulation_);
  return rest.empty() ? std::vector<BedJoint>() : voussoir::bed_joints(assembly_, rest);
}

/// Runs the simulation and writes its files. If a file cannot be written, the error says how to continue.
RunEnd RunSession::simulate() {
  try {
    for (const char* folder : {"checkpoints/", "vtk/"}) make_folder_of(path(folder));
    fallen_ = simulation_->state().time() > 0.0 && has_fallen();  // resumed from its last moment
    const RunEnd end = fallen_ ? RunEnd::interrupted : simulation_->run(request_.until);
    progress_.end();
    if (fallen_) vtk_.write(assembly_, make_snapshot(simulation_->model(), simulation_->state()), request_.threads);
    history_.flush();
    const bool stopped = end == RunEnd::interrupted && stop_request().load() && !fallen_;
    if (end == RunEnd::interrupted && !stopped && !fallen_) write_checkpoint(false);  // --until
    if (!stopped) write_summary(end);
    return end;
  } catch (const RunError& error) {
    progress_.end();
    throw RunError("{}\nThe files that were written before are complete. Continue with 'voussoir resume {}'.",
                   error.what(), request_.directory);
  }
}

void RunSession::draw_pictures() {
  for (const PlotSpec& plot : case_.plots)
    for (const MeasuredCurve& curve : plot.measured)
      if (curve.text.empty())
        log(fmt::format("{}.png is drawn without {}, because there is no such file", plot.name, curve.file));
  const std::string missing = make_pictures(request_.directory, case_, *simulation_,
                                            make_snapshot(simulation_->model(), simulation_->state()), history_);
  log(missing.empty() ? fmt::format("pictures in {}", path("images")) : "no pictures were drawn: " + missing);
  try {
    write_run_page(request_.directory);
    log(fmt::format("page in {}", path("report.html")));
  } catch (const std::exception& error) {  // an error in the page must not end the run
    log(fmt::format("no page was written: {}", error.what()));
  }
}

int RunSession::run() {
  log(fmt::format("{}; {}", counted(assembly_.blocks.size(), "block"), joints_text(assembly_)));
  stop_on_signals();
  if (request_.time_limit > 0.0) {
    std::signal(SIGALRM, time_is_up);
    ::alarm(unsigned(std::ceil(request_.time_limit)));
  }
  const RunEnd end = simulate();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  if (end == RunEnd::failed) {
    end_ = SessionEnd::failed;
    if (request_.pictures && !simulation_->moving().empty()) {
      const std::string missing =
          draw_moving(request_.directory, *simulation_, make_snapshot(simulation_->model(), simulation_->state()));
      log(missing.empty() ? fmt::format("picture of the moving stones: {}", path("images/moving.png"))
                          : "no picture was drawn: " + missing);
    }
    throw RunError("{}\nThe last good checkpoints are in {}", simulation_->failure(), path("checkpoints"));
  }
  if (fallen_) {
    end_ = SessionEnd::fallen;
    log(fmt::format("ended at t = {:.3f} s: {:.0f} % of the mass has moved more than {:g} m", time(),
                    100.0 * fallen_share(), request_.fall_displacement));
  } else if (end == RunEnd::interrupted && stop_request().load()) {
    end_ = late_flag.load() ? SessionEnd::late : SessionEnd::stopped;
    log(fmt::format("stopped at t = {:.4f} s. Continue with: voussoir resume {}", time(), request_.directory));
    return 1;
  } else {
    end_ = end == RunEnd::finished ? SessionEnd::done : SessionEnd::paused;
    const std::string done = end == RunEnd::finished ? "done" : "paused";
    log(time() > 0.0 ? fmt::format("{} at t = {:.3f} s: {} in {}, largest energy error {:.2e}", done, time(),
                                   counted(simulation_->state().step(), "time step"), duration_text(wall),
                                   simulation_->worst_balance())
                     : fmt::format("{} in {}", done, duration_text(wall)));
  }
  if (request_.pictures && end_ != SessionEnd::paused) draw_pictures();
  return 0;
}

}  // namespace voussoir
