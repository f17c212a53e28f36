#include "viz/crack_map/crack_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

constexpr double kNetwork = 1.5;     // trace / length; for steps in one direction it is at most √2
constexpr double kLevel = 20.0;      // degrees; directions within this angle count as equal
constexpr double kLeafNormal = 0.7;  // |n_y| of a joint that lies parallel to the faces of a wall
constexpr double kMixed = 0.1;       // share of the area; less counts as none
constexpr double kBedNormal = 0.7;   // |n_z| of a bed joint of a wall

bool is_over_vaults(Component c) {
  return c == Component::spandrel || c == Component::backing || c == Component::infill;
}
bool lies_on_extrados(const Crack& crack) {
  return crack.parts[0].component == Component::arch && is_over_vaults(crack.parts[1].component);
}
bool is_leaf(const Joint& joint) {
  return std::abs(joint.normal.y()) > kLeafNormal;
}
bool is_bed(const Joint& joint) {
  return std::abs(joint.normal.z()) > kBedNormal;
}

using Edges = std::vector<std::pair<Vec3, Vec3>>;

/// Axes of the largest extent of edges, the largest first, from their second moments about their middle. If the first
/// two are similar, as in a square, the longest edge and the direction square to it.
Mat3 main_axes(const Edges& edges) {
  double length = 0.0, longest = 0.0;
  Vec3 middle = Vec3::Zero(), way = Vec3::UnitX();
  for (const auto& [a, b] : edges) {
    const double own = (b - a).norm();
    length += own, middle += 0.5 * own * (a + b);
    if (own > longest + 1e-9) longest = own, way = (b - a) / own;
  }
  middle /= std::max(length, 1e-300);
  Mat3 moment = Mat3::Zero();
  for (const auto& [from, to] : edges) {
    const Vec3 a = from - middle, b = to - middle, sum = a + b;
    moment += (to - from).norm() / 6.0 * (a * a.transpose() + b * b.transpose() + sum * sum.transpose());
  }
  const auto axes = eigen_solution(Eigen::MatrixXd(moment));
  Mat3 found = axes.vectors.rowwise().reverse();
  if (axes.values[1] > 0.95 * axes.values[2]) found.col(0) = way, found.col(1) = found.col(2).cross(way);
  return found;
}

double reach(const Edges& edges, const Vec3& way) {
  double low = 1e300, high = -1e300;
  for (const auto& [a, b] : edges)
    low = std::min({low, way.dot(a), way.dot(b)}), high = std::max({high, way.dot(a), way.dot(b)});
  return high - low;
}

/// From the first corner to the last one along an axis.
Vec3 chord(const Edges& edges, const Vec3& way) {
  Vec3 first = edges.front().first, last = first;
  for (const auto& [a, b] : edges) {
    if (way.dot(a) < way.dot(first)) first = a;
    if (way.dot(a) > way.dot(last)) last = a;
  }
  return last - first;
}

std::string number(double metres) {
  return (metres <= -0.05 ? "−" : "") + fmt::format("{:.1f}", std::abs(metres));
}

/// "x 3.2 to 4.6 m"; one number where both are the same.
std::string range(const char* name, double low, double high) {
  const std::string a = number(low), b = number(high);
  return a == b ? fmt::format("{} {} m", name, a) : fmt::format("{} {} to {} m", name, a, b);
}

std::string inclined(const char* word, double degrees) {
  return fmt::format("{}, {:.0f}°", word, degrees);
}

}  // namespace

const Intrados* CrackWords::vault_of(const Crack& crack) const {
  if (crack.parts[0].component != Component::arch) return nullptr;  // it comes first
  const auto vault = std::ranges::find(vaults_, crack.parts[0].part, &Intrados::part);
  if (vault == vaults_.end()) return nullptr;
  // Springings too: the support of the vault whose joint reaches the intrados.
  const bool shows = std::ranges::any_of(crack.joints, [&](std::size_t i) {
    return std::ranges::any_of(assembly_.joints[i].polygon, [&](const Vec3& x) { return vault->holds(x); });
  });
  return crack.parts[0] == crack.parts[1] || shows ? &*vault : nullptr;
}

double CrackWords::share_of_area(const Crack& crack, bool (*counts)(const Joint&)) const {
  double area = 0.0;
  for (const std::size_t i : crack.joints)
    if (counts(assembly_.joints[i])) area += assembly_.joints[i].area;
  return area / crack.area;
}

CrackWords::Frame CrackWords::frame_of(const Crack& crack) const {
  if (vault_of(crack)) return Frame::vault;
  const bool wall = is_wall(crack.parts[0].component) || is_wall(crack.parts[1].component);
  const double leaves = share_of_area(crack, is_leaf), beds = share_of_area(crack, is_bed);
  if (wall && leaves < 0.5) return Frame::wall;
  return leaves == 0.0 && kMixed < beds && beds < 1.0 - kMixed ? Frame::wall : Frame::space;
}

