#include "viz/view.h"

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr double kViewAngle = 18.0;  // degrees, vertical: a long lens, so that uprights stay nearly parallel

struct Extent {
  double low_r = 1e300, high_r = -1e300, low_u = 1e300, high_u = -1e300;
  void add(double r, double u) {
    low_r = std::min(low_r, r), high_r = std::max(high_r, r);
    low_u = std::min(low_u, u), high_u = std::max(high_u, u);
  }
  double width() const { return high_r - low_r; }
  double height() const { return high_u - low_u; }
  double middle_r() const { return 0.5 * (low_r + high_r); }
  double middle_u() const { return 0.5 * (low_u + high_u); }
};

Vec3 point(vtkPoints* points, vtkIdType i) {
  Vec3 p;
  points->GetPoint(i, p.data());
  return p;
}

Extent flat_extent(const View& view, vtkPoints* points) {
  Extent extent;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    const Vec3 p = point(points, i);
    extent.add(p.dot(view.right), p.dot(view.up));
  }
  return extent;
}

/// Half the height, in m (or in tangents), that the sheet must show for `extent` to fit the frame.
double half_height(const Extent& extent, const Frame& frame, double aspect) {
  return 0.5 *
         std::max(extent.height() / (frame.top - frame.bottom), extent.width() / (aspect * (frame.right - frame.left)));
}

void place(vtkCamera* camera, const View& view, const Vec3& focus, double distance) {
  const Vec3 position = focus - distance * view.forward;
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(view.up.data());
}

/// Depth range of the points along the view, for placing an orthographic camera outside them.
std::pair<double, double> depths(const View& view, vtkPoints* points) {
  double low = 1e300, high = -1e300;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    const double d = point(points, i).dot(view.forward);
    low = std::min(low, d), high = std::max(high, d);
  }
  return {low, high};
}

void fit_orthographic(vtkCamera* camera, const View& view, vtkPoints* points, const Frame& frame, double aspect) {
  const Extent extent = flat_extent(view, points);
  const double half = half_height(extent, frame, aspect);
  const auto [near, far] = depths(view, points);
  const double r = extent.middle_r() - ((frame.left + frame.right) - 1.0) * half * aspect;
  const double u = extent.middle_u() - ((frame.bottom + frame.top) - 1.0) * half;
  const Vec3 focus = r * view.right + u * view.up + 0.5 * (near + far) * view.forward;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(half);
  place(camera, view, focus, 2.0 * (far - near) + 4.0 * half);
}

/// Moves the camera until the projected extent fills the frame; a few rounds suffice, the lens being long.
void fit_perspective(vtkCamera* camera, const View& view, vtkPoints* points, const Frame& frame, double aspect) {
  const double tangent = std::tan(0.5 * kViewAngle * pi / 180.0);
  const auto [near, far] = depths(view, points);
  const Extent flat = flat_extent(view, points);
  const double size = std::max({flat.width(), flat.height(), far - near, 1e-6});
  Vec3 focus = flat.middle_r() * view.right + flat.middle_u() * view.up + 0.5 * (near + far) * view.forward;
  double distance = half_height(flat, frame, aspect) / tangent + 0.5 * (far - near);
  for (int round = 0; round < 30; ++round) {
    const Vec3 eye = focus - distance * view.forward;
    Extent seen;  // tangents of the angles to the axis
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
      const Vec3 d = point(points, i) - eye;
      const double depth = std::max(d.dot(view.forward), 1e-3 * size);
      seen.add(d.dot(view.right) / depth, d.dot(view.up) / depth);
    }
    const double r = seen.middle_r() - ((frame.left + frame.right) - 1.0) * tangent * aspect;
    const double u = seen.middle_u() - ((frame.bottom + frame.top) - 1.0) * tangent;
    focus += distance * (r * view.right + u * view.up);
    distance *= half_height(seen, frame, aspect) / tangent;
  }
  camera->ParallelProjectionOff();
  camera->SetViewAngle(kViewAngle);
  place(camera, view, focus, distance);
}

}  // namespace

View find_view(const std::string& name) {
  const auto make = [&](const Vec3& forward, const Vec3& up, bool perspective) {
    const Vec3 f = forward.normalized(), right = f.cross(up).normalized();
    return View{name, f, right.cross(f), right, perspective};
  };
  if (name == "front") return make(Vec3::UnitY(), Vec3::UnitZ(), false);
  if (name == "side") return make(-Vec3::UnitX(), Vec3::UnitZ(), false);
  if (name == "plan") return make(-Vec3::UnitZ(), Vec3::UnitY(), false);
  if (name == "oblique") return make({0.55, 1.0, -0.42}, Vec3::UnitZ(), true);
  throw InputError("pictures: there is no view '{}'. Give front, side, plan or oblique", name);
}

double content_aspect(const View& view, vtkPoints* points) {
  const Extent extent = flat_extent(view, points);
  return extent.width() / std::max(extent.height(), 1e-9);
}

void fit_camera(vtkCamera* camera, const View& view, vtkPoints* points, const Frame& frame, double aspect) {
  if (view.perspective)
    fit_perspective(camera, view, points, frame, aspect);
  else
    fit_orthographic(camera, view, points, frame, aspect);
}

}  // namespace voussoir
