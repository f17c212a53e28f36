#include "geometry/vault_shape.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// A line from u = 0 to 1 in the plane x-z, with its tangent, in units of length about the middle between the
/// springings: x from −a to a, z from 0 at the springings.
struct Curve {
  std::function<Vec3(double)> at;       // m
  std::function<Vec3(double)> tangent;  // of any length, from left to right
  bool symmetric = true;
  bool kink = false;  // at the crown, u = ½
};

/// An arc about (0, z) from the left springing to the right one.
Curve arc(double half_angle, double radius, double z) {
  const auto angle = [=](double u) { return half_angle * (2.0 * u - 1.0); };
  return {[=](double u) { return Vec3(radius * std::sin(angle(u)), 0.0, z + radius * std::cos(angle(u))); },
          [=](double u) { return Vec3(std::cos(angle(u)), 0.0, -std::sin(angle(u))); }};
}

Curve segmental(double a, double rise) {
  const double radius = (a * a + rise * rise) / (2.0 * rise);
  const double half = std::asin(std::min(1.0, a / radius));  // of a semicircle rounding may give more than 1
  return arc(rise > a ? pi - half : half, radius, rise - radius);
}

Curve elliptical(double a, double rise) {
  const auto angle = [](double u) { return pi * (1.0 - u); };
  return {[=](double u) { return Vec3(a * std::cos(angle(u)), 0.0, rise * std::sin(angle(u))); },
          [=](double u) { return Vec3(a * std::sin(angle(u)), 0.0, -rise * std::cos(angle(u))); }};
}

Curve parabolic(double a, double rise) {
  const auto x = [=](double u) { return a * (2.0 * u - 1.0); };
  return {[=](double u) { return Vec3(x(u), 0.0, rise * (1.0 - x(u) * x(u) / (a * a))); },
          [=](double u) { return Vec3(1.0, 0.0, -2.0 * rise * x(u) / (a * a)); }};
}

/// Two arcs about points on the springing line.
Curve pointed(double a, double rise) {
  const double radius = (a * a + rise * rise) / (2.0 * a), all = std::asin(std::min(1.0, rise / radius));
  const double sweep = rise > radius ? pi - all : all;  // of each
  const auto angle = [=](double u) { return sweep * 2.0 * std::min(u, 1.0 - u); };
  const auto side = [](double u) { return u <= 0.5 ? -1.0 : 1.0; };
  Curve curve = {[=](double u) {
                   return Vec3(side(u) * (a - radius + radius * std::cos(angle(u))), 0.0, radius * std::sin(angle(u)));
                 },
                 [=](double u) { return Vec3(std::sin(angle(u)), 0.0, -side(u) * std::cos(angle(u))); }};
  curve.kink = true;
  return curve;
}

/// Radii of the oval of three arcs, upright at the springings and level at the crown, whose change is where the line
/// from springing to crown, shortened by the difference of half span and rise, has its middle: the usual construction.
struct Oval {
  double haunch, crown;
  Oval(double a, double rise) {
    const double root = std::hypot(a, rise);
    haunch = root * (root - (a - rise)) / (2.0 * a), crown = root * (root + (a - rise)) / (2.0 * rise);
  }
};

Curve three_centred(double a, double rise) {
  const Oval r(a, rise);
  const double flat = std::atan2(a - r.haunch, r.crown - rise);  // half of the angle of the middle arc
  const double side = r.haunch * (0.5 * pi - flat), all = 2.0 * (side + r.crown * flat);
  const auto angle = [=](double u) {  // of the normal from the vertical
    const double s = all * (u - 0.5), middle = r.crown * flat;
    return std::abs(s) <= middle ? s / r.crown : std::copysign(flat + (std::abs(s) - middle) / r.haunch, s);
  };
  return {[=](double u) {
            const double phi = angle(u);
            if (std::abs(phi) <= flat)
              return Vec3(r.crown * std::sin(phi), 0.0, rise - r.crown + r.crown * std::cos(phi));
            return Vec3(std::copysign(a - r.haunch, phi) + r.haunch * std::sin(phi), 0.0, r.haunch * std::cos(phi));
          },
          [=](double u) { return Vec3(std::cos(angle(u)), 0.0, -std::sin(angle(u))); }};
}

