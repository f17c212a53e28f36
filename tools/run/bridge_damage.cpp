#include "tools/run/bridge_damage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/rings.h"
#include "solver/base/counted.h"
#include "solver/statics/hinges.h"
#include "viz/crack_map/cracks.h"

namespace voussoir {

namespace {

enum Criterion : std::size_t {
  seating_share,
  hinge_count,
  ring_share,
  spandrel_share,
  lean_share,
  fallen_count,
  crack_width
};

constexpr double kSeparated = 1e-3;  // m of opening or slip from which two parts no longer act as one

CrackedPart part_of(const Assembly& assembly, std::int64_t block) {
  const Block& b = assembly.blocks[std::size_t(block)];
  return {b.component, b.part};
}

/// How far a block reaches along a direction, m.
double reach_of(const Block& block, const Vec3& way) {
  double low = 1e300, high = -1e300;
  for (const Polyhedron& cell : block.cells)
    for (const Vec3& p : cell.vertices) low = std::min(low, p.dot(way)), high = std::max(high, p.dot(way));
  return high - low;
}

/// Whether one stone is supported by the other at this joint: bed joints of vaults, and joints that carry weight.
bool is_bearing(const Joint& joint, const CrackedPart& a, const CrackedPart& b) {
  if (a.component == Component::arch && a == b) return std::abs(joint.normal.y()) < 0.7;
  return std::abs(joint.normal.z()) > 0.5;
}

/// Slip divided by the depth of the shorter of the two stones, measured along the slip.
double seating_lost(const Assembly& assembly, const Snapshot& snapshot, const Joint& joint) {
  Vec3 slip = moved_apart(assembly, snapshot, joint, polygon_centroid(joint.polygon));
  slip -= joint.normal.dot(slip) * joint.normal;
  const double length = slip.norm();
  if (length < 1e-9) return 0.0;
  const auto depth = [&](std::int64_t block) { return reach_of(assembly.blocks[std::size_t(block)], slip / length); };
  return length / std::min(depth(joint.a), depth(joint.b));
}

/// Finds the worst of each criterion in each part.
class Worst {
 public:
  void take(Criterion criterion, const std::string& where, double measure) {
    const double(&from)[4] = bridge_criteria()[criterion].from;
    const auto grade = std::size_t(std::ranges::count_if(from, [&](double limit) { return measure >= limit; }));
    if (grade == 0) return;
    BridgeFinding& found = found_[{criterion, where}];
    if (measure > found.measure) found = {bridge_criteria()[criterion].what, where, measure, grade};
  }
  std::vector<BridgeFinding> sorted() const {
    std::vector<BridgeFinding> all;
    for (const auto& [key, finding] : found_) all.push_back(finding);
    std::ranges::stable_sort(all, [](const BridgeFinding& a, const BridgeFinding& b) { return a.grade > b.grade; });
    return all;
  }

