// arch: one ring of equal flat-faced voussoirs, circular or pointed, between fixed springings or on buttresses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/generate.h"
#include "geometry/masonry.h"
#include "geometry/stiffness.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Half a ring, the left one, with its centre `eccentricity` × mean radius to the right of the middle line (x = 0).
/// Joint planes pass through that centre, except the crown's, which is the middle plane.
struct HalfRing {
  double centre = 0.0;              // m, x
  double inner = 0.0, outer = 0.0;  // m, radii
  double foot = 0.0, crown = 0.0;   // rad from the vertical, leftwards: springing and end of the mean line

  Vec3 point(double radius, double share) const {  // share 0: foot, 1: crown
    if (share == 1.0) return {0.0, 0.0, std::sqrt(radius * radius - centre * centre)};
    const double angle = foot + share * (crown - foot);
    return {centre - radius * std::sin(angle), 0.0, radius * std::cos(angle)};
  }
};

Vec3 mirrored(const Vec3& p) {
  return {-p.x(), p.y(), p.z()};
}

Ring make_ring(const HalfRing& half, int n) {
  Ring ring;
  for (int i = 0; i <= n; ++i) {
    const double share = 2.0 * std::min(i, n - i) / n;
    const Vec3 in = half.point(half.inner, share), out = half.point(half.outer, share);
    ring.intrados.push_back(2 * i <= n ? in : mirrored(in));
    ring.extrados.push_back(2 * i <= n ? out : mirrored(out));
  }
  return ring;
}

/// Puts the left end at x = 0 and the lowest point of the springing joints at z = 0; returns the shift.
void place(Ring& ring, const std::vector<Vec3*>& more) {
  const Vec3 &in = ring.intrados.front(), &out = ring.extrados.front();
  const Vec3 shift(-std::min(in.x(), out.x()), 0.0, -std::min(in.z(), out.z()));
  for (Polygon* points : {&ring.intrados, &ring.extrados}) {
    for (Vec3& p : *points) p += shift;
  }
  for (Vec3* p : more) *p += shift;
}

/// The fixed block beyond a springing joint: one more wedge, as wide as the arch.
void lay_springing(Layout& layout, const Vec3& in, const Vec3& out, const Vec3& beyond_in, const Vec3& beyond_out,
                   bool left, double width, int part) {
  Polygon wedge = left ? Polygon{beyond_in, in, out, beyond_out} : Polygon{in, beyond_in, beyond_out, out};
  for (Vec3& p : wedge) p.y() = -0.5 * width;
  layout.groups[left ? "springing left" : "springing right"] = {std::int64_t(layout.stones.size())};
  lay_stone(layout, {make_prism(wedge, {0.0, width, 0.0})}, {Component::base, part, 0, Vec3::Ones()}, Vec3::Ones(),
            false);
}

/// A buttress under the left springing joint: its inner face goes straight down from the intrados, its top is the joint
/// and then level (or, where the joint slopes down outwards, its extension). Dimensions in m.
struct Buttress {
  double width = 0.0, height = 0.0;  // below the joint's lower point
  int courses = 1;
};

/// Outline of a buttress between two levels, counter-clockwise, in the plane y = 0.
Polygon buttress_course(const Buttress& b, const Vec3& in, const Vec3& out, double low, double high, bool top) {
  const double left = in.x() - b.width;
  Polygon outline = {{left, 0.0, low}, {in.x(), 0.0, low}};
  if (!top) {
    outline.insert(outline.end(), {{in.x(), 0.0, high}, {left, 0.0, high}});
    return outline;
  }
  outline.push_back(in);
  const double slope = (out.z() - in.z()) / (out.x() - in.x());
  if (left < out.x() - 1e-9 * b.width) {
    if (out.z() >= in.z()) outline.push_back(out);
    outline.emplace_back(left, 0.0, out.z() >= in.z() ? out.z() : in.z() + slope * (left - in.x()));
  } else {
    outline.push_back(out);
  }
  return outline;
}

