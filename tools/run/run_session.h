// A run in its directory: a simulation whose observers write history, checkpoints, files for ParaView, log and
// pictures.
#pragma once
#include <memory>
#include <string>

#include "io/case/case.h"
#include "io/hdf5/checkpoint_file.h"
#include "io/hdf5/history_file.h"
#include "io/vtk/series.h"
#include "solver/run/simulation.h"
#include "solver/statics/bed_joints.h"
#include "tools/run/deck_line.h"
#include "tools/run/terminal.h"

namespace voussoir {

struct RunRequest {
  std::string directory;
  int threads = 1;
  bool quiet = false;
  bool pictures = true;
  Packing packing = usual_packing;  // compression of the files for ParaView
  double until = -1.0;              // s, simulated time at which the run stops; negative: at its end
  double time_limit = 0.0;          // s, wall-clock time after which the run stops with a checkpoint; 0: none
  std::function<void(const Progress&)> progress;  // called in addition to the line on the terminal
  double fall_displacement = 0.0;                 // m, displacement beyond which mass counts as fallen
  double fall_share = 0.0;  // the run ends when more than this share of the movable mass has fallen; 0: never
};

/// none: no end yet, or an error; paused: at `until`; stopped: by a signal; late: past its time limit; fallen: the
/// bridge fell; failed: the solver failed.
enum class SessionEnd { none, done, paused, stopped, late, fallen, failed };

class RunSession {
 public:
  /// The directory holds case.toml and assembly.h5. Throws InputError.
  explicit RunSession(const RunRequest& request);
  /// Continues from the newest good checkpoint. A damaged checkpoint is named in the log, and the one before it is
  /// used. A run that was stopped before its first checkpoint starts from the beginning. Throws InputError if no
  /// checkpoint is left, or if it belongs to another case or assembly.
  void resume();
  /// Continues from the end of another run of the same assembly whose stages are the first stages of this case, and
  /// takes over its history and frames. The directory must be new. Throws InputError.
  void begin_where(const std::string& other);
  /// Runs to the end (or `until`); returns the exit status: 1 if the run was stopped by a signal or its time limit,
  /// otherwise 0. Throws RunError if the solver fails or a file cannot be written.
  int run();
  /// A request to stop (a signal, a time limit) holds for all runs of the process. This function withdraws it.
  static void forget_stop();
  /// How run() ended, also if it threw: `failed` for a failure of the solver, `none` for any other error (a full disk).
  SessionEnd end() const { return end_; }
  double time() const { return simulation_->state().time(); }  // s, simulated
  /// Share of the movable mass that has moved farther than fall_displacement, relative to the ground and to its
  /// position after gravity.
  double fallen_share() const;
  /// The bed joints at the end of run(), see rest_at_end() in tools/run/thrust.h. Empty without a vault.
  std::vector<BedJoint> bed_joints() const;

 private:
  Observers observers();
  RunEnd simulate();
  bool has_fallen() const { return request_.fall_share > 0.0 && fallen_share() > request_.fall_share; }
  void draw_pictures();
  void go_on_from(const CheckpointHeader& header);
  const Equilibrium& equilibrium() const;
  void write_checkpoint(bool stage_end);
  CheckpointHeader own_header();
  void append_history(const Sample& sample);
  void report_gravity();
  void write_summary(RunEnd end);
  void log(const std::string& text);
  std::string path(const std::string& name) const { return request_.directory + "/" + name; }

  RunRequest request_;
  Case case_;
  Assembly assembly_;
  std::uint64_t assembly_hash_ = 0;
  ProgressLine progress_;
  std::unique_ptr<Simulation> simulation_;
  History history_;
  DeckLine deck_;  // in runs with quasi-static stages
  VtkSeries vtk_;
  Equilibrium equilibrium_before_;  // found by a part of this run that ended earlier
  double before_seconds_ = 0.0;     // wall time of the parts of this run that ended earlier
  bool fallen_ = false;
  SessionEnd end_ = SessionEnd::none;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// Draws the end state and charts of the history (the usual ones, and the plots of the case) in DIR/images. Returns a
/// text on the pictures that could not be drawn; empty if all were drawn.
std::string make_pictures(const std::string& directory, const Case& c, const Simulation& run, const Snapshot& snapshot,
                          const History& history);

/// Draws the moving stones after a static stage has failed, in DIR/images/moving.png. Returns the same as above.
std::string draw_moving(const std::string& directory, const Simulation& run, const Snapshot& snapshot);

}  // namespace voussoir