/// Slopes at points of the cubic spline through them, over their chord lengths `s`; parabolas at both ends.
std::vector<Vec3> spline_slopes(const Polygon& points, const std::vector<double>& s) {
  const auto n = Eigen::Index(points.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX3d b(n, 3);
  const auto inverse = [&](Eigen::Index i) { return 1.0 / (s[std::size_t(i) + 1] - s[std::size_t(i)]); };
  const auto chord = [&](Eigen::Index i) -> Vec3 {
    return inverse(i) * (points[std::size_t(i) + 1] - points[std::size_t(i)]);
  };
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double before = inverse(i - 1), after = inverse(i);
    a(i, i - 1) = before, a(i, i) = 2.0 * (before + after), a(i, i + 1) = after;
    b.row(i) = 3.0 * (before * chord(i - 1) + after * chord(i));
  }
  a(0, 0) = a(0, 1) = a(n - 1, n - 1) = a(n - 1, n - 2) = 1.0;
  b.row(0) = 2.0 * chord(0), b.row(n - 1) = 2.0 * chord(n - 2);
  const Eigen::MatrixX3d x = a.partialPivLu().solve(b);
  std::vector<Vec3> slopes;
  for (Eigen::Index i = 0; i < n; ++i) slopes.emplace_back(x.row(i));
  return slopes;
}

/// The cubic spline through points.
Curve surveyed(const Polygon& points) {
  std::vector<double> s = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i) s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  const auto piece = [=, slopes = spline_slopes(points, s)](double u, bool derivative) -> Vec3 {
    const double at = u * s.back();
    const auto above = std::upper_bound(s.begin() + 1, s.end() - 1, at) - s.begin();
    const auto i = std::size_t(above) - 1;
    const double h = s[i + 1] - s[i], t = (at - s[i]) / h;
    const Vec3 &p = points[i], &q = points[i + 1];
    const Vec3 v = h * slopes[i], w = h * slopes[i + 1];
    if (derivative) return (6.0 * t * (t - 1.0)) * (p - q) + (1.0 - t) * (1.0 - 3.0 * t) * v + t * (3.0 * t - 2.0) * w;
    return (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t) * p + t * (1.0 - t) * (1.0 - t) * v + t * t * (3.0 - 2.0 * t) * q -
           t * t * (1.0 - t) * w;
  };
  Curve curve = {[=](double u) { return piece(u, false); }, [=](double u) { return piece(u, true); }};
  curve.symmetric = false;
  return curve;
}

struct Shape {
  const char* name;
  Curve (*curve)(double a, double rise);
};
const Shape shapes[] = {
    {"semicircular", segmental}, {"segmental", segmental}, {"elliptical", elliptical}, {"three-centred", three_centred},
    {"pointed", pointed},        {"parabolic", parabolic}, {"surveyed", nullptr}};

Curve curve_of(const VaultShape& vault) {
  if (vault.shape == "surveyed") return surveyed(vault.surveyed);
  const auto found = std::find_if(std::begin(shapes), std::end(shapes), [&](auto& s) { return vault.shape == s.name; });
  Curve flat = found->curve(0.5 * vault.span(), vault.rise);
  // Between springings at two levels the same line, sheared.
  const double slope = (vault.right.z() - vault.left.z()) / vault.span();
  const Vec3 middle = 0.5 * (vault.left + vault.right);
  Curve curve = flat;
  curve.at = [=](double u) {
    const Vec3 p = flat.at(u);
    return Vec3(middle.x() + p.x(), 0.0, middle.z() + p.z() + slope * p.x());
  };
  curve.tangent = [=](double u) {
    const Vec3 t = flat.tangent(u);
    return Vec3(t.x(), 0.0, t.z() + slope * t.x());
  };
  curve.symmetric = slope == 0.0;
  return curve;
}

