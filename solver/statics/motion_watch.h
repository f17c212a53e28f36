// Whether a motion away from an equilibrium will come to rest, judged while it goes on.
#pragma once
#include "solver/step/stepper.h"

namespace voussoir {

/// A motion comes to rest when what drives it falls as it goes. From the distance given on (m) the mean of the driving
/// force over one doubling of the displacement is compared with that over the doubling before; a motion that is driven
/// as hard as before has no equilibrium near. Where only loaded bodies and fill move, soil may give way and still bear
/// farther down: such a motion is followed to `far`.
class MotionWatch {
 public:
  /// `loaded`: of each body whether the pattern's forces act on it; empty where it acts on all.
  MotionWatch(const Model& model, const std::vector<char>& loaded, const State& from, double distance);
  /// After each round of steps, in which the out-of-balance forces did this work (J).
  bool hopeless(const State& state, double work);
  double displacement() const { return std::max(loaded_.moved, stones_.moved); }  // m, of any body

 private:
  /// The largest displacement of some bodies, and what drove it over the last two doublings.
  struct Track {
    double moved = 0.0;                  // m
    double begun = 0.0, work = 0.0;      // m, J: of the doubling that is under way
    double drive = -1.0, before = -1.0;  // N, mean over the last two that are done; negative: none yet
    void follow(double now, double done, double least);
    bool driven_on() const { return before > 0.0 && drive >= still_driven * before; }
  };
  static constexpr double still_driven = 0.95;  // share of the driving force that counts as not falling

  const Model& model_;
  const std::vector<char>& mark_;
  Array<double> pose_, nodes_;
  double distance_, far_;
  Track loaded_, stones_;
};

}  // namespace voussoir
