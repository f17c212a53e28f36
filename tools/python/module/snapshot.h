// The state at an instant as arrays, in the assembly's order.
#pragma once
#include "geometry/assembly.h"
#include "solver/step/snapshot.h"
#include "tools/python/module/arrays.h"

namespace voussoir::python {

/// time (s), base_displacement (3; m); of each block displacement of the centroid since the reference placement (n, 3;
/// m), rotation (n, 4; unit quaternion w x y z), velocity (n, 3; m/s); of the fill's nodes fill_displacement (n, 3; m).
/// joints: a dictionary of columns in SI units, for joint_count joints of the assembly and then for contacts.
inline py::dict snapshot_of(const Assembly& assembly, const Snapshot& s) {
  py::dict d, joints;
  const auto& p = s.patches;
  using Patch = PatchSnapshot;
  d["time"] = s.time;
  d["joint_count"] = assembly.joints.size();
  d["base_displacement"] = vectors(std::vector<Vec3>{s.base_displacement}).reshape({py::ssize_t(3)});
  d["displacement"] = vectors(s.displacement);
  d["rotation"] = table<double>(s.rotation.size(), 4, [&](std::size_t i, std::size_t c) {
    return c == 0 ? s.rotation[i].w() : s.rotation[i].vec()[Eigen::Index(c) - 1];
  });
  d["velocity"] = vectors(s.velocity);
  d["fill_displacement"] = vectors(s.fill.displacement);
  joints["a"] = column<std::int64_t>(p, [](const Patch& x) { return x.a; });
  joints["b"] = column<std::int64_t>(p, [](const Patch& x) { return x.b; });
  joints["centroid"] = vectors(
      p, [](const Patch& x) { return x.polygon.size() < 3 ? Vec3(Vec3::Zero()) : polygon_centroid(x.polygon); });
  joints["normal"] = vectors(p, [](const Patch& x) { return x.normal; });
  const std::pair<const char*, double Patch::*> numbers[] = {{"area", &Patch::area},
                                                             {"opening", &Patch::opening},
                                                             {"slip", &Patch::slip},
                                                             {"largest_opening", &Patch::largest_opening},
                                                             {"largest_slip", &Patch::largest_slip},
                                                             {"normal_traction", &Patch::normal_traction},
                                                             {"shear_traction", &Patch::shear_traction},
                                                             {"eccentricity", &Patch::eccentricity},
                                                             {"utilisation", &Patch::utilisation},
                                                             {"bonded", &Patch::bonded}};
  for (const auto& [name, number] : numbers)
    joints[name] = column<double>(p, [m = number](const Patch& x) { return x.*m; });
  joints["had_bond"] = column<bool>(p, [](const Patch& x) { return x.had_bond; });
  joints["tie"] = column<bool>(p, [](const Patch& x) { return x.tie; });
  d["joints"] = joints;
  return d;
}

}  // namespace voussoir::python