/// Sine of the angle from the horizontal: of the plane of a crack or, if it is not plane, of its main axis.
double CrackWords::steepness(const Crack& crack, const Vec3& way) const {
  constexpr double plane = 0.9;  // share of the area with one normal
  Mat3 normals = Mat3::Zero();
  for (const std::size_t i : crack.joints) {
    const Joint& joint = assembly_.joints[i];
    normals += joint.area / crack.area * joint.normal * joint.normal.transpose();
  }
  const auto axes = eigen_solution(Eigen::MatrixXd(normals));
  return axes.values[2] > plane ? std::hypot(axes.vectors(0, 2), axes.vectors(1, 2)) : std::abs(way.z());
}

std::string CrackWords::where(const Crack& crack, Frame frame) const {
  std::string text = crack.parts[0] == crack.parts[1]
                         ? part_words(crack.parts[0])
                         : "between " + part_words(crack.parts[0]) + " and " + part_words(crack.parts[1]);
  const Vec3 &low = crack.box.low, &high = crack.box.high;
  if (frame == Frame::vault) {
    double from = 1e300, to = -1e300;
    for (const std::size_t i : crack.joints) {
      const double at =
          std::clamp(vault_of(crack)->share_of_span(polygon_centroid(assembly_.joints[i].polygon)), 0.0, 1.0);
      from = std::min(from, at), to = std::max(to, at);
    }
    const std::string a = fmt::format("{:.2f}", from), b = fmt::format("{:.2f}", to);
    text += a == b ? fmt::format(" at {} of its span", a) : fmt::format(" from {} to {} of its span", a, b);
    return text + ", " + range("y", low.y(), high.y());
  }
  text += ", " + range("x", low.x(), high.x());
  if (frame == Frame::space) text += ", " + range("y", low.y(), high.y());
  return text + ", " + range("z", low.z(), high.z());
}

std::string CrackWords::direction(const Crack& crack, Frame frame, const Vec3& way) const {
  if (frame == Frame::vault) {
    const double degrees = std::atan2(std::abs(way.x()), std::abs(way.y())) * 180.0 / pi;  // from the barrel's axis
    return degrees < kLevel          ? "across the barrel"
           : degrees > 90.0 - kLevel ? "along the span"
                                     : inclined("oblique", degrees);
  }
  if (frame == Frame::space && share_of_area(crack, is_leaf) > 0.5) return "parallel to the faces";
  const double sine = frame == Frame::space ? steepness(crack, way) : std::abs(way.z());
  const double degrees = std::asin(std::min(sine, 1.0)) * 180.0 / pi;
  if (degrees < kLevel) return "horizontal";
  if (degrees > 90.0 - kLevel) return "vertical";
  const double beds = share_of_area(crack, is_bed);
  return inclined(beds > kMixed && beds < 1.0 - kMixed ? "stepped" : "diagonal", degrees);
}

/// Length of all its lines on the surface, m: in a vault along the visible edges on the intrados; in a wall such that
/// its area is that of lines through the thickness.
double CrackWords::trace(const Crack& crack, Frame frame) const {
  if (frame == Frame::wall) return crack.area / (crack.box.high.y() - crack.box.low.y());
  const Intrados& vault = *vault_of(crack);
  double length = 0.0;
  for (const std::size_t i : crack.joints) {
    const Polygon& corners = assembly_.joints[i].polygon;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % corners.size()];
      if (!vault.holds(p) || !vault.holds(q)) continue;
      const Intrados::Place from = vault.unrolled(p), to = vault.unrolled(q);
      length += std::hypot(to.s - from.s, to.w - from.w);
    }
  }
  return length;
}

void CrackWords::describe(Crack& crack) const {
  const Frame frame = frame_of(crack);
  const Intrados* vault = vault_of(crack);
  const auto flat = [&](const Vec3& x) -> Vec3 {
    if (frame == Frame::space) return x;
    if (frame == Frame::wall) return {x.x(), 0.0, x.z()};
    const Intrados::Place place = vault->unrolled(x);
    return {place.s, place.w, 0.0};
  };
  Edges edges;
  for (const std::size_t i : crack.joints) {
    const Polygon& corners = assembly_.joints[i].polygon;
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.emplace_back(flat(corners[k]), flat(corners[(k + 1) % corners.size()]));
  }
  const Mat3 axes = main_axes(edges);
  const bool separates =
      std::ranges::all_of(crack.joints, [&](std::size_t i) { return between_rings_(assembly_.joints[i]); });
  // On a surface a crack is a line from one end to the other; inside the masonry it is an area.
  Vec3 way = axes.col(0);
  crack.length = reach(edges, way);
  if (frame != Frame::space && !separates) {
    const Vec3 from_end_to_end = chord(edges, way);
    crack.length = from_end_to_end.norm();
    if (crack.length > 0.0) way = from_end_to_end / crack.length;
  }
  crack.where = where(crack, frame);
  const double traced = frame == Frame::space ? crack.area / reach(edges, axes.col(1)) : trace(crack, frame);
  crack.direction = separates                          ? "ring separation"
                    : lies_on_extrados(crack)          ? "along the extrados"
                    : traced > kNetwork * crack.length ? "network"
                                                       : direction(crack, frame, way);
}

}  // namespace voussoir
