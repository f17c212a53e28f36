// Decides during a motion away from an equilibrium whether it will come to rest.
#pragma once
#include "solver/step/stepper.h"

namespace voussoir {

/// A motion comes to rest if its driving force decreases. From the given distance (m) on, the mean driving force over
/// one doubling of the displacement is compared with that over the previous doubling. If it has not decreased, there is
/// no equilibrium nearby. With a fill, if only loaded bodies and the fill move, the soil can yield and then resist
/// again after a larger displacement. Such a motion is followed to the median block size, or to four times the distance
/// if that is more.
class MotionWatch {
 public:
  /// `loaded`: of each body, whether forces of the pattern act on it; empty if it acts on all. It must outlive the
  /// watch.
  MotionWatch(const Model& model, const std::vector<char>& loaded, const State& from, double distance);
  /// Call it after each round of iterations, with the work of the out-of-balance forces in it (J).
  bool hopeless(const State& state, double work);
  double displacement() const { return std::max(loaded_.moved, stones_.moved); }  // m, of any body

 private:
  /// The largest displacement of some bodies, and its driving force over the last two doublings.
  struct Track {
    double moved = 0.0;                  // m
    double begun = 0.0, work = 0.0;      // m, J: of the present doubling
    double drive = -1.0, before = -1.0;  // N, mean over the last two complete doublings; negative: none yet
    void follow(double now, double done, double least);
    bool driven_on() const { return before > 0.0 && drive >= still_driven * before; }
  };
  static constexpr double still_driven = 0.95;  // share of the driving force that counts as no decrease

  const Model& model_;
  const std::vector<char>& mark_;
  Array<double> pose_, nodes_;
  double distance_, far_;
  Track loaded_, stones_;
};

}  // namespace voussoir
