// The multiplier of an arch that fails by hinges only, from all mechanisms with four hinges. It shares no code with
// the limit analysis by linear programming, which it validates.
#pragma once
#include <algorithm>
#include <cmath>

#include "geometry/assembly.h"

namespace voussoir::ladder {

/// Loads on an arch of blocks 0 … n − 1 from left to right, permanent and of a pattern: force, and moment about y
/// through the origin, for each block.
struct ArchLoads {
  std::vector<Vec3> dead, live;  // (force along x, moment, force along z): N, N m, N
};

/// Position of a hinge: the joint, and whether it is at the extrados.
inline Vec3 hinge_at(const Polygon& intrados, const Polygon& extrados, std::size_t joint, bool outside) {
  return outside ? extrados[joint] : intrados[joint];
}

/// The least multiplier over all sets of four joints i < j < k < l of an arch with joints 0 … n, with hinges
/// alternately at intrados and extrados. The arch between i and j rotates about the hinge at i with the rate 1; the
/// hinges determine the other rotations. Virtual work: multiplier = −dead · v / live · v, with the sign for which the
/// power of the pattern is positive and every hinge opens (Heyman 1969).
inline double four_hinge_multiplier(const Polygon& intrados, const Polygon& extrados, const ArchLoads& loads) {
  const std::size_t n = intrados.size() - 1;
  // Sums of the loads of blocks before each joint.
  std::vector<Vec3> dead(n + 1, Vec3::Zero()), live(n + 1, Vec3::Zero());
  for (std::size_t b = 0; b < n; ++b) dead[b + 1] = dead[b] + loads.dead[b], live[b + 1] = live[b] + loads.live[b];
  // A body that turns at rate w about a point p: velocity of the origin (−w p_z, w p_x); power of (fx, m, fz).
  const auto power = [](const Vec3& load, double w, const Vec3& p) {
    return w * (load.y() - p.z() * load.x() + p.x() * load.z());
  };
  double least = 1e300;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k)
        for (std::size_t l = k + 1; l <= n; ++l)
          for (const bool first : {false, true}) {
            const Vec3 a = hinge_at(intrados, extrados, i, first), b = hinge_at(intrados, extrados, j, !first),
                       c = hinge_at(intrados, extrados, k, first), d = hinge_at(intrados, extrados, l, !first);
            // The middle part turns about where the lines a b and c d meet: p = a + s (b − a) = d + t (c − d).
            const Vec3 u = b - a, v = c - d, r = d - a;
            const double cross = u.x() * v.z() - u.z() * v.x();
            if (std::abs(cross) < 1e-12) continue;
            const double s = (r.x() * v.z() - r.z() * v.x()) / cross, t = (r.x() * u.z() - r.z() * u.x()) / cross;
            const Vec3 p = a + s * u;
            // Hinge b has the same velocity on both sides: w1 (b − a) = w2 (b − p); so has c.
            if (std::abs(1.0 - s) < 1e-12 || std::abs(t) < 1e-12 || std::abs(1.0 - t) < 1e-12) continue;
            const double w2 = 1.0 / (1.0 - s), w3 = w2 * (1.0 - t);
            const double of_live =
                power(live[j] - live[i], 1.0, a) + power(live[k] - live[j], w2, p) + power(live[l] - live[k], w3, d);
            const double of_dead =
                power(dead[j] - dead[i], 1.0, a) + power(dead[k] - dead[j], w2, p) + power(dead[l] - dead[k], w3, d);
            // A joint opens at the intrados if the part on its right rotates less about y than the part on its left.
            // All four changes of rotation must have the sign of their side, for the direction of motion in which the
            // power of the pattern is positive.
            const double sense = of_live > 0.0 ? 1.0 : -1.0;
            const double change[4] = {1.0, w2 - 1.0, w3 - w2, -w3};
            bool opens = of_live != 0.0;
            for (int h = 0; h < 4; ++h) {
              const bool outside = (h % 2 == 0) == first;
              opens = opens && sense * change[h] * (outside ? -1.0 : 1.0) > 0.0;
            }
            if (opens) least = std::min(least, -of_dead / of_live);
          }
  return least;
}

/// Input of four_hinge_multiplier() from an assembly whose blocks 0 … n − 1 are an arch from left to right and whose
/// next two are its springings: the ends of its joints, and weight and an acceleration (m/s2) as dead and live loads.
struct ArchLine {
  Polygon intrados, extrados;
  ArchLoads loads;
};
inline ArchLine arch_line(const Assembly& assembly, const Vec3& acceleration) {
  const std::size_t n = assembly.blocks.size() - 2;
  ArchLine line;
  line.intrados.resize(n + 1), line.extrados.resize(n + 1);
  Vec3 feet = Vec3::Zero();
  const auto place_of = [&](const Joint& joint) {  // blocks n and n + 1 come before 0 and after n − 1
    return joint.b == std::int64_t(n) ? 0 : joint.b == std::int64_t(n) + 1 ? n : std::size_t(joint.b);
  };
  for (const Joint& joint : assembly.joints)
    if (const std::size_t i = place_of(joint); i == 0 || i == n)
      for (const Vec3& p : joint.polygon) feet += 0.5 * p / double(joint.polygon.size());
  for (const Joint& joint : assembly.joints) {
    const auto nearer = [&](const Vec3& a, const Vec3& b) {
      const auto from_feet = [&](const Vec3& p) { return std::hypot(p.x() - feet.x(), p.z() - feet.z()); };
      return from_feet(a) < from_feet(b);
    };
    const auto [in, out] = std::minmax_element(joint.polygon.begin(), joint.polygon.end(), nearer);
    line.intrados[place_of(joint)] = *in, line.extrados[place_of(joint)] = *out;
  }
  const auto load = [](const Block& block, const Vec3& force) {
    return Vec3(force.x(), block.centroid.z() * force.x() - block.centroid.x() * force.z(), force.z());
  };
  for (std::size_t b = 0; b < n; ++b) {
    const Block& block = assembly.blocks[b];
    line.loads.dead.push_back(load(block, Vec3(0.0, 0.0, -9.81 * block.mass)));
    line.loads.live.push_back(load(block, block.mass * acceleration));
  }
  return line;
}

}  // namespace voussoir::ladder
