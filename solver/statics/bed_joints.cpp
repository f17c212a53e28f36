#include "solver/statics/bed_joints.h"

#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/rings.h"
#include "solver/base/disjoint_sets.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

constexpr double is_heading = 0.9;   // |n_y| of a joint between stones side by side across the barrel
constexpr double is_end_face = 0.8;  // cosine between an end course's axis and the normal of what it stands on

/// Vault, ring, and the two courses between which it lies; the second is none (a springing) or the greater.
using BedKey = std::tuple<std::int32_t, std::int32_t, std::int64_t, std::int64_t>;
constexpr std::int64_t springing = -1;
using Beds = std::map<BedKey, std::vector<std::size_t>>;  // numbers of Snapshot::patches

/// Which stones lie side by side across the barrel, and which patches lie between such courses.
class Courses {
 public:
  Courses(const Assembly& assembly, const RestForces& rest)
      : assembly_(assembly), rest_(rest), snapshot_(rest.snapshot), rings_(assembly), sets_(assembly.blocks.size()) {
    for (const Joint& joint : assembly.joints)
      if (common_rings(joint.a, joint.b) && std::abs(joint.normal.y()) > is_heading)
        sets_.join(std::size_t(joint.a), std::size_t(joint.b));
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
      if (!is_voussoir(std::int64_t(i))) continue;
      auto& [sum, count] = middles_.try_emplace(course(std::int64_t(i)), Vec3::Zero(), 0.0).first->second;
      sum += assembly.blocks[i].centroid + snapshot_.displacement[i], count += 1.0;
    }
  }

  Beds beds() {
    Beds beds;
    for (std::size_t i = 0; i < snapshot_.patches.size(); ++i) {
      const PatchSnapshot& p = snapshot_.patches[i];
      if (is_none(i)) continue;
      const std::uint32_t common = common_rings(p.a, p.b);
      const auto [low, high] = std::minmax({course(p.a), course(p.b)});
      if (common && low != high) beds[{part_of(p.a), lowest(common), low, high}].push_back(i);
    }
    const std::map<std::int64_t, Vec3> ends = ends_of(beds);
    for (std::size_t i = 0; i < snapshot_.patches.size(); ++i) {
      const PatchSnapshot& p = snapshot_.patches[i];
      if (is_none(i) || is_voussoir(p.a) == is_voussoir(p.b)) continue;
      const std::int64_t stone = is_voussoir(p.a) ? p.a : p.b;
      const auto end = ends.find(course(stone));
      const Vec3 out = stone == p.a ? p.normal : -p.normal;
      if (end != ends.end() && out.dot(end->second) > is_end_face)
        beds[{part_of(stone), lowest(rings(stone)), course(stone), springing}].push_back(i);
    }
    return beds;
  }

 private:
  /// Ties, joints that were replaced by a contact, and contacts of nearby faces without force.
  bool is_none(std::size_t patch) const {
    const PatchSnapshot& p = snapshot_.patches[patch];
    const bool met = patch >= assembly_.joints.size();
    return p.tie || p.replaced || (met && rest_.forces[patch].force.isZero(0.0));
  }
  /// Courses with neighbours on one side only, and the way from there on (unit).
  std::map<std::int64_t, Vec3> ends_of(const Beds& beds) {
    std::map<std::int64_t, std::pair<Vec3, double>> ways;
    for (const auto& [key, patches] : beds) {
      Vec3 centre = Vec3::Zero();
      double area = 0.0;
      for (const std::size_t i : patches) {
        const PatchSnapshot& p = snapshot_.patches[i];
        centre += p.area * polygon_centroid(p.polygon), area += p.area;
      }
      for (const std::int64_t at : {std::get<2>(key), std::get<3>(key)}) {
        const auto& [middle, count] = middles_.at(at);
        auto& [way, beside] = ways.try_emplace(at, Vec3::Zero(), 0.0).first->second;
        way += (middle / count - centre / area).normalized(), beside += 1.0;
      }
    }
    std::map<std::int64_t, Vec3> ends;
    for (const auto& [at, way] : ways)
      if (way.first.norm() > 0.5 * way.second) ends[at] = way.first.normalized();
    return ends;
  }

  bool is_voussoir(std::int64_t block) const {
    return assembly_.blocks[std::size_t(block)].component == Component::arch;
  }
  std::int32_t part_of(std::int64_t block) const { return assembly_.blocks[std::size_t(block)].part; }
  std::int64_t course(std::int64_t block) { return std::int64_t(sets_.of(std::size_t(block))); }
  /// One bit a ring of its vault; a vault of one ring has that.
  std::uint32_t rings(std::int64_t block) const { return std::max(1u, rings_.rings_of(block)); }
  std::uint32_t common_rings(std::int64_t a, std::int64_t b) const {
    const bool one_vault = is_voussoir(a) && is_voussoir(b) && part_of(a) == part_of(b);
    return one_vault ? rings(a) & rings(b) : 0u;
  }
  static std::int32_t lowest(std::uint32_t rings) { return std::countr_zero(rings); }

  const Assembly& assembly_;
  const RestForces& rest_;
  const Snapshot& snapshot_;
  RingJoints rings_;
  DisjointSets sets_;
  std::map<std::int64_t, std::pair<Vec3, double>> middles_;  // of each course: sum of centroids, stones
};

/// The patches that define the position and axes of a bed joint: its original joints, if any remain. Contacts carry a
/// part of the force, but their faces can be inclined.
std::vector<std::size_t> shape_of(const std::vector<std::size_t>& patches, std::size_t joints) {
  std::vector<std::size_t> built;
  for (const std::size_t i : patches)
    if (i < joints) built.push_back(i);
  return built.empty() ? patches : built;
}

