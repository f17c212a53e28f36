// A run: executes the stages of a case in order and passes results to its observers. It reads and writes no files.
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "solver/statics/collapse.h"
#include "solver/statics/stops.h"
#include "solver/step/contact_bound.h"
#include "solver/step/damage.h"
#include "solver/step/energy.h"
#include "solver/step/mass_scaling.h"
#include "solver/step/stepper.h"

namespace voussoir {

class Simulation;
struct Standing;  // solver/run/moved.h

/// Progress of a run, for the progress line.
struct Progress {
  std::string stage;             // "gravity", "motion …"
  bool timed = true;             // false in stages that take no simulated time
  double time = 0.0, end = 0.0;  // s of simulated time, of the whole run
  double share = 0.0;            // of the whole run
  double speed = 0.0;            // simulated time over wall-clock time
  double left = 0.0;             // s of wall-clock time, estimated
  std::string note;              // state of the iteration, or the share of patches evaluated point by point
};

/// Position of an equilibrium on the path of a quasi-static stage.
struct StepRow {
  double share = 0.0;         // of the loads and drives
  double multiplier = 0.0;    // of the loads: the share, or the value found with a testing machine; 0 without loads
  double displacement = 0.0;  // m, since the stage began: of the loaded points along the loads, of the first drive, or
                              // of a moving load
  double force = 0.0;         // N: sum of the loads, or the force that moves the first drive along its path
};

/// One row of the history.
struct Sample {
  double time = 0.0;  // s since the start of the run
  Energies energies;
  double balance_error = 0.0;  // error of the energy balance over its largest term so far
  Vec3 base_displacement = Vec3::Zero(), base_acceleration = Vec3::Zero();  // m, m/s2
  std::int64_t contacts = 0;          // number of contacts found during the run that exist now
  std::int64_t stage = 0;             // index in the settings
  std::vector<double> broken_shares;  // of the bonds of bonded_families()
  std::vector<Vec3> reactions;        // N, forces that hold or drive the held_groups()
  std::vector<double> accelerations;  // m/s2, at the sensors of the assembly along their directions; 0 in stages
                                      // without simulated time
  StepRow step;                       // zero except in quasi-static stages
};

struct Observers {
  /// Called every OutputSettings::history_every, and after each equilibrium of stages without simulated time.
  std::function<void(const Simulation&, const Sample&)> history;
  /// Called every OutputSettings::fields_every and at the ends of stages: the state is to be written.
  std::function<void(Simulation&)> fields;
  /// Called when a stage (its index in the settings) has ended, before its end is stored.
  std::function<void(const Simulation&, std::int64_t stage)> ended;
  /// Called when a checkpoint is due (OutputSettings) and at the ends of stages: it writes state() and position().
  std::function<void(Simulation&, bool stage_end)> checkpoint;
  /// Called at the beginning of each stage with time and then every `control_every` s of simulated time (0: at every
  /// time step). It may read the state and call Simulation::push().
  std::function<void(Simulation&)> control;
  double control_every = 0.0;
  std::function<void(const Progress&)> progress;
  std::function<void(const std::string&)> log;
  const std::atomic<bool>* stop = nullptr;  // set by a signal: the run stops at the next time step
};

/// Wall-clock time of a run by activity, s. After a restart it covers the part since the restart.
struct RunCosts {
  double equilibrium = 0.0, steps = 0.0, searches = 0.0;
  double history = 0.0, fields = 0.0, reports = 0.0, checkpoints = 0.0;  // time of the observers; `history` includes
                                                                         // the energies
};

enum class RunEnd { finished, interrupted, failed };

/// Data that a restart needs in addition to the arrays of the state to continue a run exactly.
struct RunPosition {
  std::int64_t stage = 0;
  double stage_start = 0.0;                    // s
  double dt = 0.0;                             // s
  double highest = 0.0;                        // rad/s, of the intact assembly
  double stiffest = 0.0, stiffest_node = 0.0;  // 1/s2, see ContactBound
  double stage_begun = 0.0;                    // 1 once the time step and damping of the present stage are set
  double stops = 0.0;                          // number of finished increments of a quasi-static stage
  double along = 0.0;                          // m: pattern_displacement() at its beginning
  double multiplier = 0.0;                     // multiplier of the testing machine at the last of these increments
};

class Simulation {
 public:
  /// `threads` is the requested number. A small model uses fewer.
  Simulation(const Assembly& assembly, const SolverSettings& settings, int threads, Observers observers);

  /// Replaces the observers.
  void observe(Observers observers) { observers_ = std::move(observers); }
  /// Throws InputError if the time step of the case is too large for this assembly. Call it before any file is written.
  void check();
  /// Restarts from a checkpoint. Call it after the arrays of the state have been read into state() and unpacked.
  void restore(const RunPosition& position);
  /// Runs the remaining stages up to `until` (s of simulated time; negative: all stages). Returns `interrupted` if it
  /// stops there or by the stop flag; another call continues the run.
  RunEnd run(double until = -1.0);
  /// Sets dead forces that act in addition to the loads of the stages in all following time steps, until the next call.
  /// They are not part of the state: after a restart they must be set again. PointLoad::body is an index of
  /// Model::bodies. Throws InputError for a body that cannot move.
  void push(std::vector<PointLoad> forces);
  double time_step() const { return position_.dt; }  // s; 0 before the first stage with time