/// Lengths along a curve at even steps of u.
class Lengths {
 public:
  explicit Lengths(const Curve& curve) : at_(steps + 1) {
    Vec3 before = curve.at(0.0);
    for (int i = 1; i <= steps; ++i) {
      const Vec3 p = curve.at(double(i) / steps);
      at_[std::size_t(i)] = at_[std::size_t(i) - 1] + (p - before).norm();
      before = p;
    }
  }
  double all() const { return at_.back(); }
  /// u at a share of the whole length.
  double at_share(double share) const {
    const double wanted = share * all();
    const auto above = std::upper_bound(at_.begin() + 1, at_.end() - 1, wanted);
    const auto i = double(above - at_.begin());
    return std::clamp((i - 1.0 + (wanted - *(above - 1)) / (*above - *(above - 1))) / steps, 0.0, 1.0);
  }

 private:
  static constexpr int steps = 4000;
  std::vector<double> at_;
};

Vec3 mirrored(const Vec3& p, double middle) {
  return {2.0 * middle - p.x(), p.y(), p.z()};
}

/// A joint: where it begins, its direction outwards, and the share of the way from the crown to a springing.
struct Joint2 {
  Vec3 from, outward;
  double share;
};

std::vector<Joint2> joints_of(const VaultShape& vault) {
  const Curve curve = curve_of(vault);
  const Lengths lengths(curve);
  const int n = vault.voussoirs;
  const double middle = 0.5 * (vault.left.x() + vault.right.x());
  std::vector<Joint2> joints;
  for (int i = 0; i <= n; ++i) {
    if (curve.symmetric && 2 * i > n) {  // bit for bit the mirror image of the left half
      const Joint2& left = joints[std::size_t(n - i)];
      joints.push_back({mirrored(left.from, middle), mirrored(left.outward, 0.0), left.share});
      continue;
    }
    const double u = lengths.at_share(double(i) / n);
    Joint2 joint = {curve.at(u), Vec3::UnitZ(), std::abs(2.0 * i / n - 1.0)};
    if (i == 0) joint.from = vault.left;
    if (i == n) joint.from = vault.right;
    if (curve.symmetric && 2 * i == n) {
      joint.from.x() = middle;
    } else {
      const Vec3 t = curve.tangent(u);
      joint.outward = Vec3(-t.z(), 0.0, t.x()).normalized();
      // An upright tangent is so up to rounding: a foot that is level is exactly so, or a sliver is laid under it.
      if (std::abs(joint.outward.z()) < 1e-12) joint.outward = Vec3(std::copysign(1.0, joint.outward.x()), 0.0, 0.0);
    }
    joints.push_back(joint);
  }
  return joints;
}

/// The upright joint at the crown of a pointed vault goes to where the extrados of both sides meet.
double along_crown(const VaultShape& vault, double thickness) {
  if (vault.shape != "pointed") return thickness;
  const double a = 0.5 * vault.span(), radius = (a * a + vault.rise * vault.rise) / (2.0 * a);
  return std::sqrt((radius + thickness) * (radius + thickness) - (radius - a) * (radius - a)) - vault.rise;
}

