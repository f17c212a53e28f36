#include "viz/crack_map/cracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "solver/base/csv.h"
#include "solver/base/disjoint_sets.h"
#include "viz/crack_map/crack_words.h"

namespace voussoir {

namespace {

using Parts = std::array<CrackedPart, 2>;

Parts parts_of(const Assembly& assembly, const Joint& joint) {
  const Block &a = assembly.blocks[std::size_t(joint.a)], &b = assembly.blocks[std::size_t(joint.b)];
  Parts parts = {CrackedPart{a.component, a.part}, CrackedPart{b.component, b.part}};
  if (parts[1] < parts[0]) std::swap(parts[0], parts[1]);
  return parts;
}

/// Least distance between two segments, squared (Ericson 2005, section 5.1.9).
double distance_squared(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2) {
  const Vec3 d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r), c = d1.dot(r), b = d1.dot(d2);
  const double denominator = a * e - b * b;
  double s = denominator > 1e-12 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0.0) t = 0.0, s = std::clamp(-c / a, 0.0, 1.0);
  if (t > 1.0) t = 1.0, s = std::clamp((b - c) / a, 0.0, 1.0);
  return (p1 + s * d1 - p2 - t * d2).squaredNorm();
}

/// Whether two joints share an edge, a part of one or a corner.
bool touch(const Joint& one, const Joint& other) {
  const double near = 0.01 * std::sqrt(std::min(one.area, other.area));
  for (std::size_t i = 0; i < one.polygon.size(); ++i)
    for (std::size_t k = 0; k < other.polygon.size(); ++k)
      if (distance_squared(one.polygon[i], one.polygon[(i + 1) % one.polygon.size()], other.polygon[k],
                           other.polygon[(k + 1) % other.polygon.size()]) < near * near)
        return true;
  return false;
}

struct OpenJoint {
  std::size_t joint = 0;
  Box box;
};

/// The sets of connected joints; only joints of the same pair of parts are connected. Found by a sweep along x.
std::vector<std::vector<std::size_t>> joined(const Assembly& assembly, std::vector<OpenJoint> open) {
  std::ranges::stable_sort(open, {}, [](const OpenJoint& j) { return j.box.low.x(); });
  DisjointSets sets(open.size());
  const auto apart = [](const Box& a, const Box& b, double near) {
    return ((a.low.array() > b.high.array() + near) || (b.low.array() > a.high.array() + near)).any();
  };
  for (std::size_t i = 0; i < open.size(); ++i)
    for (std::size_t k = i + 1; k < open.size(); ++k) {
      const Joint &one = assembly.joints[open[i].joint], &other = assembly.joints[open[k].joint];
      const double near = 0.01 * std::sqrt(one.area);
      if (open[k].box.low.x() > open[i].box.high.x() + near) break;
      if (!apart(open[i].box, open[k].box, near) && sets.of(i) != sets.of(k) && touch(one, other)) sets.join(i, k);
    }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < open.size(); ++i) members[sets.of(i)].push_back(open[i].joint);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [set, joints] : members) {
    std::ranges::sort(joints);
    all.push_back(std::move(joints));
  }
  return all;
}

void widen(JointGap& gap, const JointGap& by) {
  gap.opening = std::max(gap.opening, by.opening), gap.slip = std::max(gap.slip, by.slip);
}

/// Distance between the faces of a joint, and between their points that were adjacent as built.
JointGap gap_between(const Assembly& assembly, const Snapshot& snapshot, const Joint& joint) {
  JointGap gap;
  for (const Vec3& corner : joint.polygon)
    gap.opening = std::max(gap.opening, joint.normal.dot(moved_apart(assembly, snapshot, joint, corner)));
  const Vec3 apart = moved_apart(assembly, snapshot, joint, polygon_centroid(joint.polygon));
  gap.slip = (apart - joint.normal.dot(apart) * joint.normal).norm();
  return gap;
}

Crack crack_of(const Assembly& assembly, const std::vector<JointGaps>& gaps, const Parts& parts,
               std::vector<std::size_t> joints) {
  Crack crack;
  crack.parts = parts;
  crack.joints = std::move(joints);
  for (const std::size_t i : crack.joints) {
    const Box own = bounding_box(assembly.joints[i].polygon);
    crack.box.low = crack.box.low.cwiseMin(own.low), crack.box.high = crack.box.high.cwiseMax(own.high);
    crack.area += assembly.joints[i].area;
    widen(crack.ever, gaps[i].ever);
    widen(crack.now, gaps[i].now);
  }
  return crack;
}

}  // namespace

