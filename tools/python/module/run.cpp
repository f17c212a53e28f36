// Runs in a directory of their own, as the verb `run` makes them, and what they leave behind.
#include <atomic>
#include <csignal>

#include "io/hdf5/history_file.h"
#include "solver/base/error.h"
#include "solver/step/make_snapshot.h"
#include "tools/python/module/interrupt.h"
#include "tools/python/module/module.h"
#include "tools/python/module/samples.h"
#include "tools/python/module/snapshot.h"
#include "tools/run/run_directory.h"
#include "tools/run/run_session.h"
#include "tools/run/stored_state.h"

namespace voussoir::python {

namespace {

/// The session's own handlers stop it with a checkpoint; Python's stand again afterwards.
class Handlers {
 public:
  Handlers() {
    for (int i = 0; i < 2; ++i) sigaction(signals[i], nullptr, &before_[i]);
  }
  ~Handlers() {
    for (int i = 0; i < 2; ++i) sigaction(signals[i], &before_[i], nullptr);
  }
  Handlers(const Handlers&) = delete;

 private:
  static constexpr int signals[2] = {SIGINT, SIGTERM};
  struct sigaction before_[2];
};

/// "finished", "paused" at `until`. Throws KeyboardInterrupt where it was stopped, with a checkpoint.
std::string session(const std::string& directory, bool resumed, double until, int threads, bool pictures,
                    const py::object& progress) {
  RunRequest request;
  request.directory = directory;
  request.threads = threads;
  request.quiet = true;
  request.pictures = pictures;
  request.until = until;
  std::exception_ptr thrown;
  if (!progress.is_none())
    request.progress = [&](const Progress& p) {
      const py::gil_scoped_acquire mine;
      if (thrown) return;
      try {
        progress(progress_of(p));
      } catch (...) {
        thrown = std::current_exception();
        std::raise(SIGINT);
      }
    };
  SessionEnd end;
  {
    const Handlers handlers;
    const py::gil_scoped_release others;
    RunSession::forget_stop();
    RunSession run(request);
    if (resumed) run.resume();
    run.run();
    end = run.end();
  }
  if (thrown) std::rethrow_exception(thrown);
  if (end == SessionEnd::stopped) {
    PyErr_SetString(PyExc_KeyboardInterrupt,
                    ("stopped with a checkpoint. Continue with resume() in " + directory).c_str());
    throw py::error_already_set();
  }
  return end == SessionEnd::paused ? "paused" : "finished";
}

std::string run_case(const Case& c, const std::string& directory, bool overwrite, double until, int threads,
                     bool pictures, const py::object& progress) {
  const DirectoryLock lock = prepare_directory(c, directory, overwrite);
  return session(directory, false, until, threads, pictures, progress);
}

std::string resume_run(const std::string& directory, double until, int threads, bool pictures,
                       const py::object& progress) {
  const DirectoryLock lock(directory);
  return session(directory, true, until, threads, pictures, progress);
}

/// {channel: (unit, values)}
py::dict history_of(const std::string& path) {
  const History history = History::load(path);
  py::dict d;
  for (const Channel& channel : history.channels())
    d[channel.path.c_str()] =
        py::make_tuple(channel.unit, column<double>(history.values(channel.path), [](double v) { return v; }));
  return d;
}

py::dict stored_state(const std::string& from) {
  const StoredState stored = read_stored_state(is_checkpoint_of_run(from) ? from : newest_checkpoint(from));
  return snapshot_of(stored.assembly, make_snapshot(stored.model, stored.state));
}

}  // namespace

void bind_run(py::module_& m) {
  m.def("_run_case", &run_case);
  m.def("_resume_run", &resume_run);
  m.def("_history", &history_of);
  m.def("_stored_state", &stored_state);
}

}  // namespace voussoir::python
