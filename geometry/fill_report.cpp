#include "geometry/fill_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/fill_mesh.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"

namespace voussoir {

namespace {

struct Areas {
  double covered = 0.0, surface = 0.0;  // m2
};

Areas fill_areas(const Assembly& assembly) {
  Areas areas;
  for (const FillJoint& joint : assembly.fill_joints) areas.covered += joint.area;
  for (std::size_t i = 0; i < assembly.fill.triangles.size(); ++i) {
    areas.surface += polygon_area(triangle_polygon(assembly.fill, std::int32_t(i)));
  }
  return areas;
}

double fill_mass(const Assembly& assembly) {
  const FillMesh& fill = assembly.fill;
  double mass = 0.0;
  for (std::size_t i = 0; i < fill.tets.size(); ++i) {
    const double density = assembly.materials[std::size_t(fill.material[i])].density;
    const auto x = [&](std::size_t k) -> const Vec3& { return fill.nodes[std::size_t(fill.tets[i][k])]; };
    mass += density * (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0))) / 6.0;
  }
  return mass;
}

/// Largest factor by which the skew lengthens an edge: the greatest singular value of at_skew().
double lengthening(double skew) {
  const double c = 1.0 / std::cos(skew), t = std::tan(skew), trace = c * c + t * t + 1.0;
  return std::sqrt(0.5 * (trace + std::sqrt(trace * trace - 4.0 * c * c)));
}

std::string bound_text(const FillAim& aim, double longest) {
  if (aim.edge <= 0.0) return "";
  std::string text = fmt::format(", asked for {:g} m", aim.edge);
  const double most = lengthening(aim.skew);
  if (aim.skew != 0.0)
    text += fmt::format(" before the turn to the skew, which lengthens edges by up to {:.0f} %", 100.0 * (most - 1.0));
  return longest > most * aim.edge + 1e-9 ? text + ", which was not reached" : text;
}

}  // namespace

std::vector<std::string> fill_lines(const Assembly& assembly, const FillAim& aim) {
  std::vector<std::string> lines;
  const FillMesh& fill = assembly.fill;
  if (fill.empty()) return lines;
  const auto add = [&](const char* name, const std::string& text) {
    lines.push_back(fmt::format("{:<20}{}", name, text));
  };
  const FillQuality q = fill_quality(fill);
  const std::vector<std::int32_t> parts = fill_parts(fill);
  const Areas areas = fill_areas(assembly);
  const std::int32_t count = *std::max_element(parts.begin(), parts.end()) + 1;
  add("deformable fill", fmt::format("{}, {}, in {}", counted(fill.nodes.size(), "node"),
                                     counted(fill.tets.size(), "tetrahedron", "tetrahedra"),
                                     count == 1 ? "one part" : fmt::format("{} parts", count)));
  add("  patches",
      fmt::format("{}, which cover {:.3f} of {:.3f} m2", assembly.fill_joints.size(), areas.covered, areas.surface));
  const std::string space = aim.volume > 0.0 ? fmt::format(", its space {:.4f} m3", aim.volume) : "";
  add("  volume", fmt::format("{:.4f} m3{}, {:.2f} t", q.volume, space, fill_mass(assembly) / 1000.0));
  add("  longest edge", fmt::format("{:.4f} m{}", q.longest_edge, bound_text(aim, q.longest_edge)));
  add("  shortest edge", fmt::format("{:.4f} m", q.shortest_edge));
  add("  edge ratio", fmt::format("{:.2f}, the worst of a tetrahedron", q.edge_ratio));
  add("  smallest angle", fmt::format("{:.2f} degrees between two faces", q.smallest_angle * 180.0 / pi));
  add("  smallest height", fmt::format("{:.4f} m, at ({:.2f}, {:.2f}, {:.2f}) m", q.smallest_height, q.lowest.x(),
                                       q.lowest.y(), q.lowest.z()));
  return lines;
}

}  // namespace voussoir
