#include "viz/crack_map/crack_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace voussoir {

namespace {

/// The crack of each joint that is cracked.
std::map<std::size_t, std::size_t> crack_of_joint(const std::vector<Crack>& cracks) {
  std::map<std::size_t, std::size_t> of;
  for (std::size_t c = 0; c < cracks.size(); ++c)
    for (const std::size_t joint : cracks[c].joints) of[joint] = c;
  return of;
}

bool near_face(const FlatFace& face, const Vec3& at, double near) {
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec3 &a = face.corners[i], side = face.corners[(i + 1) % face.corners.size()] - a, to = at - a;
    if (side.x() * to.y() - side.y() * to.x() < -near * side.norm()) return false;
  }
  return true;
}

/// Edges of joints on the faces of a view.
class EdgesOnFaces {
 public:
  explicit EdgesOnFaces(const FlatView& view) : view_(view), front_(view), near_(1e-4 * front_.size()) {
    for (std::size_t f = 0; f < view.faces.size(); ++f) faces_[view.faces[f].block].push_back(f);
  }
  const InFront& front() const { return front_; }

  std::vector<FlatLine> seen(const Joint& joint) const {
    std::vector<FlatLine> lines;
    for (std::size_t i = 0; i < joint.polygon.size(); ++i) {
      const Vec3 &p = joint.polygon[i], &q = joint.polygon[(i + 1) % joint.polygon.size()];
      for (const std::int64_t block : {joint.a, joint.b})
        if (const std::vector<FlatLine> parts = seen_on(block, p, q); !parts.empty()) {
          lines.insert(lines.end(), parts.begin(), parts.end());
          break;
        }
    }
    return lines;
  }

 private:
  std::vector<FlatLine> seen_on(std::int64_t block, const Vec3& p, const Vec3& q) const {
    const auto own = faces_.find(block);
    if (own == faces_.end()) return {};
    const auto flat = [&](const Vec3& x) { return Vec3(view_.axes.u(x), view_.axes.v(x), 0.0); };
    const Vec3 a = flat(p), b = flat(q);
    if ((b - a).norm() < 2.0 * near_) return {};
    for (const std::size_t f : own->second) {
      const FlatFace& face = view_.faces[f];
      const auto on = [&](const Vec3& at, const Vec3& x) {
        return std::abs(front_.depth(f, at) - view_.axes.forward.dot(x)) < near_ && near_face(face, at, near_);
      };
      if (!on(a, p) || !on(b, q)) continue;
      // Slightly inside the face, so that its neighbours have no influence.
      const Vec3 along = (b - a).normalized(), across(-along.y(), along.x(), 0.0);
      const Vec3 middle = polygon_centroid(face.corners);
      const Vec3 in = across.dot(middle - a) > 0.0 ? Vec3(near_ * across) : Vec3(-near_ * across);
      const double resolution = 2e-3 * front_.size();
      if (auto parts = visible_parts(front_, f, {a + in, b + in}, resolution); !parts.empty()) return parts;
    }
    return {};
  }

  const FlatView& view_;
  InFront front_;
  double near_;
  std::map<std::int64_t, std::vector<std::size_t>> faces_;
};

}  // namespace

const std::vector<WidthClass>& width_classes() {
  static const std::vector<WidthClass> classes = {{3e-4, "#e69f00", 0.3},
                                                  {1e-3, "#d55e00", 0.5},
                                                  {3e-3, "#b0272f", 0.75},
                                                  {1e-2, "#6a0f3c", 1.05},
                                                  {3e-2, "#000000", 1.4}};
  return classes;
}

std::size_t width_class(double width) {
  std::size_t k = 0;
  while (k + 1 < width_classes().size() && width >= width_classes()[k + 1].from) ++k;
  return k;
}

Box CrackView::extent() const {
  Box box;
  for (const auto& lines : pattern)
    for (const auto& [a, b] : lines)
      box.low = box.low.cwiseMin(a.cwiseMin(b)), box.high = box.high.cwiseMax(a.cwiseMax(b));
  if (box.low.x() > box.high.x()) box = {Vec3::Zero(), Vec3::Zero()};
  return box;
}