Vec3 moved_apart(const Assembly& assembly, const Snapshot& snapshot, const Joint& joint, const Vec3& at) {
  const auto moved = [&](std::int64_t block) -> Vec3 {
    const Vec3 arm = at - assembly.blocks[std::size_t(block)].centroid;
    return snapshot.displacement[std::size_t(block)] + snapshot.rotation[std::size_t(block)] * arm - arm;
  };
  return moved(joint.b) - moved(joint.a);
}

std::vector<JointGaps> joint_gaps(const Assembly& assembly, const Snapshot& snapshot) {
  std::vector<JointGaps> gaps(assembly.joints.size());
  for (std::size_t i = 0; i < gaps.size() && i < snapshot.patches.size(); ++i) {
    const PatchSnapshot& patch = snapshot.patches[i];
    if (patch.tie) continue;
    gaps[i].now = {patch.opening, patch.slip};
    gaps[i].ever = {patch.largest_opening, patch.largest_slip};
    if (patch.replaced) gaps[i].now = gap_between(assembly, snapshot, assembly.joints[i]);
    widen(gaps[i].ever, gaps[i].now);
  }
  return gaps;
}

bool is_wall(Component c) {
  return c == Component::spandrel || c == Component::parapet || c == Component::wall;
}

std::string part_words(const CrackedPart& part) {
  static const char* const sides[] = {" y-", " y+", " internal"};
  const std::string name = component_names()[std::size_t(part.component)];
  const bool sided = part.part >= 0 && part.part < 3;
  if (part.component == Component::spandrel || part.component == Component::parapet)
    return name + (sided ? sides[part.part] : "");
  if (part.component == Component::arch || part.component == Component::pier)
    return fmt::format("{} {}", name, part.part);
  if (part.component == Component::abutment) return part.part == 0 ? "abutment left" : "abutment right";
  if (part.component == Component::block) return "blocks";
  return name;
}

std::vector<Crack> find_cracks(const Assembly& assembly, const std::vector<JointGaps>& gaps,
                               const std::vector<Intrados>& vaults, double threshold, CrackState state) {
  const auto is_soil = [&](std::int64_t block) {
    return assembly.blocks[std::size_t(block)].component == Component::backfill;
  };
  std::map<Parts, std::vector<OpenJoint>> open;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const Joint& joint = assembly.joints[i];
    if (is_soil(joint.a) || is_soil(joint.b)) continue;
    if (gaps[i].in(state).width() >= threshold)
      open[parts_of(assembly, joint)].push_back({i, bounding_box(joint.polygon)});
  }
  std::vector<Crack> cracks;
  for (auto& [parts, joints] : open)
    for (std::vector<std::size_t>& together : joined(assembly, std::move(joints)))
      cracks.push_back(crack_of(assembly, gaps, parts, std::move(together)));
  const auto width = [&](const Crack& c) { return (state == CrackState::ever ? c.ever : c.now).width(); };
  std::ranges::stable_sort(cracks, [&](const Crack& a, const Crack& b) {
    return std::tuple(-width(a), -a.area, a.joints.front()) < std::tuple(-width(b), -b.area, b.joints.front());
  });
  const CrackWords words(assembly, vaults);
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    cracks[k].number = int(k + 1);
    words.describe(cracks[k]);
  }
  return cracks;
}

std::vector<Crack> find_cracks(const Assembly& assembly, const Snapshot& snapshot, double threshold, CrackState state) {
  return find_cracks(assembly, joint_gaps(assembly, snapshot), find_intrados(measure(assembly)), threshold, state);
}

std::string width_text(double metres) {
  const double mm = 1e3 * metres;
  return fmt::format("{:.{}f}", mm, mm < 0.995 ? 2 : mm < 9.95 ? 1 : 0);
}

std::string crack_table(const std::vector<Crack>& cracks) {
  std::string text =
      "number,where,direction,length_m,opening_mm,slip_mm,opening_now_mm,slip_now_mm,joints,area_m2,"
      "x0_m,x1_m,y0_m,y1_m,z0_m,z1_m\n";
  for (const Crack& c : cracks)
    text +=
        fmt::format("{},{},{},{:.3f},{:.4g},{:.4g},{:.4g},{:.4g},{},{:.4g},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n",
                    c.number, csv_cell(c.where), csv_cell(c.direction), c.length, 1e3 * c.ever.opening,
                    1e3 * c.ever.slip, 1e3 * c.now.opening, 1e3 * c.now.slip, c.joints.size(), c.area, c.box.low.x(),
                    c.box.high.x(), c.box.low.y(), c.box.high.y(), c.box.low.z(), c.box.high.z());
  return text;
}

}  // namespace voussoir
