#include "viz/arrangement/measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace voussoir {

namespace {

/// An edge of the outline of a vault's section, the vault on its left.
struct Rim {
  Vec3 from, to;
  bool bare = false;  // nothing lies beyond it
  Vec3 outward() const { return Vec3(to.y() - from.y(), from.x() - to.x(), 0.0).normalized(); }
  Vec3 middle() const { return 0.5 * (from + to); }
};

std::vector<Rim> rim_of(const std::vector<FlatFace>& section, std::int32_t part) {
  std::vector<const FlatFace*> own;
  for (const FlatFace& face : section)
    if (face.component == Component::arch && face.part == part) own.push_back(&face);
  const auto in_vault = [&](const Vec3& at) {
    return std::ranges::any_of(own, [&](auto* f) { return holds(*f, at); });
  };
  const auto in_any = [&](const Vec3& at) {
    return std::ranges::any_of(section, [&](auto& f) { return holds(f, at); });
  };
  std::vector<Rim> rim;
  for (const FlatFace* face : own)
    for (std::size_t i = 0; i < face->corners.size(); ++i) {
      Rim edge = {face->corners[i], face->corners[(i + 1) % face->corners.size()]};
      const Vec3 beside = edge.middle() + std::min(2e-3, 0.02 * (edge.to - edge.from).norm()) * edge.outward();
      if (in_vault(beside)) continue;
      edge.bare = !in_any(beside);
      rim.push_back(edge);
    }
  return rim;
}

/// Half the width of the opening and its middle at the feet; the edges of an intrados face this point.
std::vector<Rim> intrados_of(const std::vector<Rim>& rim) {
  Box box;
  for (const Rim& edge : rim) box.low = box.low.cwiseMin(edge.from), box.high = box.high.cwiseMax(edge.from);
  const Vec3 opening(0.5 * (box.low.x() + box.high.x()), box.low.y(), 0.0);
  std::vector<Rim> edges;
  for (const Rim& edge : rim)
    if (edge.bare && edge.outward().dot(opening - edge.middle()) > 1e-3 * (box.high - box.low).norm())
      edges.push_back(edge);
  return edges;
}

/// Length of a springing joint: from an end of the intrados along edges of the rim in one direction.
double joint_length(const std::vector<Rim>& rim, const Vec3& foot, const std::vector<Rim>& intrados) {
  const double near = 1e-6;
  Vec3 at = foot, direction = Vec3::Zero();
  const auto is_intrados = [&](const Rim& edge) {
    return std::ranges::any_of(intrados, [&](const Rim& i) { return (i.middle() - edge.middle()).norm() < near; });
  };
  for (std::size_t step = 0; step < rim.size(); ++step) {
    const auto next = std::ranges::find_if(rim, [&](const Rim& edge) {
      const bool leaves = (edge.from - at).norm() < near, ends = (edge.to - at).norm() < near;
      if ((!leaves && !ends) || is_intrados(edge)) return false;
      const Vec3 along = (leaves ? edge.to - edge.from : edge.from - edge.to).normalized();
      return direction.isZero() || direction.dot(along) > 0.98;
    });
    if (next == rim.end()) break;
    const Vec3 to = (next->from - at).norm() < near ? next->to : next->from;
    direction = (to - at).normalized();
    at = to;
  }
  return direction.isZero() ? kNotKnown : (at - foot).norm();
}

/// From the crown to the nearest corner of the extrados.
double crown_length(const std::vector<Rim>& rim, const MeasuredSpan& span) {
  double least = kNotKnown;
  const Vec3 opening = 0.5 * (span.left + span.right);
  for (const Rim& edge : rim) {
    if (edge.bare && edge.outward().dot(opening - edge.middle()) > 0.0) continue;
    for (const Vec3& corner : {edge.from, edge.to}) {
      const double length = (corner - span.crown).norm();
      // A corner of the intrados does not belong to the extrados.
      if (corner.y() > span.crown.y() + 1e-6 && !(length >= least)) least = length;
    }
  }
  return least;
}

std::optional<MeasuredSpan> measure_span(const std::vector<FlatFace>& section, std::int32_t part) {
  const std::vector<Rim> rim = rim_of(section, part), intrados = intrados_of(rim);
  if (intrados.size() < 2) return std::nullopt;
  Box box;
  std::vector<Vec3> corners;
  for (const Rim& edge : intrados)
    for (const Vec3& corner : {edge.from, edge.to}) {
      corners.push_back(corner);
      box.low = box.low.cwiseMin(corner), box.high = box.high.cwiseMax(corner);
    }
  const Vec3 opening(0.5 * (box.low.x() + box.high.x()), box.low.y(), 0.0);
  // Clockwise about the middle of the opening, from the left foot.
  const auto turn = [&](const Vec3& p) { return std::atan2(p.x() - opening.x(), p.y() - opening.y()); };
  MeasuredSpan span;
  span.part = part;
  std::ranges::stable_sort(corners, {}, turn);
  span.left = corners.front(), span.right = corners.back();
  if (!(span.clear() > 1e-6)) return std::nullopt;
  const double slope = (span.right.y() - span.left.y()) / span.clear();
  const auto above = [&](const Vec3& p) { return p.y() - span.left.y() - slope * (p.x() - span.left.x()); };
  span.crown = *std::ranges::max_element(corners, {}, above);
  // Of several at one height, such as those of a keystone, the one nearest to the middle.
  for (const Vec3& p : corners)
    if (above(p) > above(span.crown) - 1e-9 &&
        std::abs(p.x() - opening.x()) < std::abs(span.crown.x() - opening.x()) - 1e-9)
      span.crown = p;
  span.rise = above(span.crown);
  span.intrados = corners;
  span.crown_thickness = crown_length(rim, span);
  span.left_thickness = joint_length(rim, span.left, intrados);
  span.right_thickness = joint_length(rim, span.right, intrados);
  std::vector<FlatFace> own;
  for (const FlatFace& face : section)
    if (face.component == Component::arch && face.part == part) own.push_back(face);
  span.extrados = top_over(own, span.crown.x());
  span.deck = top_over(section, span.crown.x());
  return span;
}

std::vector<MeasuredSupport> measure_supports(const Assembly& assembly, const Measures& m,
                                              const std::vector<FlatFace>& section) {
  std::vector<MeasuredSupport> supports;
  for (const auto& [name, blocks] : assembly.groups) {
    if (!name.starts_with("base ") || blocks.empty()) continue;
    std::vector<FlatFace> base;
    for (const FlatFace& face : section)
      if (std::ranges::find(blocks, face.block) != blocks.end()) base.push_back(face);
    if (base.empty()) continue;
    const Box box = extent_of(base);
    MeasuredSupport support;
    support.name = name.substr(5);
    support.base = box.high.y(), support.base_x0 = box.low.x(), support.base_x1 = box.high.x();
    supports.push_back(support);
  }
  if (m.spans.empty() || supports.size() != m.spans.size() + 1) return {};
  std::ranges::sort(supports, {}, [](const MeasuredSupport& s) { return s.base_x0 + s.base_x1; });
  for (std::size_t i = 0; i < supports.size(); ++i) {
    MeasuredSupport& s = supports[i];
    s.x0 = i == 0 ? m.ends.first : m.spans[i - 1].right.x();
    s.x1 = i == m.spans.size() ? m.ends.second : m.spans[i].left.x();
    s.springing =
        std::min(i == 0 ? 1e300 : m.spans[i - 1].right.y(), i == m.spans.size() ? 1e300 : m.spans[i].left.y());
  }
  return supports;
}

/// Of the line through the first springing at two places across the bridge.
double measure_skew(const Assembly& assembly, const Measures& m) {
  Box arches;  // wing walls and cutwaters may stand farther out
  for (const Block& block : assembly.blocks) {
    if (block.component != Component::arch) continue;
    const Box own = block_box(block);
    arches.low = arches.low.cwiseMin(own.low), arches.high = arches.high.cwiseMax(own.high);
  }
  const double aside = 0.3 * (arches.high.y() - arches.low.y());
  const std::int32_t part = m.spans.front().part;
  const auto before = measure_span(cut_faces(assembly, seen_from_front(), m.middle - aside), part);
  const auto after = measure_span(cut_faces(assembly, seen_from_front(), m.middle + aside), part);
  return before && after ? std::atan2(after->left.x() - before->left.x(), 2.0 * aside) : 0.0;
}

}  // namespace

