// A run in this process, with callbacks and views of its state.
#include "solver/run/simulation.h"

#include <exception>
#include <memory>

#include "io/case/case.h"
#include "solver/base/error.h"
#include "solver/step/make_snapshot.h"
#include "tools/python/module/interrupt.h"
#include "tools/python/module/module.h"
#include "tools/python/module/samples.h"
#include "tools/python/module/snapshot.h"

namespace voussoir::python {

namespace {

struct Callbacks {
  py::object sample, control, progress, log;  // None: nobody listens
  double control_every = 0.0;                 // s
};

/// What Python throws in a callback cannot pass through the teams of threads: it is kept, the run stops, and it is
/// thrown again when the run has returned.
class PythonRun {
 public:
  PythonRun(std::shared_ptr<Case> c, std::shared_ptr<Assembly> assembly, int threads)
      : case_(std::move(c)),
        assembly_(std::move(assembly)),
        run_(std::make_unique<Simulation>(*assembly_, case_->settings, threads, Observers{})) {
    run_->check();
  }

  /// "finished" or "stopped". Throws RunError where the run failed.
  std::string run(double until, const Callbacks& callbacks) {
    if (busy_) throw InputError("this simulation is running already: a callback cannot run it again");
    busy_ = true;
    const struct Idle {
      bool& busy;
      ~Idle() { busy = false; }
    } idle{busy_};
    stop_ = false;
    thrown_ = nullptr;
    run_->observe(observers(callbacks));
    InterruptWatch watch(stop_);
    RunEnd end;
    {
      const py::gil_scoped_release others;
      end = run_->run(until);
    }
    run_->observe({});
    if (thrown_) std::rethrow_exception(thrown_);
    watch.raise_if_pressed();
    if (end == RunEnd::failed) throw RunError(run_->failure());
    return end == RunEnd::finished ? "finished" : "stopped";
  }

  void push(const std::vector<std::int64_t>& blocks, const py::array_t<double>& forces, const py::object& points) {
    const auto count = py::ssize_t(blocks.size());
    const auto rows = [&](const py::array_t<double>& a) {
      return a.ndim() == 2 && a.shape(0) == count && a.shape(1) == 3;
    };
    if (!rows(forces))
      throw InputError("forces must be an array of shape ({}, 3), in N: one row for each block", count);
    const auto at = points.is_none() ? py::array_t<double>() : points.cast<py::array_t<double>>();
    if (!points.is_none() && !rows(at)) throw InputError("points must be an array of shape ({}, 3), in m", count);
    std::vector<PointLoad> loads;
    for (py::ssize_t i = 0; i < count; ++i) {
      const std::int64_t block = blocks[std::size_t(i)];
      if (block < 0 || block >= std::ssize(assembly_->blocks))
        throw InputError("a force acts on block {}. Blocks must be from 0 to {}", block, assembly_->blocks.size() - 1);
      PointLoad load;
      load.body = run_->model().body_of_block[std::size_t(block)];
      for (py::ssize_t c = 0; c < 3; ++c) load.from[c] = load.to[c] = forces.at(i, c);
      if (!load.to.allFinite()) throw InputError("the force on block {} is not finite", block);
      if (!points.is_none())
        for (py::ssize_t c = 0; c < 3; ++c)
          load.arm[c] = at.at(i, c) - assembly_->blocks[std::size_t(block)].centroid[c];
      loads.push_back(load);
    }
    run_->push(std::move(loads));
  }

  const Assembly& assembly() const { return *assembly_; }
  std::shared_ptr<Assembly> shared_assembly() const { return assembly_; }
  std::shared_ptr<Case> shared_case() const { return case_; }
  const Simulation& simulation() const { return *run_; }
  State& state() { return run_->state(); }

 private:
  /// `work` with the GIL; from the first exception on nobody is called any more.
  template <class Work>
  void call(const Work& work) {
    const py::gil_scoped_acquire mine;
    if (thrown_) return;
    try {
      work();
    } catch (...) {
      thrown_ = std::current_exception();
      stop_ = true;
    }
  }

  Observers observers(const Callbacks& callbacks) {
    Observers o;
    o.stop = &stop_;
    if (!callbacks.sample.is_none())
      o.history = [this, f = callbacks.sample](const Simulation& run, const Sample& sample) {
        call([&] { stop_ = stop_ || py::cast<bool>(py::bool_(f(sample_of(run, sample)))); });
      };
    if (!callbacks.control.is_none()) {
      o.control = [this, f = callbacks.control](Simulation&) { call([&] { f(); }); };
      o.control_every = callbacks.control_every;
    }
    if (!callbacks.progress.is_none())
      o.progress = [this, f = callbacks.progress](const Progress& p) { call([&] { f(progress_of(p)); }); };
    if (!callbacks.log.is_none())
      o.log = [this, f = callbacks.log](const std::string& text) { call([&] { f(text); }); };
    return o;
  }

