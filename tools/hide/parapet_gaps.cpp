#include "tools/hide/parapet_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "solver/base/error.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

constexpr double left_of_stiffness = 1e-3;

struct ParapetJoint {
  std::size_t joint = 0;
  Vec3 place = Vec3::Zero();
  bool head = false;
};

/// Joints inside the parapet of a side.
std::vector<ParapetJoint> parapet_joints(const Assembly& assembly, int side) {
  std::vector<ParapetJoint> found;
  const BlockSet stones =
      blocks_where(assembly, [&](const Block& b) { return b.component == Component::parapet && b.part == side; });
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const Joint& j = assembly.joints[i];
    if (stones[std::size_t(j.a)] && stones[std::size_t(j.b)] && !is_tie(assembly, j))
      found.push_back({i, polygon_centroid(j.polygon), std::abs(j.normal.x()) > 0.9});
  }
  return found;
}

void soften(Assembly& assembly, std::size_t joint) {
  assembly.joints[joint].kn *= left_of_stiffness;
  assembly.joints[joint].ks *= left_of_stiffness;
}

/// The gap follows the head joints from course to course.
void open_at(Assembly& assembly, const std::vector<ParapetJoint>& joints, double x) {
  std::map<long, const ParapetJoint*> nearest;  // by course
  for (const ParapetJoint& j : joints) {
    if (!j.head) continue;
    const ParapetJoint*& own = nearest[std::lround(100.0 * j.place.z())];
    if (!own || std::abs(j.place.x() - x) < std::abs(own->place.x() - x)) own = &j;
  }
  double from = 1e300, to = -1e300;
  for (const auto& [course, j] : nearest) {
    soften(assembly, j->joint);
    from = std::min(from, j->place.x()), to = std::max(to, j->place.x());
  }
  for (const ParapetJoint& j : joints)
    if (!j.head && j.place.x() > from && j.place.x() < to) soften(assembly, j.joint);
}

}  // namespace

std::vector<std::string> open_parapets(Assembly& assembly, const HideRequest& request) {
  std::vector<std::string> places;
  std::vector<std::vector<ParapetJoint>> sides = {parapet_joints(assembly, 0), parapet_joints(assembly, 1)};
  for (int gap = 0; gap < request.parapet_gaps; ++gap) {
    RandomStream random = stream_of(request, "parapet gap", gap);
    const std::size_t side = random.below(2);
    double low = 1e300, high = -1e300;
    for (const ParapetJoint& j : sides[side])
      if (j.head) low = std::min(low, j.place.x()), high = std::max(high, j.place.x());
    if (low > high)
      throw InputError("--parapet-gaps {}: this bridge has no parapet with joints between stones. Leave the option out",
                       request.parapet_gaps);
    const double x = low + (high - low) * random.uniform();
    open_at(assembly, sides[side], x);
    places.push_back(fmt::format("parapet {} at {:.2f} m", side == 0 ? "y-" : "y+", x));
  }
  return places;
}

}  // namespace voussoir