/// A buttress in courses and the fixed block under it; of the right one everything is mirrored about `middle`.
void lay_buttress(Layout& layout, const Buttress& b, const Vec3& in, const Vec3& out, double middle, double width,
                  int part) {
  const bool left = part == 0;
  const std::string side = left ? "left" : "right";
  const auto lay = [&](Polygon outline, Component component) {
    for (Vec3& p : outline) {
      if (!left) p.x() = 2.0 * middle - p.x();
      p.y() = -0.5 * width;
    }
    if (!left) std::reverse(outline.begin(), outline.end());
    const Vec3 size(b.width, width, b.height / b.courses);
    lay_stone(layout, {make_prism(outline, {0.0, width, 0.0})}, {component, part, 0, size}, size, false);
  };
  const double springing = std::min(in.z(), out.z()), course = b.height / b.courses;
  for (int i = 0; i < b.courses; ++i) {
    layout.groups["buttress " + side].push_back(std::int64_t(layout.stones.size()));
    const double low = springing - b.height + i * course;
    lay(buttress_course(b, in, out, low, low + course, i + 1 == b.courses), Component::abutment);
  }
  const double base = springing - b.height;
  layout.groups["base " + side] = {std::int64_t(layout.stones.size())};
  lay(buttress_course(b, in, out, base - 0.5 * b.width, base, false), Component::base);
}

double thickness(const GeneratorInput& in) {
  return in("thickness") > 0.0 ? in("thickness") : in("thickness_ratio") * in("mean_radius");
}

HalfRing read_half(const GeneratorInput& in) {
  const double radius = in("mean_radius"), t = thickness(in), e = in("eccentricity");
  HalfRing half;
  half.centre = e * radius;
  half.inner = radius - 0.5 * t;
  half.outer = radius + 0.5 * t;
  half.foot = 0.5 * radians(in("embrace_angle"));
  half.crown = std::asin(e);
  if (half.inner < 0.1 * radius) {
    throw InputError(
        "[bridge] thickness = {:g} m is too large for mean_radius = {:g} m. It must be at most 1.8 times the radius.",
        t, radius);
  }
  if (e > 0.0 && int(in("voussoirs")) % 2 != 0) {
    throw InputError(
        "[bridge] voussoirs = {:g}, but eccentricity = {:g}. A pointed arch needs an even number of voussoirs.",
        in("voussoirs"), e);
  }
  if (half.inner <= 1.05 * half.centre || half.foot <= half.crown + radians(1.0)) {
    throw InputError(
        "[bridge] eccentricity = {:g} is too large for thickness = {:g} m, mean_radius = {:g} m and embrace_angle = "
        "{:g} deg: the halves of the arch would not meet. Make it smaller.",
        e, t, radius, in("embrace_angle"));
  }
  return half;
}

/// `least`: width of the springing joint in plan, m.
Buttress read_buttress(const GeneratorInput& in, double least) {
  Buttress b = {in("buttress_width"), in("buttress_height"), int(in("buttress_courses"))};
  if (b.height <= 0.0) return b;
  if (in("embrace_angle") < 20.0)
    throw InputError(
        "[bridge] buttress_height = {:g} m, but embrace_angle = {:g} deg. Buttresses need at least 20 deg.", b.height,
        in("embrace_angle"));
  if (b.width < least * (1.0 - 1e-9))
    throw InputError(
        "[bridge] buttress_width = {:g} m is less than the width of the springing joint in plan, {:g} m. Make it at "
        "least that wide.",
        b.width, least);
  return b;
}

/// Where the springing joint slopes down outwards, the top of the buttress does too.
void check_top_course(const Buttress& b, const Vec3& in, const Vec3& out) {
  const double drop = (in.z() - out.z()) / std::abs(in.x() - out.x()) * b.width, course = b.height / b.courses;
  if (drop >= course)
    throw InputError(
        "[bridge] buttress_width = {:g} m: the top of the buttress slopes down by {:.3g} m over this width, but its "
        "top course is {:.3g} m high. Make the buttress narrower or higher, or use fewer courses.",
        b.width, drop, course);
}