  const Assembly& assembly() const { return *assembly_; }
  const Model& model() const { return model_; }
  State& state() { return state_; }
  const State& state() const { return state_; }
  const RunPosition& position() const { return position_; }
  const SolverSettings& settings() const { return settings_; }
  const std::string& failure() const { return failure_; }  // after RunEnd::failed
  /// After RunEnd::failed in a gravity stage: the bodies that still move, or that came to rest at another position.
  const std::vector<std::int32_t>& moving() const { return moving_; }
  const Equilibrium& equilibrium() const { return equilibrium_; }
  /// Groups of fixed blocks, including guided and driven ones. A Sample contains their reactions.
  const std::vector<std::string>& held_groups() const { return held_groups_; }
  const Collapse& collapse() const { return collapse_; }        // of a collapse stage, else empty
  bool quasi_static() const;                                    // whether any stage is quasi-static
  const MassScaling& mass_scaling() const { return scaling_; }  // valid once the time step is chosen
  int threads() const { return stepper_.threads; }
  const RunCosts& costs() const { return costs_; }
  double end_time() const;                                 // s, of all stages
  double worst_balance() const { return worst_balance_; }  // largest Sample::balance_error so far
  /// Takes over the largest error of the energy balance in the part of the run before a restart.
  void note_balance(double worst) { worst_balance_ = std::max(worst_balance_, worst); }

 private:
  void begin_stage(const StageSettings& stage);
  bool gravity(const StageSettings& stage);
  void find_equilibrium(const StageSettings& stage, bool from_unloaded);
  void construct(const StageSettings& stage);
  bool stayed(const StageSettings& stage, const Standing& before);
  bool collapse(const StageSettings& stage);
  RunEnd step_by_step(const StageSettings& stage, double until);
  bool begin_steps(const StageSettings& stage);
  Stop approach(const StageSettings& stage, Stop from, const Stop& to);
  bool equilibrium_at(const StageSettings& stage, const Stop& stop, bool relaxes);
  RunEnd lose(const StageSettings& stage, const Stop& from, const Stop& to);
  LoadsAtWork step_loads(const StageSettings& stage, double share) const;
  Machine machine_at(const StageSettings& stage, double share) const;
  void step_by_newton(const StageSettings& stage, double share);
  void step_by_relaxation(const StageSettings& stage, double share);
  bool by_newton(const StageSettings& stage) const;
  void take_multiplier(const Machine& machine);
  void note_step(const StageSettings& stage, double share);
  void drive_to(const StageSettings& stage, double from, double to);
  void impose(const StageSettings& stage);
  void impose_nothing();
  void load(LoadsAtWork loads);
  double control(const StageSettings& stage);
  double follow_loads(const StageSettings& stage);
  void place(const StageSettings& stage);
  void start_from_rest();
  Vec3 reaction(const BodyPass& pass, const std::string& group) const;
  bool stopped() const;
  RunEnd timed(const StageSettings& stage, double until);
  void change_contacts();
  Sample take_sample(const BodyPass& pass) const;
  void sample(const BodyPass& pass);
  void sample_at_rest();
  bool scales_mass() const;
  void scale();
  void scale_and_say();
  void choose_step();
  void write_fields();
  void write_checkpoint(bool stage_end);
  void report_progress(bool force, const std::string& note);
  void log(const std::string& text) const;

  const Assembly* assembly_;
  SolverSettings settings_;
  Observers observers_;
  Model model_;
  State state_;
  Stepper stepper_;
  RunPosition position_;
  MassScaling scaling_;
  Equilibrium equilibrium_;
  Collapse collapse_;
  std::vector<std::string> held_groups_;
  std::string failure_;
  std::string construction_failed_;  // " in step 3 of its construction (…)"
  std::vector<std::int32_t> moving_;
  Advance last_;
  RunCosts costs_;
  ContactBound bound_;
  LoadPlaces places_;
  std::int64_t part_of_way_ = -1;  // of moving loads
  LoadsAtWork stage_loads_;        // without the forces of push()
  std::vector<PointLoad> pushed_;
  double controlled_ = -1.0;  // s, time of the last call of the control observer
  LostBonds lost_bonds_;
  LoadsAtWork step_pattern_;  // of a quasi-static stage
  StepRow step_row_;
  double step_time_ = 0.0;  // s, at its last equilibrium
  double worst_balance_ = 0.0;
  std::string exploded_;  // why the energy balance has failed; empty while it is valid
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now(), reported_{}, saved_ = started_;
  double started_time_ = 0.0;
};

}  // namespace voussoir
