// The validation ladder's rungs that are no cases but elements of the method: each computes some quantities and says
// what they should be. `voussoir check` and CTest climb the same ones. A new rung is one file here, named as the rung
// (with _ for -), its declaration below and its line in rungs.cpp; CMake finds it by its file.
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/case/checks.h"

namespace voussoir::ladder {

/// A quantity beside what it should be.
struct Finding {
  Check check;                                            // its `value` and `text` are of cases only
  double got = std::numeric_limits<double>::quiet_NaN();  // in check.unit
  /// Difference from the expected value: in its unit where the tolerance is, else as a share of it.
  double error() const { return check.absolute ? got - check.expected : got / check.expected - 1.0; }
  bool within() const { return std::abs(error()) <= check.tolerance; }
};

/// `got` should be `expected` (not zero), up to a share of it.
Finding near(std::string quantity, double expected, double got, double share, std::string unit, std::string source);
/// `got` should be `expected`, up to `tolerance` in its unit.
Finding within(std::string quantity, double expected, double got, double tolerance, std::string unit,
               std::string source);
/// A difference or residual `got` should be nothing, up to `tolerance`.
Finding nothing(std::string quantity, double got, double tolerance, std::string unit, std::string source);
/// The same quantity, known to be outside its tolerance, and why.
Finding known_miss(Finding finding, std::string reason);

struct Rung {
  std::string name;
  std::string help;  // one line
  /// Computes everything; fewer threads are used where there is nothing to share. Throws RunError when it cannot be
  /// computed, or when what is compared never came about.
  std::vector<Finding> (*climb)(int threads);
  bool slow = false;  // only in the long ladder
};

/// All of them, in the ladder's order.
const std::vector<Rung>& rungs();

Rung contact_patch();
Rung joint_stiffness();
Rung intact_shortcut();
Rung rigid_rotation();
Rung free_spin();
Rung axial_chain();
Rung bending_cantilever();
Rung ring_down();
Rung bridge_ring();
Rung maxwell_fit();
Rung maxwell_ring();
Rung softening_joint();
Rung composite_joint();
Rung falling_blocks();
Rung colliding_blocks();
Rung skew_arch();
Rung fill_waves();
Rung fill_triaxial();
Rung fill_oedometer();
Rung fill_footing();
Rung fill_bearing();
Rung fill_dispersal();
Rung fill_patch();
Rung fill_slide();
Rung fill_rankine();
// These need a solver for linear programs; where the program was built without one they are not listed.
Rung limit_analysis();
Rung rings();
Rung axle_strip();

}  // namespace voussoir::ladder