/// Geometry of a bed: area, centre and mean normal, which still may point either way.
BedJoint bed_of(const BedKey& key, const std::vector<std::size_t>& patches, const Snapshot& snapshot) {
  BedJoint bed;
  bed.vault = std::get<0>(key), bed.ring = std::get<1>(key);
  bed.n = Vec3::Zero();
  for (const std::size_t i : patches) {
    const PatchSnapshot& p = snapshot.patches[i];
    bed.area += p.area;
    bed.centre += p.area * polygon_centroid(p.polygon);
    bed.n += (p.normal.dot(bed.n) < 0.0 ? -p.area : p.area) * p.normal;
  }
  bed.centre /= bed.area;
  bed.n.normalize();
  return bed;
}

/// Of one ring: the direction that no bed's normal has, which is along the barrel; y where that is not one.
Vec3 barrel_axis(const std::vector<BedJoint>& ring) {
  constexpr double towards_y = 1e-6;
  Mat3 sum = -towards_y * Vec3::UnitY() * Vec3::UnitY().transpose();
  for (const BedJoint& bed : ring) sum += bed.n * bed.n.transpose() / double(ring.size());
  const Vec3 axis = eigen_solution(Eigen::MatrixXd(sum)).vectors.col(0);
  return axis.y() < 0.0 ? axis : Vec3(-axis);
}

/// The point under the ring, half its span below its lowest joint, from which every joint is seen after the other.
Vec3 below_ring(const std::vector<BedJoint>& ring) {
  double x0 = 1e300, x1 = -1e300, z = 1e300;
  for (const BedJoint& bed : ring)
    x0 = std::min(x0, bed.centre.x()), x1 = std::max(x1, bed.centre.x()), z = std::min(z, bed.centre.z());
  return {0.5 * (x0 + x1), 0.0, z - 0.5 * (x1 - x0)};
}

/// Axes of the beds, n from left to right, and their order along the ring.
void lay_out(std::vector<BedJoint>& ring) {
  const Vec3 from = below_ring(ring), axis = barrel_axis(ring);
  const auto angle = [&](const BedJoint& bed) {
    return std::atan2(bed.centre.x() - from.x(), bed.centre.z() - from.z());
  };
  for (BedJoint& bed : ring) {
    const Vec3 out = bed.centre - from, along(out.z(), 0.0, -out.x());
    bed.g = axis;
    bed.n = (bed.n - bed.n.dot(axis) * axis).normalized();
    if (bed.n.dot(along) < 0.0) bed.n = -bed.n;
    bed.d = bed.g.cross(bed.n);
  }
  std::stable_sort(ring.begin(), ring.end(), [&](const BedJoint& a, const BedJoint& b) { return angle(a) < angle(b); });
}

double reach_along(const Vec3& axis, const std::vector<std::size_t>& patches, const Snapshot& snapshot) {
  double low = 1e300, high = -1e300;
  for (const std::size_t i : patches)
    for (const Vec3& p : snapshot.patches[i].polygon)
      low = std::min(low, axis.dot(p)), high = std::max(high, axis.dot(p));
  return high - low;
}

/// What the left side puts on the right. With n × d = g a force N n + … through e d + f g has the moments
/// M · g = −e N and M · d = f N about the centre.
void add_up(BedJoint& bed, const std::vector<std::size_t>& patches, const RestForces& rest, std::size_t joints) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double capacity = 0.0;
  for (const std::size_t i : patches) {
    const PatchForce& f = rest.forces[i];
    const double sign = rest.snapshot.patches[i].normal.dot(bed.n) > 0.0 ? -1.0 : 1.0;  // n from a to b: b is right
    force += sign * f.force;
    moment += sign * (f.moment - bed.centre.cross(f.force));
    capacity += f.shear_capacity;
    bed.largest_compression = std::max(bed.largest_compression, f.largest_compression);
  }
  bed.normal = force.dot(bed.n), bed.shear = force.dot(bed.d), bed.shear_across = force.dot(bed.g);
  bed.torsion = moment.dot(bed.n);
  const double none = std::nan("");
  bed.eccentricity = bed.normal > 0.0 ? -moment.dot(bed.g) / bed.normal : none;
  bed.eccentricity_across = bed.normal > 0.0 ? moment.dot(bed.d) / bed.normal : none;
  bed.utilisation = capacity > 0.0 ? std::hypot(bed.shear, bed.shear_across) / capacity : none;
  const std::vector<std::size_t> shape = shape_of(patches, joints);
  bed.depth = reach_along(bed.d, shape, rest.snapshot), bed.width = reach_along(bed.g, shape, rest.snapshot);
}

}  // namespace

std::vector<BedJoint> bed_joints(const Assembly& assembly, const RestForces& rest) {
  const Beds beds = Courses(assembly, rest).beds();
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<BedJoint>> rings;
  std::vector<const std::vector<std::size_t>*> patches;
  for (const auto& [key, of] : beds) {
    BedJoint bed = bed_of(key, shape_of(of, assembly.joints.size()), rest.snapshot);
    bed.number = std::int32_t(patches.size());  // which patches it has, until they are in order
    patches.push_back(&of);
    rings[{bed.vault, bed.ring}].push_back(bed);
  }
  std::vector<BedJoint> all;
  for (auto& [which, ring] : rings) {
    lay_out(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      add_up(ring[i], *patches[std::size_t(ring[i].number)], rest, assembly.joints.size());
      ring[i].number = std::int32_t(i);
      all.push_back(ring[i]);
    }
  }
  return all;
}

}  // namespace voussoir
