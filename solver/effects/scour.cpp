// The ground under part of a base is eroded: the joints on top of the base are cut at a line.
#include <algorithm>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

const char* const sides[] = {"x-", "x+", "y-", "y+"};

std::vector<std::string> places_of_scour(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const std::string& support : supports(assembly))
    for (const char* side : sides) names.push_back(support + " " + side);
  return names;
}

void apply_scour(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const std::string support = where.substr(0, where.size() - 3), side = where.substr(where.size() - 2);
  const std::int64_t base = base_of(assembly, support);
  const int axis = side[0] == 'x' ? 0 : 1;
  const double sign = side[1] == '-' ? -1.0 : 1.0;
  // What remains lies on the inner side of the line: sign · x[axis] <= offset.
  double near = 1e300, far = -1e300;
  for (const Joint& joint : assembly.joints)
    if (joint.a == base || joint.b == base)
      for (const Vec3& x : joint.polygon) near = std::min(near, sign * x[axis]), far = std::max(far, sign * x[axis]);
  const double offset = far - values[0] * (far - near);
  Vec3 normal = Vec3::Zero();
  normal[axis] = sign;
  for (Joint& joint : assembly.joints) {
    if (joint.a != base && joint.b != base) continue;
    joint.polygon = cut(joint.polygon, Plane{normal, offset});
    joint.area = joint.polygon.size() < 3 ? 0.0 : polygon_area(joint.polygon);
  }
  std::erase_if(assembly.joints, [](const Joint& joint) { return joint.area < 1e-8; });
}

}  // namespace

Effect scour() {
  return {
      "scour",
      "the ground under one side of the base of a support is eroded, so this side carries no load",
      "Inspect the foundation on that side under water, and measure the bed level along it after the next flood.",
      {{"lost_share", "-", "eroded share of the length or width of the base, from that side", 0.0, 0.9, 0.0, 0.3, 0.2}},
      places_of_scour,
      apply_scour,
      nullptr};
}

}  // namespace voussoir
