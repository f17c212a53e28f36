#include "tools/campaign/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/csv.h"
#include "solver/motion/filter.h"
#include "solver/motion/intensity.h"

namespace voussoir::campaign {

namespace {

bool moves(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double a) { return a != 0.0; });
}

/// pga, pgv, arias, cav, d595 and Sa of one component.
std::vector<double> of_component(const std::vector<double>& a, double dt, const std::vector<double>& periods) {
  const Intensity i = intensity_of(a, dt);
  std::vector<double> values = {i.pga, i.pgv, i.arias, i.cav, i.significant()};
  for (const double sa : response_spectrum(a, dt, periods)) values.push_back(sa);
  return values;
}

}  // namespace

std::vector<Measure> measures(const std::vector<double>& periods) {
  std::vector<Measure> list = {{"pga", "m/s2", 1}, {"pgv", "m/s", 1},    {"arias", "m/s", 2},  {"cav", "m/s", 1},
                               {"d595", "s", 0},   {"pga_x", "m/s2", 1}, {"pga_y", "m/s2", 1}, {"pga_z", "m/s2", 1}};
  for (const double t : periods) list.push_back({fmt::format("sa_{:.2f}", t), "m/s2", 1});
  return list;
}

std::vector<double> measure(const GroundMotion& motion, const std::vector<double>& periods) {
  std::vector<std::vector<double>> horizontals;
  for (int axis : {0, 1})
    if (const std::vector<double> a = component(motion, axis); moves(a))
      horizontals.push_back(of_component(a, motion.dt, periods));
  std::vector<double> means(5 + periods.size(), no_number);
  for (std::size_t i = 0; i < means.size() && !horizontals.empty(); ++i)
    means[i] = horizontals.size() == 1 ? horizontals[0][i] : std::sqrt(horizontals[0][i] * horizontals[1][i]);
  Vec3 peak = Vec3::Zero();
  for (const Vec3& a : motion.acceleration) peak = peak.cwiseMax(a.cwiseAbs());
  means.insert(means.begin() + 5, {peak.x(), peak.y(), peak.z()});
  return means;
}

GroundMotion first_part(const GroundMotion& motion, double duration) {
  GroundMotion part = motion;
  const double samples = std::floor(duration / motion.dt + 1e-6) + 1.0;
  if (samples < double(part.acceleration.size())) part.acceleration.resize(std::size_t(samples));
  return part;
}

double significant_end(const GroundMotion& motion) {
  double end = 0.0;
  for (int axis : {0, 1, 2})
    if (axis < 2 || end == 0.0) end = std::max(end, intensity_of(component(motion, axis), motion.dt).t95);
  return std::min(std::ceil(end / motion.dt) * motion.dt, motion.duration());
}

double significant_begin(const GroundMotion& motion) {
  double begin = motion.duration();
  for (int axis : {0, 1, 2})
    if (const Intensity i = intensity_of(component(motion, axis), motion.dt); i.pga > 0.0)
      begin = std::min(begin, i.t5);
  return std::max(0.0, std::floor((begin - 2.0) / motion.dt) * motion.dt);
}

}  // namespace voussoir::campaign