Assembly build_arch(const std::vector<Material>& defaults, const GeneratorInput& in) {
  const HalfRing half = read_half(in);
  const int n = int(in("voussoirs"));
  const double width = in("width");
  Ring ring = make_ring(half, n);
  const double beyond = -2.0 / n;  // one wedge below the foot
  Vec3 left_in = half.point(half.inner, beyond), left_out = half.point(half.outer, beyond);
  Vec3 right_in = mirrored(left_in), right_out = mirrored(left_out);
  place(ring, {&left_in, &left_out, &right_in, &right_out});

  Layout layout;
  const Unit unit = {Component::arch, 0, 0, {1.0, width / in("rows"), 1.0}};
  const auto first = lay_ring(layout, ring, -0.5 * width, 0.5 * width, unit);
  for (std::size_t i = 0; i < std::size_t(n); ++i) {
    const bool keystone = i >= std::size_t(n - 1) / 2 && i <= std::size_t(n) / 2;
    for (std::int64_t s = first[i]; s < first[i + 1]; ++s) {
      layout.groups[fmt::format("voussoir {}", i)].push_back(s);
      if (keystone) layout.groups["keystone 0"].push_back(s);
      if (const int quarter = quarter_of(ring.intrados, int(i)); quarter >= 0)
        layout.groups[quarter == 0 ? "quarter 0 left" : "quarter 0 right"].push_back(s);
    }
  }
  const Vec3 &foot_in = ring.intrados.front(), &foot_out = ring.extrados.front();
  if (const Buttress buttress = read_buttress(in, std::abs(foot_out.x() - foot_in.x())); buttress.height > 0.0) {
    check_top_course(buttress, foot_in, foot_out);
    const double middle = 0.5 * (foot_in.x() + ring.intrados.back().x());
    for (int part : {0, 1}) lay_buttress(layout, buttress, foot_in, foot_out, middle, width, part);
  } else {
    lay_springing(layout, foot_in, foot_out, left_in, left_out, true, width, 0);
    lay_springing(layout, ring.intrados.back(), ring.extrados.back(), right_in, right_out, false, width, 1);
  }

  Assembly assembly = assemble(std::move(layout), in_order(defaults, in), {}, in.gap_tolerance);
  assign_stiffness(assembly, uniform_rules(in), in);
  return assembly;
}

}  // namespace

Generator arch_generator() {
  Generator generator;
  generator.name = "arch";
  generator.help =
      "Arch of equal voussoirs with flat faces, between fixed springings or on buttresses; pointed if eccentricity > 0 "
      "(two centres, each eccentricity x mean_radius beyond the middle line)";
  generator.parameters = {
      {"mean_radius", 10.0, 0.01, 500.0, "m", "radius of the middle of the ring"},
      {"thickness", 0.0, 0.0, 100.0, "m", "thickness of the ring; 0: thickness_ratio x mean_radius"},
      {"thickness_ratio", 0.15, 0.001, 1.5, "-", "thickness over mean radius, used when thickness is 0"},
      {"embrace_angle", 180.0, 5.0, 200.0, "deg", "angle between the springings, seen from the centre(s)"},
      {"eccentricity", 0.0, 0.0, 0.8, "-", "0: circular arch; above 0: pointed arch"},
      {"voussoirs", 27.0, 2.0, 400.0, "-", "number of voussoirs between the springings, of equal angle", true},
      {"width", 1.0, 0.01, 100.0, "m", "width of the arch (y)"},
      {"rows", 1.0, 1.0, 100.0, "-", "number of stones across the width, in stretcher bond", true},
      {"buttress_height", 0.0, 0.0, 200.0, "m",
       "height of the buttresses below the springing joints; 0: no buttresses, fixed springings"},
      {"buttress_width", 2.0, 0.01, 200.0, "m", "width of the buttresses, from the intrados outwards"},
      {"buttress_courses", 1.0, 1.0, 1000.0, "-", "number of stones of a buttress, one above the other", true},
      {"kn", 0.0, 0.0, 1e18, "Pa/m", "normal stiffness of all joints; 0: E/dc"},
      {"ks", 0.0, 0.0, 1e18, "Pa/m", "shear stiffness of all joints; 0: G/dc"}};
  generator.materials = {{"masonry", 2000.0, 10e9, 4e9, 0.0, 0.0, radians(35.0)}};
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build_arch(materials, in); };
  return generator;
}

}  // namespace voussoir