std::vector<std::int64_t> fixed_at_faces(const Assembly& assembly, const Measures& m) {
  std::vector<std::int64_t> blocks;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (const Box box = block_box(assembly.blocks[i]); assembly.blocks[i].fixed)
      if (box.high.y() <= m.moving.low.y() + 1e-6 || box.low.y() >= m.moving.high.y() - 1e-6)
        blocks.push_back(std::int64_t(i));
  return blocks;
}

double Measures::lowest_base() const {
  double lowest = 1e300;
  for (const MeasuredSupport& s : supports) lowest = std::min(lowest, s.base);
  return supports.empty() ? moving.low.z() : lowest;
}

double top_over(const std::vector<FlatFace>& section, double u) {
  double top = kNotKnown;
  for (const FlatFace& face : section) {
    if (face.component == Component::parapet || face.fixed) continue;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const Vec3 &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
      if (std::min(a.x(), b.x()) > u + 1e-9 || std::max(a.x(), b.x()) < u - 1e-9) continue;
      const double share = std::abs(b.x() - a.x()) < 1e-12 ? 0.0 : std::clamp((u - a.x()) / (b.x() - a.x()), 0.0, 1.0);
      const double v = std::max(a.y() + share * (b.y() - a.y()), std::abs(b.x() - a.x()) < 1e-12 ? b.y() : -1e300);
      if (!(v <= top)) top = v;
    }
  }
  return top;
}