 private:
  std::map<std::pair<std::size_t, std::string>, BridgeFinding> found_;
};

struct Share {
  double area = 0.0, apart = 0.0;  // m2
  void add(double of, bool is_apart) { area += of, apart += is_apart ? of : 0.0; }
};

void take_joints(Worst& worst, const Assembly& assembly, const Snapshot& snapshot) {
  const RingJoints between_rings(assembly);
  std::map<std::int32_t, Share> ring_shares;
  std::map<CrackedPart, Share> spandrel_shares;
  const std::vector<JointGaps> gaps = joint_gaps(assembly, snapshot);
  for (std::size_t i = 0; i < gaps.size() && i < snapshot.patches.size(); ++i) {
    const Joint& joint = assembly.joints[i];
    const CrackedPart a = part_of(assembly, joint.a), b = part_of(assembly, joint.b);
    if (snapshot.patches[i].tie || a.component == Component::backfill || b.component == Component::backfill) continue;
    const JointGap& ever = gaps[i].ever;
    const std::string where =
        a == b ? part_words(a) : "between " + part_words(std::min(a, b)) + " and " + part_words(std::max(a, b));
    if (ever.fallen()) continue;  // take_fallen() counts fallen stones
    worst.take(crack_width, where, ever.width());
    if (!between_rings(joint) && is_bearing(joint, a, b))
      worst.take(seating_share, where, seating_lost(assembly, snapshot, joint));
    if (between_rings(joint)) ring_shares[a.part].add(joint.area, ever.width() >= kSeparated);
    const auto [lower, upper] = std::minmax(a, b);
    if (lower.component == Component::arch && upper.component == Component::spandrel)
      spandrel_shares[upper].add(joint.area, ever.width() >= kSeparated);
  }
  for (const auto& [part, share] : ring_shares)
    worst.take(ring_share, part_words({Component::arch, part}), share.apart / share.area);
  for (const auto& [part, share] : spandrel_shares)
    worst.take(spandrel_share, part_words(part), share.apart / share.area);
}

/// Number of alternating hinges along a line. Consecutive hinges on the same side count as one.
std::size_t alternating(const std::vector<Hinge>& of_ring, double y) {
  std::size_t count = 0;
  std::string before;
  for (const Hinge& hinge : of_ring)  // along x
    if (y > hinge.y0 && y < hinge.y1 && hinge.edge != before) ++count, before = hinge.edge;
  return count;
}

/// The smallest number of alternating hinges over all rings and some positions across the vault. The vault as a whole
/// has no more than these.
void take_hinges(Worst& worst, const Assembly& assembly, const Snapshot& snapshot) {
  constexpr int places = 5;
  const RingJoints ring_joints(assembly);
  std::map<std::int32_t, std::pair<double, double>> across;                   // y of each vault
  std::map<std::int32_t, std::map<std::uint32_t, std::vector<Hinge>>> found;  // of each ring: its bit
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (block.component != Component::arch) continue;
    const Box box = block_box(block);
    auto& [low, high] = across.try_emplace(block.part, 1e300, -1e300).first->second;
    low = std::min(low, box.low.y()), high = std::max(high, box.high.y());
    for (std::uint32_t bit = 1, rings = std::max(1u, ring_joints.rings_of(std::int64_t(i))); bit <= rings; bit *= 2)
      if (rings & bit) found[block.part][bit];  // an entry without hinges for each ring
  }
  for (const Hinge& hinge : find_hinges(assembly, snapshot)) {
    const bool first = part_of(assembly, hinge.a).component == Component::arch;
    const std::int64_t stone = first ? hinge.a : hinge.b;
    for (auto& [bit, of_ring] : found[part_of(assembly, stone).part])
      if (std::max(1u, ring_joints.rings_of(stone)) & bit) of_ring.push_back(hinge);
  }
  for (auto& [part, of_vault] : found) {
    const auto [low, high] = across[part];
    std::size_t least = SIZE_MAX;
    for (auto& [bit, of_ring] : of_vault) {
      std::ranges::stable_sort(of_ring, {}, [](const Hinge& h) { return h.place.x(); });
      for (int k = 0; k < places; ++k)
        least = std::min(least, alternating(of_ring, low + (k + 0.5) / places * (high - low)));
    }
    worst.take(hinge_count, part_words({Component::arch, part}), double(least));
  }
}

/// Mean y-displacement, in each metre along the bridge, of the blocks that walls stand on and enclose. Where there are
/// none, the displacement of the ground.
class BridgeBody {
 public:
  BridgeBody(const Assembly& assembly, const Snapshot& snapshot) : ground_(snapshot.base_displacement.y()) {
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
      const Block& block = assembly.blocks[i];
      if (is_wall(block.component) || block.component == Component::backfill || block.fixed) continue;
      auto& [sum, mass] = metres_[metre(block)];
      sum += block.mass * snapshot.displacement[i].y(), mass += block.mass;
    }
  }
  double beside(const Block& block) const {
    const auto at = metres_.find(metre(block));
    return at == metres_.end() ? ground_ : at->second.first / at->second.second;
  }

 private:
  static std::int64_t metre(const Block& block) { return std::int64_t(std::floor(block.centroid.x())); }
  double ground_;
  std::map<std::int64_t, std::pair<double, double>> metres_;  // mass times displacement; mass
};

