// Vaults of skew bridges whose beds run square to the faces: helicoidal and logarithmic bond.
//
// On the intrados laid flat, s goes along the square section and v along the axis of the barrel. A face is the curve
// v = u(s) tan α + const, with u the horizontal coordinate of the square section and α the skew. Helicoidal beds
// (Buck 1839) are straight there, square to the chord of the face; logarithmic ones cross every section that is
// parallel to the faces at right angles (Forgács, Sarhosis & Bagi 2017). Beds of either kind are translates of one
// another along the axis. Their stones end on planes parallel to the faces.
//
// Everything is laid with y across the bridge and x = u; turn_to_skew() then moves x to u / cos α + y tan α, so that a
// point (u, v) of the barrel has y = v cos α - u sin α.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/masonry_parts.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// The bed through the middle of the crown: y (m) where it meets each joint, on the intrados of the lowest ring and on
/// the extrados of each. In between it is two triangles a wedge and ring. The others lie `pitch` m apart along y.
struct Beds {
  std::vector<std::vector<double>> y;
  double pitch = 0.0;
};

/// The intrados laid flat.
struct Flat {
  double length = 0.0, chord = 0.0;  // m
  explicit Flat(const Polygon& intrados) : chord(intrados.back().x() - intrados.front().x()) {
    for (std::size_t i = 0; i + 1 < intrados.size(); ++i) length += (intrados[i + 1] - intrados[i]).norm();
  }
};

/// v along a bed from joint to joint, 0 in the middle of the intrados.
std::vector<double> along_axis(const Polygon& intrados, double skew, SkewBond bond) {
  const Flat flat(intrados);
  std::vector<double> v = {0.0};
  double middle = 0.0, way = 0.0;
  for (std::size_t i = 0; i + 1 < intrados.size(); ++i) {
    const double ds = (intrados[i + 1] - intrados[i]).norm(), du = intrados[i + 1].x() - intrados[i].x();
    const double slope = bond == SkewBond::helicoidal ? flat.length / flat.chord : ds / du;
    const double dv = -ds * slope / std::tan(skew);
    middle += std::clamp((0.5 * flat.length - way) / ds, 0.0, 1.0) * dv;
    way += ds;
    v.push_back(v.back() + dv);
  }
  for (double& at : v) at -= middle;
  return v;
}

/// Spacing of the beds along the axis that gives courses of `width` m at the crown.
double spacing_at_crown(const Polygon& intrados, double skew, SkewBond bond, double width) {
  const Flat flat(intrados);
  const double share =
      bond == SkewBond::helicoidal ? flat.chord / flat.length : 1.0;  // of the mean or the greatest tan
  return width / std::sin(std::atan(share * std::tan(std::abs(skew))));
}

Beds lay_out_beds(const Bridge& bridge, const Vault& vault) {
  const Polygon& intrados = vault.rings.front().intrados;
  const double c = std::cos(bridge.skew), s = std::sin(bridge.skew);
  const std::vector<double> v = along_axis(intrados, bridge.skew, bridge.skew_bond);
  const double middle = 0.5 * (intrados.front().x() + intrados.back().x());
  const auto on = [&](const Polygon& line) {
    std::vector<double> y;
    for (std::size_t i = 0; i < line.size(); ++i) y.push_back(c * v[i] - s * (line[i].x() - middle));
    return y;
  };
  Beds beds;
  beds.y.push_back(on(intrados));
  for (const Ring& ring : vault.rings) beds.y.push_back(on(ring.extrados));
  const double range = std::abs(beds.y[0].back() - beds.y[0].front());
  const double aimed = c * spacing_at_crown(intrados, bridge.skew, bridge.skew_bond, vault.voussoir.x());
  beds.pitch = range / (2.0 * std::max(2.0, std::ceil(0.5 * range / aimed - 1e-9)));
  return beds;
}

/// The two prisms between bed `course` and the next in one wedge of a ring. Both halves of a vault have their diagonals
/// the same way round, seen from the crown.
std::vector<Polyhedron> between_beds(const Vault& vault, const Beds& beds, std::size_t ring, int wedge,
                                     std::int64_t course) {
  Polygon corners = vault.rings[ring].wedge(wedge);
  const auto i = std::size_t(wedge);
  const double offset = double(course) * beds.pitch;
  const double y[4] = {beds.y[ring][i], beds.y[ring][i + 1], beds.y[ring + 1][i + 1], beds.y[ring + 1][i]};
  for (std::size_t k = 0; k < 4; ++k) corners[k].y() = y[k] + offset;
  const Vec3 sweep(0.0, beds.pitch, 0.0);
  const bool left = 2 * wedge < vault.rings[ring].wedges();
  const Polygon first =
      left ? Polygon{corners[0], corners[1], corners[2]} : Polygon{corners[0], corners[1], corners[3]};
  const Polygon second =
      left ? Polygon{corners[0], corners[2], corners[3]} : Polygon{corners[1], corners[2], corners[3]};
  return {make_prism(first, sweep), make_prism(second, sweep)};
}

