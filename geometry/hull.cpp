#include "geometry/hull.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace voussoir {
namespace {

struct HullFace {
  std::array<int, 3> corners;
  Plane plane;
};

class Hull {
 public:
  Hull(const std::vector<Vec3>& points, double relative) : points_(points) {
    const Box box = bounding_box(points);
    tolerance_ = points.empty() ? 0.0 : relative * (box.high - box.low).norm();
  }

  Polyhedron result() {
    if (!begin()) return {};
    for (int p = 0; p < int(points_.size()); ++p) add(p);
    Polyhedron out;
    std::map<int, int> number;
    for (const HullFace& face : faces_) {
      auto& loop = out.faces.emplace_back();
      for (const int v : face.corners) {
        const auto [entry, fresh] = number.try_emplace(v, int(out.vertices.size()));
        if (fresh) out.vertices.push_back(points_[std::size_t(v)]);
        loop.push_back(entry->second);
      }
    }
    return out;
  }

 private:
  const Vec3& at(int p) const { return points_[std::size_t(p)]; }

  template <class Height>
  int farthest(Height height) const {
    int best = 0;
    for (int p = 1; p < int(points_.size()); ++p)
      if (height(at(p)) > height(at(best))) best = p;
    return best;
  }

  /// A tetrahedron that is as large as can be had easily.
  bool begin() {
    if (points_.size() < 4) return false;
    const int a = farthest([](const Vec3& p) { return -p.x(); });
    const int b = farthest([&](const Vec3& p) { return (p - at(a)).norm(); });
    const Vec3 along = at(b) - at(a);
    if (along.norm() <= tolerance_) return false;
    const int c = farthest([&](const Vec3& p) { return along.cross(p - at(a)).norm(); });
    const Vec3 normal = along.cross(at(c) - at(a));
    if (normal.norm() <= tolerance_ * along.norm()) return false;
    const int d = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - at(a))); });
    if (std::abs(normal.dot(at(d) - at(a))) <= tolerance_ * normal.norm()) return false;
    inside_ = 0.25 * (at(a) + at(b) + at(c) + at(d));
    for (const auto& corners : {std::array{a, b, c}, {a, b, d}, {b, c, d}, {c, a, d}}) add_face(corners);
    return true;
  }

  void add_face(std::array<int, 3> corners) {
    HullFace face{corners, {}};
    Vec3 normal = (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0])).normalized();
    if (normal.dot(inside_ - at(corners[0])) > 0.0) {
      std::swap(face.corners[1], face.corners[2]);
      normal = -normal;
    }
    face.plane = {normal, normal.dot(at(corners[0]))};
    faces_.push_back(face);
  }

  /// Takes out the faces that see the point, and spans new ones from it to the rim of the hole.
  void add(int p) {
    std::set<std::pair<int, int>> rim;  // directed edges of seen faces without those that run both ways
    std::vector<HullFace> kept;
    for (const HullFace& face : faces_) {
      if (face.plane.normal.dot(at(p)) - face.plane.offset <= tolerance_) {
        kept.push_back(face);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = face.corners[k], to = face.corners[(k + 1) % 3];
        if (rim.erase({to, from}) == 0) rim.insert({from, to});
      }
    }
    if (rim.empty()) return;
    faces_ = std::move(kept);
    for (const auto& [from, to] : rim) add_face({from, to, p});
  }

  const std::vector<Vec3>& points_;
  double tolerance_;  // m
  Vec3 inside_ = Vec3::Zero();
  std::vector<HullFace> faces_;
};

}  // namespace

Polyhedron convex_hull(const std::vector<Vec3>& points, double relative) {
  return Hull(points, relative).result();
}

}  // namespace voussoir