/// Displacement of the stones of a wall across the wall, relative to the body of the bridge next to them, divided by
/// the thickness of the wall (the median of its stones).
void take_walls(Worst& worst, const Assembly& assembly, const Snapshot& snapshot) {
  struct Wall {
    std::vector<double> thickness;  // m
    double moved = 0.0;             // m
  };
  const BridgeBody body(assembly, snapshot);
  std::map<CrackedPart, Wall> walls;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    if (!is_wall(block.component) || block.fixed) continue;
    const Box box = block_box(block);
    Wall& wall = walls[{block.component, block.part}];
    wall.thickness.push_back(box.high.y() - box.low.y());
    const double moved = std::abs(snapshot.displacement[i].y() - body.beside(block));
    if (moved < kStoneFell) wall.moved = std::max(wall.moved, moved);
  }
  for (auto& [part, wall] : walls) {
    const auto middle = wall.thickness.begin() + std::ptrdiff_t(wall.thickness.size() / 2);
    std::ranges::nth_element(wall.thickness, middle);
    worst.take(lean_share, part_words(part), wall.moved / *middle);
  }
}

void take_fallen(Worst& worst, const Assembly& assembly, const Snapshot& snapshot) {
  std::map<CrackedPart, double> counts;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (!assembly.blocks[i].fixed && assembly.blocks[i].component != Component::backfill &&
        (snapshot.displacement[i] - snapshot.base_displacement).norm() >= kStoneFell)
      ++counts[part_of(assembly, std::int64_t(i))];
  for (const auto& [part, count] : counts) worst.take(fallen_count, part_words(part), count);
}

}  // namespace

const std::vector<std::string>& bridge_classes() {
  static const std::vector<std::string> classes = {"sound", "slight", "marked", "serious", "bearing lost"};
  return classes;
}

const std::vector<BridgeCriterion>& bridge_criteria() {
  static const std::vector<BridgeCriterion> criteria = {
      {"seating lost", "slip divided by the depth of the shorter stone", {0.02, 0.1, 0.25, 0.5}},
      {"hinges",
       "number of hinges that alternate along the vault, over its whole width and in each ring",
       {1, 2, 3, 4}},
      {"rings apart", "separated share of the area between the rings", {0.02, 0.1, 1.0 / 3.0, 0.9}},
      {"spandrel wall apart from the vault",
       "separated share of the area between them",
       {0.02, 0.1, 1.0 / 3.0, INFINITY}},
      {"wall moved out",
       "displacement across the wall, relative to the masonry next to it, divided by the thickness of the wall",
       {0.02, 0.1, 1.0 / 3.0, 1.0}},
      {"stones fell", "number", {1, 1, 1, 1}},
      {"crack", "width, m", {3e-4, 3e-3, 3e-2, INFINITY}}};
  return criteria;
}

std::string BridgeFinding::sentence() const {
  const std::vector<BridgeCriterion>& all = bridge_criteria();
  if (what == all[crack_width].what) return fmt::format("{}: crack of {} mm", where, width_text(measure));
  if (what == all[seating_share].what)
    return fmt::format("{}: a joint has slipped by {:.0f} % of a stone's depth", where, 100.0 * measure);
  if (what == all[hinge_count].what)
    return fmt::format("{}: {}", where, counted(std::lround(measure), "hinge", "hinges that alternate"));
  if (what == all[ring_share].what)
    return fmt::format("{}: the rings have separated over {:.0f} % of their area", where, 100.0 * measure);
  if (what == all[spandrel_share].what)
    return fmt::format("{}: separated from the vaults over {:.0f} % of the area between them", where, 100.0 * measure);
  if (what == all[lean_share].what)
    return fmt::format("{}: moved out by {:.0f} % of its thickness", where, 100.0 * measure);
  return fmt::format("{}: {} fell", where, counted(std::lround(measure), "stone"));
}

std::vector<BridgeFinding> bridge_findings(const Assembly& assembly, const Snapshot& snapshot) {
  Worst worst;
  take_joints(worst, assembly, snapshot);
  take_hinges(worst, assembly, snapshot);
  take_walls(worst, assembly, snapshot);
  take_fallen(worst, assembly, snapshot);
  return worst.sorted();
}

nlohmann::json bridge_damage_json(const Assembly& assembly, const Snapshot& snapshot) {
  const std::vector<BridgeFinding> found = bridge_findings(assembly, snapshot);
  nlohmann::json findings = nlohmann::json::array();
  for (const BridgeFinding& f : found)
    findings.push_back({{"what", f.what},
                        {"where", f.where},
                        {"measure", f.measure},
                        {"class", bridge_classes()[f.grade]},
                        {"words", f.sentence()}});
  return {{"class", bridge_classes()[found.empty() ? 0 : found.front().grade]}, {"findings", findings}};
}

}  // namespace voussoir