std::vector<bool> fallen_blocks(const Assembly& assembly, const Snapshot& snapshot) {
  std::vector<bool> fell(assembly.blocks.size(), false);
  for (std::size_t i = 0; i < fell.size() && i < snapshot.displacement.size(); ++i)
    fell[i] = !assembly.blocks[i].fixed && (snapshot.displacement[i] - snapshot.base_displacement).norm() >= kStoneFell;
  return fell;
}

CrackView seen_view(const CrackedAssembly& cracked, const SheetAxes& axes, const std::vector<std::int64_t>& without,
                    const std::string& title) {
  const FlatView view = flat_view(cracked.assembly, axes, std::nullopt, without);
  CrackView drawn;
  drawn.title = title, drawn.u_name = "x", drawn.mirrored = axes.right.x() < 0.0;
  if (view.faces.empty()) return drawn;
  const EdgesOnFaces edges(view);
  drawn.pattern = visible_lines(view, edges.front(), 2e-3 * edges.front().size());
  const Box box = drawn.extent();
  drawn.u_from = drawn.mirrored ? -box.high.x() : box.low.x(),
  drawn.u_to = drawn.mirrored ? -box.low.x() : box.high.x();
  for (const auto& [joint, crack] : crack_of_joint(cracked.cracks))
    for (const FlatLine& line : edges.seen(cracked.assembly.joints[joint]))
      drawn.traces.push_back({joint, crack, line});
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    const FlatFace& face = view.faces[f];
    if (face.block >= 0 && cracked.fell[std::size_t(face.block)] &&
        edges.front().at(polygon_centroid(face.corners)) == std::ptrdiff_t(f))
      drawn.fallen.push_back(face.corners);
  }
  return drawn;
}

CrackView unrolled_view(const CrackedAssembly& cracked, const Intrados& vault) {
  CrackView drawn;
  drawn.title = fmt::format("Intrados of arch {}, unrolled", vault.part);
  drawn.u_name = "s", drawn.u_to = vault.length();
  const auto flat = [&](const Vec3& x) {
    const Intrados::Place place = vault.unrolled(x);
    return Vec3(place.s, place.w, 0.0);
  };
  const auto of_vault = [&](std::int64_t block) {
    const Block& b = cracked.assembly.blocks[std::size_t(block)];
    return b.component == Component::arch && b.part == vault.part;
  };
  for (std::size_t i = 0; i < cracked.assembly.blocks.size(); ++i) {
    if (!of_vault(std::int64_t(i))) continue;
    for (const Polyhedron& cell : cracked.assembly.blocks[i].cells)
      for (std::size_t f = 0; f < cell.faces.size(); ++f) {
        const Polygon face = face_polygon(cell, int(f));
        if (!std::ranges::all_of(face, [&](const Vec3& x) { return vault.holds(x); })) continue;
        Polygon corners;
        for (const Vec3& x : face) corners.push_back(flat(x));
        for (std::size_t k = 0; k < corners.size(); ++k)
          drawn.pattern[std::size_t(LineKind::joint)].emplace_back(corners[k], corners[(k + 1) % corners.size()]);
        if (cracked.fell[i]) drawn.fallen.push_back(corners);
      }
  }
  for (const auto& [number, crack] : crack_of_joint(cracked.cracks)) {
    const Joint& joint = cracked.assembly.joints[number];
    if (!of_vault(joint.a) && !of_vault(joint.b)) continue;
    for (std::size_t k = 0; k < joint.polygon.size(); ++k) {
      const Vec3 &p = joint.polygon[k], &q = joint.polygon[(k + 1) % joint.polygon.size()];
      if (vault.holds(p) && vault.holds(q) && (flat(q) - flat(p)).norm() > 1e-3)
        drawn.traces.push_back({number, crack, {flat(p), flat(q)}});
    }
  }
  return drawn;
}

}  // namespace voussoir