std::optional<Box> extent_of(const std::vector<FlatFace>& section, Component component, int part) {
  std::vector<FlatFace> own;
  for (const FlatFace& face : section)
    if (face.component == component && !face.fixed && (part < 0 || face.part == part)) own.push_back(face);
  if (own.empty()) return std::nullopt;
  return extent_of(own);
}

Measures measure(const Assembly& assembly) {
  Measures m;
  Box fixed;
  const auto widen = [](Box& box, const Box& by) {
    box.low = box.low.cwiseMin(by.low), box.high = box.high.cwiseMax(by.high);
  };
  std::set<std::int32_t> parts;
  for (const Block& block : assembly.blocks) {
    widen(block.fixed ? fixed : m.moving, block_box(block));
    if (block.component == Component::arch) parts.insert(block.part);
  }
  if (!assembly.fill.empty()) widen(m.moving, bounding_box(assembly.fill.nodes));
  if (m.moving.low.x() > m.moving.high.x()) m.moving = fixed;
  m.whole = m.moving;
  widen(m.whole, fixed);
  m.middle = 0.5 * (m.moving.low.y() + m.moving.high.y());
  const std::vector<FlatFace> section = cut_faces(assembly, seen_from_front(), m.middle);
  for (const std::int32_t part : parts)
    if (auto span = measure_span(section, part)) m.spans.push_back(*span);
  std::ranges::sort(m.spans, {}, [](const MeasuredSpan& s) { return s.crown.x(); });
  m.ends = {m.moving.low.x(), m.moving.high.x()};
  std::vector<FlatFace> moving;
  for (const FlatFace& face : section)
    if (!face.fixed) moving.push_back(face);
  if (!moving.empty()) m.ends = {extent_of(moving).low.x(), extent_of(moving).high.x()};
  m.supports = measure_supports(assembly, m, section);
  if (!m.spans.empty()) m.skew = measure_skew(assembly, m);
  return m;
}

}  // namespace voussoir