  std::shared_ptr<Case> case_;
  std::shared_ptr<Assembly> assembly_;
  std::unique_ptr<Simulation> run_;
  std::atomic<bool> stop_{false};
  bool busy_ = false;
  std::exception_ptr thrown_;
};

/// Nobody writes into the state but the solver.
py::array_t<double> seen(double* data, std::size_t bodies, std::size_t columns, std::size_t stride, py::handle owner) {
  py::array_t<double> array = view(data, bodies, columns, stride, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::dict collapse_of(const PythonRun& run) {
  const Collapse& c = run.simulation().collapse();
  py::dict d;
  d["found"] = c.found, d["multiplier"] = c.multiplier, d["above"] = c.above;
  d["curve"] = table<double>(c.curve.size(), 3, [&](std::size_t i, std::size_t k) {
    return k == 0 ? c.curve[i].multiplier : k == 1 ? c.curve[i].along : c.curve[i].largest;
  });
  py::list hinges;
  for (const MechanismJoint& joint : c.mechanism) {
    py::dict h;
    h["a"] = joint.a, h["b"] = joint.b, h["slides"] = joint.slides, h["place"] = array_of(joint.place);
    h["opening"] = joint.opening, h["slip"] = joint.slip;
    hinges.append(h);
  }
  d["mechanism"] = hinges;
  d["account"] = c.account;
  return d;
}

}  // namespace

void bind_simulation(py::module_& m) {
  py::class_<PythonRun>(m, "Simulation")
      .def(py::init<std::shared_ptr<Case>, std::shared_ptr<Assembly>, int>(), py::call_guard<py::gil_scoped_release>())
      .def("_run",
           [](PythonRun& run, double until, py::object sample, py::object control, double every, py::object progress,
              py::object log) {
             return run.run(until, {std::move(sample), std::move(control), std::move(progress), std::move(log), every});
           })
      .def("_push", &PythonRun::push)
      .def_property_readonly("assembly", &PythonRun::shared_assembly)
      .def_property_readonly("case", &PythonRun::shared_case)
      .def_property_readonly("time", [](const PythonRun& run) { return run.simulation().state().time(); })
      .def_property_readonly("time_step", [](const PythonRun& run) { return run.simulation().time_step(); })
      .def_property_readonly("end_time", [](const PythonRun& run) { return run.simulation().end_time(); })
      .def_property_readonly("steps", [](PythonRun& run) { return run.state().step(); })
      .def_property_readonly("threads", [](const PythonRun& run) { return run.simulation().threads(); })
      .def_property_readonly("energy_error", [](const PythonRun& run) { return run.simulation().worst_balance(); })
      .def_property_readonly("state_hash", [](PythonRun& run) { return hash_arrays(run.state().arrays()); })
      .def_property_readonly("collapse", &collapse_of)
      .def_property_readonly("equilibrium", [](const PythonRun& run) { return run.simulation().equilibrium().account; })
      .def_property_readonly("body_of_block",
                             [](const PythonRun& run) {
                               return column<std::int64_t>(run.simulation().model().body_of_block,
                                                           [](std::int32_t body) { return body; });
                             })
      .def_property_readonly("pose",
                             [](const py::object& self) {
                               auto& run = self.cast<PythonRun&>();
                               return seen(run.state().pose.data(), run.state().pose.size() / pose_width, 7, pose_width,
                                           self);
                             })
      .def_property_readonly("velocity",
                             [](const py::object& self) {
                               auto& run = self.cast<PythonRun&>();
                               return seen(run.state().motion.data(), run.state().motion.size() / motion_width, 3,
                                           motion_width, self);
                             })
      .def_property_readonly("angular_momentum",
                             [](const py::object& self) {
                               auto& run = self.cast<PythonRun&>();
                               return seen(run.state().motion.data() + 3, run.state().motion.size() / motion_width, 3,
                                           motion_width, self);
                             })
      .def("_snapshot", [](PythonRun& run) {
        return snapshot_of(run.assembly(), make_snapshot(run.simulation().model(), run.simulation().state()));
      });
}

}  // namespace voussoir::python
