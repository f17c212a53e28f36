// Rungs of the validation ladder that test elements of the method instead of cases. Each computes some quantities and
// states the expected values. `voussoir check` and CTest run the same rungs. A new rung is one file in this folder
// with the name of the rung (with _ for -), its declaration below and its line in rungs.cpp. CMake finds the file.
#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/case/checks.h"

namespace voussoir::ladder {

/// A computed quantity and its expected value.
struct Finding {
  Check check;                                            // its `value` and `text` apply to cases only
  double got = std::numeric_limits<double>::quiet_NaN();  // in check.unit
  /// Difference from the expected value, in its unit if the tolerance is absolute, otherwise relative to it.
  double error() const { return check.absolute ? got - check.expected : got / check.expected - 1.0; }
  bool within() const { return std::abs(error()) <= check.tolerance; }
};

/// `got` should be `expected` (not zero), up to a share of it.
Finding near(std::string quantity, double expected, double got, double share, std::string unit, std::string source);
/// `got` should be `expected`, up to `tolerance` in its unit.
Finding within(std::string quantity, double expected, double got, double tolerance, std::string unit,
               std::string source);
/// A difference or residual `got` should be zero, up to `tolerance`.
Finding nothing(std::string quantity, double got, double tolerance, std::string unit, std::string source);
/// Marks a quantity as known to be outside its tolerance, with the reason.
Finding known_miss(Finding finding, std::string reason);

struct Rung {
  std::string name;
  std::string help;  // one line
  /// Computes all quantities, with at most `threads` threads. Throws RunError if this is not possible, or if the state
  /// to be compared does not occur.
  std::vector<Finding> (*climb)(int threads);
  bool slow = false;  // only in the long ladder
};

/// All rungs in the order of the ladder.
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
// These rungs need a solver for linear programs. They are not listed if the program was built without one.
Rung limit_analysis();
Rung rings();
Rung axle_strip();

}  // namespace voussoir::ladder
