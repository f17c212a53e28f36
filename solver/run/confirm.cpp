#include "solver/run/confirm.h"

#include "solver/run/simulation.h"

namespace voussoir {

namespace {

/// Moments at which the displacement has reached the limit, twice and four times it. A motion that takes more than
/// twice as long for the second doubling as for the first slows down; one that does not has no rest near.
class Doublings {
 public:
  explicit Doublings(double limit) : limit_(limit) {}
  void follow(double time, double displacement) {
    while (reached_.size() < 3 && displacement >= limit_ * double(1 << reached_.size())) reached_.push_back(time);
  }
  bool goes_on() const {
    return reached_.size() == 3 && reached_[2] - reached_[1] <= 2.0 * (reached_[1] - reached_[0]);
  }

 private:
  double limit_;
  std::vector<double> reached_;
};

}  // namespace

bool moves_away(const Assembly& assembly, const SolverSettings& settings, const Loads& loads, double rise, double limit,
                int threads, const std::atomic<bool>* stop) {
  SolverSettings own = settings;
  StageSettings raise, hold;
  raise.kind = hold.kind = StageSettings::Kind::free;
  raise.label = "load raised";
  hold.label = "load held";
  raise.duration = rise;
  raise.loads = loads;
  hold.duration = 2.0 * rise;
  own.stages.insert(own.stages.end(), {raise, hold});
  own.output.fields_every = 0.0;

  std::atomic<bool> ended{false};
  Array<double> held;  // the placement when the full load has come
  Doublings doublings(limit);
  double begun = 0.0, half = 0.0, now = 0.0;  // s; m half way and at the end
  bool far = false;
  Observers observers;
  observers.stop = &ended;
  observers.history = [&](const Simulation& run, const Sample& sample) {
    if (std::size_t(run.position().stage) + 1 == own.stages.size()) {
      if (held.empty()) held = run.state().pose, begun = sample.time;
      now = largest_displacement(run.model(), held, run.state().pose);
      if (sample.time - begun <= rise) half = now;
      doublings.follow(sample.time, now);
      far = now > std::max(run.model().typical_size, 4.0 * limit);
    }
    if (far || doublings.goes_on() || (stop && stop->load())) ended.store(true);
  };
  Simulation run(assembly, own, threads, observers);
  if (run.run() == RunEnd::failed || far || doublings.goes_on()) return true;
  return now > limit && now - half >= half;  // it is faster in the second half than in the first
}

}  // namespace voussoir