void check_shape(const VaultShape& v, const std::string& key) {
  const double a = 0.5 * v.span();
  const auto refuse = [&](const char* why, double would) {
    throw InputError("{}: rise = {:g} m and clear_span = {:g} m do not give a {} vault: {}, such as rise = {:g} m", key,
                     v.rise, v.span(), v.shape, why, would);
  };
  if (v.shape == "semicircular" && std::abs(v.rise - a) > 1e-9 * a) refuse("the rise is half the span", a);
  if (v.shape == "segmental" && v.rise > a * (1.0 + 1e-9)) refuse("the rise is at most half the span", a);
  if (v.shape == "three-centred" && v.rise > 0.999 * a) refuse("the rise is less than half the span", 0.7 * a);
  if (v.shape == "three-centred" && v.rise < 0.3 * a) refuse("the rise is at least 0.15 of the span", 0.3 * a);
  if (v.shape == "pointed" && v.rise < 1.001 * a) refuse("the rise is more than half the span", 1.2 * a);
  if (v.shape == "pointed" && v.voussoirs % 2 != 0)
    throw InputError("{}: voussoirs = {}, but a pointed vault has a joint at its crown and needs an even number", key,
                     v.voussoirs);
}

void check_convex(const Ring& ring, const std::string& key) {
  const auto turns = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x() - a.x()) * (c.z() - b.z()) - (b.z() - a.z()) * (c.x() - b.x());
  };
  const Polygon& p = ring.extrados;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Vec3 step = p[i + 1] - p[i];
    const Polygon w = ring.wedge(int(i));
    const bool hollow = turns(w[0], w[1], w[2]) <= 0.0 || turns(w[1], w[2], w[3]) <= 0.0 ||
                        turns(w[2], w[3], w[0]) <= 0.0 || turns(w[3], w[0], w[1]) <= 0.0;
    if (hollow || step.dot(ring.intrados[i + 1] - ring.intrados[i]) <= 0.0)
      throw InputError(
          "{}: the joints {} and {} from the left cross within the ring. Make the ring thinner, or the curvature of "
          "the intrados smaller.",
          key, i, i + 1);
    if (i > 0 && turns(p[i - 1], p[i], p[i + 1]) > 1e-9 * step.squaredNorm())
      throw InputError(
          "{}: its extrados is concave at x = {:.3f} m, z = {:.3f} m, so stones above it cannot be cut to fit. Give "
          "another intrados, or a smaller difference of thickness between crown and springing.",
          key, p[i].x(), p[i].z());
  }
}

}  // namespace

const std::vector<std::string>& vault_shapes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Shape& shape : shapes) all.emplace_back(shape.name);
    return all;
  }();
  return names;
}

double intrados_length(const VaultShape& vault) {
  return Lengths(curve_of(vault)).all();
}

std::vector<Ring> vault_rings(const VaultShape& vault, const std::string& key) {
  check_shape(vault, key);
  if (vault.shape == "semicircular" && vault.crown == vault.springing && vault.left.z() == vault.right.z()) {
    std::vector<Ring> rings;
    const Vec3 centre(0.5 * (vault.left.x() + vault.right.x()), 0.0, vault.left.z());
    double radius = 0.5 * vault.span();
    for (const double t : vault.crown) {
      rings.push_back(make_semicircle(centre, radius, radius + t, vault.voussoirs));
      radius += t;
    }
    return rings;
  }
  const std::vector<Joint2> joints = joints_of(vault);
  std::vector<Ring> rings;
  double crown = 0.0, springing = 0.0;  // of the rings below
  for (std::size_t k = 0; k < vault.crown.size(); ++k) {
    Ring ring;
    const auto point = [&](const Joint2& joint) -> Vec3 {
      const double t = crown + joint.share * joint.share * (springing - crown);
      return joint.from + (joint.share == 0.0 ? along_crown(vault, t) : t) * joint.outward;
    };
    for (const Joint2& joint : joints) ring.intrados.push_back(point(joint));
    crown += vault.crown[k], springing += vault.springing[k];
    for (const Joint2& joint : joints) ring.extrados.push_back(point(joint));
    check_convex(ring, key);
    rings.push_back(std::move(ring));
  }
  return rings;
}

Ring whole_vault(const std::vector<Ring>& rings) {
  return {rings.front().intrados, rings.back().extrados, rings.front().centre};
}

}  // namespace voussoir
