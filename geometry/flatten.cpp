#include "geometry/flatten.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "geometry/repair.h"

namespace voussoir {
namespace {

using Loop = std::vector<int>;

/// The plane that fits points best, and how well.
struct Fit {
  Plane plane;
  double width = 0.0;  // m: how far the points reach about their middle in the narrower direction (root mean square)
  double off = 0.0;    // m: the farthest from the plane
};

Fit fit(const Polyhedron& shape, const std::set<int>& points, const Vec3& outward) {
  Vec3 middle = Vec3::Zero();
  for (const int v : points) middle += shape.vertices[v];
  middle /= double(points.size());
  Mat3 spread = Mat3::Zero();
  for (const int v : points) spread += (shape.vertices[v] - middle) * (shape.vertices[v] - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread / double(points.size()));
  Fit out;
  out.plane.normal = solver.eigenvectors().col(0);
  if (out.plane.normal.dot(outward) < 0.0) out.plane.normal = -out.plane.normal;
  out.plane.offset = out.plane.normal.dot(middle);
  out.width = std::sqrt(std::max(solver.eigenvalues()[1], 0.0));
  for (const int v : points)
    out.off = std::max(out.off, std::abs(out.plane.normal.dot(shape.vertices[v]) - out.plane.offset));
  return out;
}

class Flattening {
 public:
  Flattening(const Polyhedron& shape, double allowed) : shape_(shape), allowed_(allowed) {
    const Box box = bounding_box(shape);
    size_ = (box.high - box.low).norm();
    for (int f = 0; f < int(shape.faces.size()); ++f) {
      const Polygon polygon = face_polygon(shape, f);
      areas_.push_back(polygon_area(polygon));
      normals_.push_back(polygon_normal(polygon));
      for (std::size_t i = 0; i < polygon.size(); ++i)
        owner_[{shape.faces[f][i], shape.faces[f][(i + 1) % polygon.size()]}] = f;
    }
  }

  std::optional<Flattened> result() {
    make_groups();
    if (!fit_planes()) return {};
    const Box box = bounding_box(shape_);
    Flattened out;
    out.shape = make_box(box.low - Vec3::Constant(size_), box.high + Vec3::Constant(size_));
    for (const Fit& plane : planes_) {
      out.shape = cut(out.shape, plane.plane, 1e-9 * size_);
      if (out.shape.faces.empty()) return {};
      out.tilt = std::max(out.tilt, plane.off / plane.width);
    }
    out.moved = farthest_move(out.shape);
    if (!(out.moved <= 3.0 * allowed_) || !convexity_error(out.shape).empty()) return {};
    return out;
  }

 private:
  /// Grown from the largest free face over edges, while all corners stay near one plane. A fold that a warp of this
  /// size cannot make is an edge; a face narrower than the warp has a normal that says nothing.
  void make_groups() {
    const double fold = std::clamp(30.0 * allowed_ / size_, 1e-3, 0.3);  // rad
    Loop order(shape_.faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return areas_[p] > areas_[q]; });
    group_.assign(shape_.faces.size(), -1);
    for (const int seed : order) {
      if (group_[seed] >= 0) continue;
      group_[seed] = int(points_.size());
      std::set<int> points(shape_.faces[seed].begin(), shape_.faces[seed].end());
      for (Loop todo = {seed}; !todo.empty();) {
        const Loop face = shape_.faces[todo.back()];
        todo.pop_back();
        for (std::size_t i = 0; i < face.size(); ++i) {
          const auto twin = owner_.find({face[(i + 1) % face.size()], face[i]});
          if (twin == owner_.end() || group_[twin->second] >= 0) continue;
          const int next = twin->second;
          if (!is_narrow(next) && std::acos(std::clamp(normals_[seed].dot(normals_[next]), -1.0, 1.0)) > fold) continue;
          std::set<int> wider = points;
          wider.insert(shape_.faces[next].begin(), shape_.faces[next].end());
          if (fit(shape_, wider, normals_[seed]).off > allowed_) continue;
          points = std::move(wider);
          group_[next] = group_[seed];
          todo.push_back(next);
        }
      }
      points_.push_back(std::move(points));
      outward_.push_back(normals_[seed]);
    }
  }

  bool is_narrow(int face) const {
    double longest = 0.0;
    const Polygon polygon = face_polygon(shape_, face);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      longest = std::max(longest, (polygon[(i + 1) % polygon.size()] - polygon[i]).norm());
    return areas_[face] <= longest * allowed_;
  }

  /// A plane for each group that is wider than what may be moved. False when its corners are too far from it.
  bool fit_planes() {
    std::vector<std::set<int>> groups_at(shape_.vertices.size());
    for (std::size_t f = 0; f < shape_.faces.size(); ++f)
      for (const int v : shape_.faces[f]) groups_at[v].insert(group_[f]);
    corner_.assign(shape_.vertices.size(), false);
    for (std::size_t v = 0; v < groups_at.size(); ++v) corner_[v] = groups_at[v].size() >= 3;
    for (std::size_t g = 0; g < points_.size(); ++g) {
      if (fit(shape_, points_[g], outward_[g]).off > allowed_) return false;
      std::set<int> corners = points_[g];
      std::erase_if(corners, [&](int v) { return !corner_[v]; });
      const Fit found = fit(shape_, corners.size() >= 3 ? corners : points_[g], outward_[g]);
      if (found.width > allowed_) planes_.push_back(found);
    }
    return planes_.size() >= 4;
  }

  /// Both ways: corners that went, and corners that came.
  double farthest_move(const Polyhedron& made) const {
    const auto nearest = [](const Vec3& p, const std::vector<Vec3>& points) {
      double least = 1e300;
      for (const Vec3& q : points) least = std::min(least, (p - q).norm());
      return least;
    };
    double farthest = 0.0;
    for (const Vec3& p : made.vertices) farthest = std::max(farthest, nearest(p, shape_.vertices));
    for (std::size_t v = 0; v < shape_.vertices.size(); ++v) {
      if (corner_[v]) {
        farthest = std::max(farthest, nearest(shape_.vertices[v], made.vertices));
        continue;
      }
      double out = -1e300;
      for (const Fit& f : planes_) out = std::max(out, f.plane.normal.dot(shape_.vertices[v]) - f.plane.offset);
      farthest = std::max(farthest, std::abs(out));
    }
    return farthest;
  }

  const Polyhedron& shape_;
  double allowed_, size_ = 0.0;  // m
  std::vector<double> areas_;
  std::vector<Vec3> normals_;
  std::map<std::pair<int, int>, int> owner_;  // face of each directed edge
  Loop group_;                                // of each face
  std::vector<std::set<int>> points_;         // of each group
  std::vector<Vec3> outward_;                 // of each group
  std::vector<bool> corner_;                  // of each vertex: at least three groups meet there
  std::vector<Fit> planes_;
};

}  // namespace

std::optional<Flattened> flatten(const Polyhedron& shape, double allowed) {
  return Flattening(shape, allowed).result();
}

}  // namespace voussoir
