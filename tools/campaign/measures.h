// Intensity measures of a motion of three components, for the columns im.* of the table.
#pragma once
#include <string>
#include <vector>

#include "solver/model/settings.h"

namespace voussoir::campaign {

struct Measure {
  std::string name, unit;  // "pga", "m/s2"
  int power = 1;           // a motion scaled by s has the measure times s to this power
};
/// The measures in order: pga, pgv, arias, cav, d595, pga_x … pga_z, then sa_0.10 … at the periods (s).
std::vector<Measure> measures(const std::vector<double>& periods);
/// The values of the measures. Measures without a direction are geometric means of the horizontal components x and y,
/// or the value of the only one; NaN if there is none. Sa with 5 % damping.
std::vector<double> measure(const GroundMotion& motion, const std::vector<double>& periods);

/// The motion of a stage with this duration, s.
GroundMotion first_part(const GroundMotion& motion, double duration);
/// Time at which both horizontal components have reached 95 % of their Arias intensity (the vertical component if there
/// is no other), s.
double significant_end(const GroundMotion& motion);
/// Two seconds before any component first reaches 5 % of its Arias intensity, but not before the start of the record,
/// s.
double significant_begin(const GroundMotion& motion);

}  // namespace voussoir::campaign
