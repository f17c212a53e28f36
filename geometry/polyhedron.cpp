#include "geometry/polyhedron.h"

#include <cmath>

namespace voussoir {
namespace {

/// Twice the vector area, about the first corner so that nothing cancels far from the origin.
Vec3 newell(const Polygon& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum;
}

Vec3 mean_of(const Polygon& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p - points[0];
  return points[0] + sum / static_cast<double>(points.size());
}

/// Integrals of 1, x and x xT over a body, relative to a reference point.
struct Moments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  /// Adds the tetrahedron (reference, a, b, c), signed.
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double d = a.dot(b.cross(c));
    const Vec3 s = a + b + c;
    volume += d / 6.0;
    first += d / 24.0 * s;
    second += d / 120.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
};

void add_face(Moments& moments, const Polyhedron& shape, const std::vector<int>& face, const Vec3& reference) {
  if (face.size() < 3) return;
  const auto corner = [&](std::size_t i) -> Vec3 { return shape.vertices[face[i % face.size()]] - reference; };
  if (face.size() == 3) {
    moments.add(corner(0), corner(1), corner(2));
    return;
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) mean += corner(i);
  mean /= static_cast<double>(face.size());
  for (std::size_t i = 0; i < face.size(); ++i) moments.add(mean, corner(i), corner(i + 1));
}

MassProperties from_moments(const Moments& moments, const Vec3& reference) {
  MassProperties out;
  out.volume = moments.volume;
  out.centroid = reference;
  if (moments.volume == 0.0) return out;
  const Vec3 offset = moments.first / moments.volume;
  out.centroid += offset;
  const Mat3 central = moments.second - moments.volume * offset * offset.transpose();
  out.inertia = central.trace() * Mat3::Identity() - central;
  return out;
}

}  // namespace

Polyhedron make_box(const Vec3& low, const Vec3& high) {
  Polyhedron out;
  for (int i = 0; i < 8; ++i)
    out.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  out.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return out;
}

Polyhedron make_prism(const Polygon& base, const Vec3& sweep) {
  const int n = static_cast<int>(base.size());
  Polyhedron out;
  out.vertices = base;
  for (const Vec3& p : base) out.vertices.push_back(p + sweep);
  std::vector<int> bottom, top;
  for (int i = 0; i < n; ++i) bottom.push_back(i), top.push_back(2 * n - 1 - i);
  out.faces = {bottom, top};
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    out.faces.push_back({j, i, i + n, j + n});
  }
  return out;
}

MassProperties mass_properties(const Polyhedron& shape) {
  if (shape.vertices.empty()) return {};
  const Vec3 reference = mean_of(shape.vertices);
  Moments moments;
  for (const auto& face : shape.faces) add_face(moments, shape, face, reference);
  return from_moments(moments, reference);
}

MassProperties mass_properties(const std::vector<Polyhedron>& cells) {
  if (cells.size() == 1) return mass_properties(cells[0]);
  std::vector<MassProperties> parts;
  for (const auto& cell : cells) parts.push_back(mass_properties(cell));
  MassProperties out;
  if (parts.empty()) return out;
  Vec3 first = Vec3::Zero();
  for (const auto& part : parts) {
    out.volume += part.volume;
    first += part.volume * (part.centroid - parts[0].centroid);
  }
  out.centroid = parts[0].centroid;
  if (out.volume != 0.0) out.centroid += first / out.volume;
  for (const auto& part : parts) {
    const Vec3 d = part.centroid - out.centroid;
    out.inertia += part.inertia + part.volume * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  return out;
}

Polygon face_polygon(const Polyhedron& shape, int face) {
  Polygon out;
  out.reserve(shape.faces[face].size());
  for (int v : shape.faces[face]) out.push_back(shape.vertices[v]);
  return out;
}

Vec3 polygon_normal(const Polygon& polygon) {
  const Vec3 sum = newell(polygon);
  const double length = sum.norm();
  return length > 0.0 ? Vec3(sum / length) : Vec3::Zero();
}

double polygon_area(const Polygon& polygon) {
  return 0.5 * newell(polygon).norm();
}

Vec3 polygon_centroid(const Polygon& polygon) {
  if (polygon.empty()) return Vec3::Zero();
  const Vec3 normal = polygon_normal(polygon);
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 u = polygon[i] - polygon[0], v = polygon[i + 1] - polygon[0];
    const double weight = u.cross(v).dot(normal);
    sum += weight * (u + v) / 3.0;
    total += weight;
  }
  return total > 0.0 ? Vec3(polygon[0] + sum / total) : mean_of(polygon);
}

Plane face_plane(const Polyhedron& shape, int face) {
  const Polygon polygon = face_polygon(shape, face);
  Plane plane{polygon_normal(polygon), 0.0};
  plane.offset = plane.normal.dot(mean_of(polygon));
  return plane;
}

Box bounding_box(const Polygon& points) {
  Box box;
  for (const Vec3& p : points) {
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

Box bounding_box(const Polyhedron& shape) {
  return bounding_box(shape.vertices);
}

double surface_area(const Polyhedron& shape) {
  double sum = 0.0;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) sum += polygon_area(face_polygon(shape, static_cast<int>(f)));
  return sum;
}

}  // namespace voussoir