/// Share of the volume of a stone below which a part of a prism is ignored.
constexpr double no_share = 1e-7;

/// Adds what of a prism lies between y0 and y1.
void add_between(std::vector<Polyhedron>& cells, const Polyhedron& prism, double y0, double y1, double stone) {
  const Box box = bounding_box(prism);
  if (box.high.y() <= y0 + no_masonry || box.low.y() >= y1 - no_masonry) return;
  Polyhedron piece = cut(prism, {-Vec3::UnitY(), -y0});
  if (!piece.faces.empty()) piece = cut(piece, {Vec3::UnitY(), y1});
  if (piece.faces.empty()) return;
  const double volume = mass_properties(piece).volume;
  if (volume < no_masonry * surface_area(piece) || volume < no_share * stone) return;
  cells.push_back(std::move(piece));
}

/// The prisms of one course in some rings, wedge by wedge.
struct CourseWedge {
  int wedge = 0;
  std::vector<Polyhedron> prisms;
};

void lay_course(Layout& layout, const Bridge& bridge, std::size_t i, const Beds& beds, std::int64_t course,
                std::size_t ring, std::size_t rings) {
  const Vault& vault = bridge.vaults[i];
  const int wedges = vault.rings.front().wedges();
  const Unit unit = {Component::arch, int(i), vault.material, vault.voussoir};
  const Vec3 nominal = vault.stone(ring, rings);
  const double half_width = bridge.half_width();
  const bool half = ((course + std::int64_t(ring)) % 2 + 2) % 2 == 1;
  const std::vector<double> y = split(-half_width, half_width, unit.size.y(), half);
  auto& keystone = layout.groups[fmt::format("keystone {}", i)];
  std::vector<CourseWedge> row;
  for (int wedge = 0; wedge < wedges; ++wedge) {
    CourseWedge part = {wedge, {}};
    for (std::size_t r = ring; r < ring + rings; ++r)
      for (Polyhedron& prism : between_beds(vault, beds, r, wedge, course)) part.prisms.push_back(std::move(prism));
    row.push_back(std::move(part));
  }
  for (std::size_t k = 0; k + 1 < y.size(); ++k) {
    std::vector<Polyhedron> cells;
    bool crown = false;
    int quarter = -1;
    for (const CourseWedge& part : row) {
      const std::size_t before = cells.size();
      for (const Polyhedron& prism : part.prisms) add_between(cells, prism, y[k], y[k + 1], nominal.prod());
      if (cells.size() == before) continue;
      crown |= at_crown(part.wedge, wedges);
      quarter = std::max(quarter, quarter_of(vault.rings.front().intrados, part.wedge));
    }
    if (cells.empty()) continue;
    if (crown) keystone.push_back(std::int64_t(layout.stones.size()));
    lay_stone(layout, std::move(cells), unit, nominal, true);
    name_quarter(layout, i, quarter, layout.stones.size() - 1);
    layout.stones.back().layers = ((1u << rings) - 1u) << ring;
  }
}

}  // namespace

void lay_oblique(Layout& layout, const Bridge& bridge, std::size_t i) {
  const Vault& vault = bridge.vaults[i];
  const Polygon& intrados = vault.rings.front().intrados;
  for (std::size_t k = 0; k + 1 < intrados.size(); ++k)
    if (intrados[k + 1].x() - intrados[k].x() < 1e-3 * (intrados[k + 1] - intrados[k]).norm())
      throw InputError(
          "[[bridge.span]] number {}: its intrados is vertical or overhangs near a springing, so bed joints square to "
          "the faces would not end there. Choose skew_bond = \"parallel\".",
          i + 1);
  const Beds beds = lay_out_beds(bridge, vault);
  double low = 1e300, high = -1e300;
  for (const auto& line : beds.y)
    for (const double y : line) low = std::min(low, y), high = std::max(high, y);
  const auto first = std::int64_t(std::floor((-bridge.half_width() - high) / beds.pitch)) - 1;
  const auto last = std::int64_t(std::ceil((bridge.half_width() - low) / beds.pitch));
  for (std::size_t ring = 0; ring < vault.rings.size(); ++ring) {
    for (std::int64_t course = first; course <= last; ++course) {
      const std::size_t rings = rings_of_stone(vault, ring, course);
      const std::size_t from = layout.stones.size();
      if (rings > 0) lay_course(layout, bridge, i, beds, course, ring, rings);
      if (vault.rings.size() > 1) name_rings(layout, i, ring, rings, from);
    }
  }
}

void turn_to_skew(Layout& layout, double skew) {
  if (skew == 0.0) return;
  for (Stone& stone : layout.stones) {
    for (Polyhedron& cell : stone.cells)
      for (Vec3& p : cell.vertices) p = at_skew(p, skew);
    stone.nominal.x() /= std::cos(skew);
  }
}

Vec3 at_skew(const Vec3& p, double skew) {
  return {p.x() / std::cos(skew) + p.y() * std::tan(skew), p.y(), p.z()};
}

}  // namespace voussoir
