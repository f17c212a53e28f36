#include "tools/run/numbered_hinges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "solver/base/disjoint_sets.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

bool side_by_side(const Vec3& a, const Vec3& b, double size) {
  return std::hypot(a.x() - b.x(), a.z() - b.z()) < 0.5 * size && std::abs(a.y() - b.y()) < 1.5 * size;
}

}  // namespace

std::vector<NumberedHinge> numbered_hinges(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism,
                                           double size) {
  const std::vector<std::string> parts = parts_of_blocks(assembly);
  std::vector<std::string> edges;
  for (const MechanismJoint& joint : mechanism) edges.push_back(edge_name(assembly, joint));
  DisjointSets sets(mechanism.size());
  for (std::size_t i = 0; i < mechanism.size(); ++i)
    for (std::size_t k = i + 1; k < mechanism.size(); ++k)
      if (mechanism[i].slides == mechanism[k].slides && edges[i] == edges[k] &&
          side_by_side(mechanism[i].place, mechanism[k].place, size))
        sets.join(i, k);
  std::map<std::size_t, NumberedHinge> found;
  for (std::size_t i = 0; i < mechanism.size(); ++i) {
    const MechanismJoint& joint = mechanism[i];
    NumberedHinge& hinge = found[sets.of(i)];
    if (hinge.joints++ == 0) {
      const std::string &a = parts[std::size_t(joint.a)], &b = parts[std::size_t(joint.b)];
      hinge.slides = joint.slides, hinge.edge = edges[i], hinge.a = joint.a;
      hinge.where = a == b ? a : fmt::format("between {} and {}", a, b);
    }
    hinge.place += joint.place;
    hinge.opening = std::max(hinge.opening, joint.opening), hinge.slip = std::max(hinge.slip, joint.slip);
  }
  std::vector<NumberedHinge> all;
  for (auto& [set, hinge] : found) {
    hinge.place /= double(hinge.joints);
    all.push_back(hinge);
  }
  std::stable_sort(all.begin(), all.end(), [](const NumberedHinge& a, const NumberedHinge& b) {
    return std::pair(a.place.x(), a.place.z()) < std::pair(b.place.x(), b.place.z());
  });
  for (std::size_t i = 0; i < all.size(); ++i) all[i].number = int(i) + 1;
  return all;
}

std::vector<NumberedHinge> largest_hinges(std::vector<NumberedHinge> all, std::size_t most) {
  const auto motion = [](const NumberedHinge& h) { return std::max(h.opening, h.slip); };
  std::ranges::stable_sort(all, std::ranges::greater(), motion);
  if (all.size() > most) all.erase(all.begin() + std::ptrdiff_t(most), all.end());
  std::ranges::sort(all, {}, &NumberedHinge::number);
  return all;
}

}  // namespace voussoir
