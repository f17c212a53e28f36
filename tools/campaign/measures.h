// Intensity measures of a motion of three components, for the columns im.* of the table.
#pragma once
#include <string>
#include <vector>

#include "solver/model/settings.h"

namespace voussoir::campaign {

struct Measure {
  std::string name, unit;  // "pga", "m/s2"
  int power = 1;           // scaling the motion by s scales it by s to this power
};
/// pga, pgv, arias, cav, d595, pga_x … pga_z, then sa_0.10 … at the periods (s).
std::vector<Measure> measures(const std::vector<double>& periods);
/// Their values. Those without a direction are geometric means of the two horizontals x and y, or those of the one
/// there is; NaN where there is none. Sa with 5 % damping.
std::vector<double> measure(const GroundMotion& motion, const std::vector<double>& periods);

/// What a stage of `duration` (s) makes of it.
GroundMotion first_part(const GroundMotion& motion, double duration);
/// When 95 % of the Arias intensity of both horizontals have passed (of the vertical where there is nothing else), s.
double significant_end(const GroundMotion& motion);
/// Two seconds before the first 5 % of it have passed in any component, or the beginning, s.
double significant_begin(const GroundMotion& motion);

}  // namespace voussoir::campaign
