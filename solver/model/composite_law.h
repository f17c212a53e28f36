// The composite law: tension cut-off, Coulomb friction and a cap for crushing, all of them softening, at one point of a
// patch (docs/theory/joints.md). Include laws.h, not this file.
#pragma once
#include <algorithm>
#include <cmath>

namespace voussoir {

/// exp(−x) for x ≥ 0: a power of two times exp(r), |r| ≤ ½ ln 2, from its series (Abramowitz & Stegun 1964, 4.2.1). The
/// result is accurate to rounding. std::exp is not used, because its last bits depend on the processor.
inline double fading(double x) {
  if (x > 700.0) return 0.0;
  constexpr double log_2 = 0.693147180559945309417;
  const double halvings = std::floor(x / log_2 + 0.5), r = halvings * log_2 - x;
  double sum = 1.0;
  for (int i = 13; i > 0; --i) sum = 1.0 + sum * r / i;
  return std::ldexp(sum, -int(halvings));
}

/// The root of f in (0, end), where f(0) = `first` > 0 and f(end) = `last` ≤ 0. The method is false position that
/// halves the function value at an end that stays (Illinois: Dowell & Jarratt 1971).
template <class F>
double first_root(const F& f, double first, double end, double last) {
  const double small = 1e-15 * std::max(first, -last);
  double low = 0.0, high = end, root = end;
  int stayed = 0;  // 1: the upper end did, -1: the lower
  for (int i = 0; i < 80 && last < 0.0 && high - low > 1e-16 * end; ++i) {
    root = (low * last - high * first) / (last - first);
    if (!(root > low && root < high)) root = 0.5 * (low + high);
    const double value = f(root);
    if (std::abs(value) <= small) break;
    if (value > 0.0) {
      low = root, first = value;
      if (stayed == 1) last *= 0.5;
      stayed = 1;
    } else {
      high = root, last = value;
      if (stayed == -1) first *= 0.5;
      stayed = -1;
    }
  }
  return root;
}

/// Strength of the cap and remaining stiffness as functions of the inelastic jump.
class CrushingCurve {
 public:
  static constexpr double begin = 1.0 / 3.0, middle = 0.5, rest = 0.1;  // shares of the strength
  /// Share of the inelastic jump that remains after unloading (Birtel & Mark 2006).
  static constexpr double lasting = 0.7;
  /// Gc over the strength and the length of the first half of the softening (Lourenço 1996: 67/75 with these shares).
  static constexpr double fullness = 5.0 / 6.0 - rest + (middle - rest) * (middle - rest);

  CrushingCurve(const LawConstants& law, double kn)
      : strength_(law.crushing),
        peak_(law.crushing_peak > 0.0 ? law.crushing_peak : law.crushing / kn),
        width_(law.mode_c / (fullness * law.crushing)),
        kn_(kn) {}

  /// Pa, at an inelastic jump (m).
  double strength(double crushed) const {
    if (crushed < peak_) {
      const double x = crushed / peak_;
      return strength_ * (begin + (1.0 - begin) * x * (2.0 - x));
    }
    const double y = (crushed - peak_) / width_;
    if (y < 1.0) return strength_ * (1.0 - (1.0 - middle) * y * y);
    return strength_ * (rest + (middle - rest) * fading((y - 1.0) / (middle - rest)));
  }
  /// Pa/m: derivative of the strength; negative past the peak.
  double slope(double crushed) const {
    if (crushed < peak_) return 2.0 * strength_ * (1.0 - begin) / peak_ * (1.0 - crushed / peak_);
    const double y = (crushed - peak_) / width_;
    if (y < 1.0) return -strength_ / width_ * y;
    return -strength_ / width_ * fading((y - 1.0) / (middle - rest));
  }
  /// Strength divided by the remaining share of the stiffness (effective stress), Pa.
  double effective(double crushed) const { return strength(crushed) + (1.0 - lasting) * kn_ * crushed; }
  /// Remaining share of the stiffness at an inelastic jump (m): 1 without crushing.
  double kept(double crushed) const { return crushed > 0.0 ? strength(crushed) / effective(crushed) : 1.0; }

 private:
  double strength_, peak_, width_, kn_;  // Pa, m, m, Pa/m
};

/// The least Gc (J/m2) for stable crushing under a prescribed jump: kn and ks must exceed the steepest softening, fc²
/// fullness / Gc, for every direction in which the cap yields (docs/theory/joints.md).
inline double least_compressive_energy(const JointLaw& law, double kn, double ks) {
  const double least = std::min(kn, ks) * std::min(1.0, std::sqrt(law.cap_shear));
  const double firm = std::min(kn, CrushingCurve::lasting * least + (1.0 - CrushingCurve::lasting) * kn);
  return CrushingCurve::fullness * law.compressive_strength * law.compressive_strength / firm;
}

/// The pressure p (Pa) at which the largest shear of a point without bond, c_res + p tan φ_res, reaches the initial
/// cap: √(p² + Css (c_res + p tan φ_res)²) = fc/3. A negative value means that it does so at every pressure.
inline double plain_pressure(const LawConstants& law) {
  if (law.crushing <= 0.0) return 1e300;
  const double begin = CrushingCurve::begin * law.crushing, c = law.residual_cohesion, t = law.residual_tan_friction;
  const double a = 1.0 + law.cap_shear * t * t, b = law.cap_shear * c * t, rest = begin * begin - law.cap_shear * c * c;
  return rest < 0.0 ? -1.0 : (std::sqrt(b * b + a * rest) - b) / a;
}

/// Remaining share of the stiffness of a point: 1 except at crushed points of the composite law.
inline double kept_stiffness(const LawConstants& law, double kn, double crushed) {
  return crushed > 0.0 ? CrushingCurve(law, kn).kept(crushed) : 1.0;
}

/// Tension cut-off and Coulomb friction that soften together, and an elliptic cap (Lourenço & Rots 1997), with damaged
/// unloading and a dilation that fades with slip and pressure (van Zijl 2004). The resulting jumps refer to the
/// undamaged stiffness, so that the traction is (kn n, ks s, ks t) as for the other laws.
struct CompositeLaw {
  static constexpr bool crushes = true;
  static PointResult update(const LawConstants& law, double kn, double ks, double un, double us, double ut,
                            PointMemory& memory) {
    Point p(law, kn, ks, memory);
    p.n = un - memory.n, p.s = us - memory.s, p.t = ut - memory.t;
    if (!memory.broken) p.pull();
    if (is_open(p)) return open(us, ut, p);
    p.slide(p.tan_dilation());
    if (is_open(p)) {  // it broke in shear while it was pulled
      p.result.fracture += p.stored();
      return open(us, ut, p);
    }
    if (law.crushing > 0.0 && p.crush()) p.slide(0.0);
    PointResult r = p.result;
    r.n = p.kept * p.n, r.s = p.kept * p.s, r.t = p.kept * p.t;
    return r;
  }

 private:
  static constexpr double last_bond = 1e-4;  // share of the bond below which it counts as lost

  /// A point during its update: its elastic jump, m.
  struct Point {
    const LawConstants& law;
    double kn, ks;  // Pa/m, undamaged
    PointMemory& memory;
    double n = 0.0, s = 0.0, t = 0.0;
    double kept;          // share of the stiffness
    double pulled = 0.0;  // increase of the softening exponent by the opening of this update
    PointResult result;

    Point(const LawConstants& l, double normal, double shear, PointMemory& m)
        : law(l), kn(normal), ks(shear), memory(m), kept(kept_stiffness(l, normal, m.crushed)) {}

    double shear() const { return std::sqrt(s * s + t * t); }
    double stored() const { return 0.5 * kept * (kn * n * n + ks * (s * s + t * t)); }
    double bond() const { return 1.0 - memory.softening; }
    double cohesion(double bond) const { return law.residual_cohesion + bond * (law.cohesion - law.residual_cohesion); }
    /// Friction softens in proportion to the cohesion (Lourenço & Rots 1997).
    double tan_friction(double bond) const {
      return law.residual_tan_friction + bond * (law.tan_friction - law.residual_tan_friction);
    }
    void set_bond(double bond) {
      memory.softening = 1.0 - bond;
      if (bond < last_bond) lose_bond();
    }
    void lose_bond() {
      memory.broken = true;
      memory.softening = 1.0;
    }

    /// tan ψ = tan ψ0 ⟨1 − p/pψ⟩ exp(−us/u0) (van Zijl 2004), at the beginning of the update.
    double tan_dilation() const {
      double tangent = law.tan_dilation;
      if (tangent == 0.0) return 0.0;
      if (law.dilation_length > 0.0) tangent *= fading(memory.slip / law.dilation_length);
      if (law.dilation_pressure > 0.0) tangent *= std::clamp(1.0 + kept * kn * n / law.dilation_pressure, 0.0, 1.0);
      return tangent;
    }

    /// Opens a bonded point until its traction is T exp(−opening/w) with w = GI/T0, where T is the present and T0 the
    /// initial tension limit. A softening branch that is too steep for the spring is brittle.
    void pull() {
      const double k = kept * kn, tension = law.most_tension * bond();
      if (k * n <= tension) return;
      result.elastic = false;
      const double before = stored(), width = law.most_tension > 0.0 ? law.mode_1 / law.most_tension : 0.0;
      if (k * width <= tension) return snap(before);
      const double last = tension * fading(n / width);
      const double opening =
          first_root([&](double x) { return k * (n - x) - tension * fading(x / width); }, k * n - tension, n, -last);
      result.fracture += 0.5 * (tension + k * (n - opening)) * opening;
      memory.n += opening, n -= opening;
      pulled = opening / width;
      set_bond(bond() * fading(pulled));
    }
    void snap(double before) {
      lose_bond();
      result.fracture += before;
    }

    /// Slides until the shear is at Coulomb's limit.
    void slide(double tan_dilation) {
      const double k = kept * ks, trial = k * shear(), limit = slip_limit(bond(), n);
      if (trial <= limit) return;
      result.elastic = false;
      double end_bond = 0.0, slip = 0.0;
      if (!memory.broken && !(softens_in_time(k))) {
        const double before = stored();
        lose_bond();
        slip_by(broken_slip(trial, tan_dilation), tan_dilation);
        result.fracture += std::max(0.0, before - stored());
        return;
      }
      const double from = bond();
      if (memory.broken) {
        slip = broken_slip(trial, tan_dilation);
      } else {
        slip = bonded_slip(trial, limit, tan_dilation);
        end_bond = bond_after(slip);
      }
      const double held = 0.5 * (cohesion(from) + cohesion(end_bond)) - law.residual_cohesion;
      const double pressed = n;
      slip_by(slip, tan_dilation);
      const double lost =
          0.5 * (limit + k * shear() + kept * kn * (pressed + n) * tan_dilation) * slip;  // less the work of dilation
      const double rubbed = memory.broken ? 0.0 : std::min(held * slip, lost);            // a point in tension can slip
      result.fracture += rubbed;
      result.friction += lost - rubbed;
      if (!memory.broken) set_bond(end_bond);
    }
    double slip_limit(double bond, double normal) const {
      return std::max(0.0, cohesion(bond) - kept * kn * normal * tan_friction(bond));
    }
    double slip_width() const {
      const double drop = law.cohesion - law.residual_cohesion;
      return drop > 0.0 ? law.mode_2 / drop : 0.0;
    }
    /// Whether the limit decreases slowly enough for the spring of stiffness k to follow.
    bool softens_in_time(double k) const {
      const double drop = law.cohesion - law.residual_cohesion +
                          std::max(0.0, -kept * kn * n) * (law.tan_friction - law.residual_tan_friction);
      return k * slip_width() > drop * bond();
    }
    /// The exponents of opening and slip are combined as the root of the sum of their squares (Lourenço & Rots 1997).
    double bond_after(double slip) const {
      const double rubbed = slip / slip_width();
      return bond() * fading(std::sqrt(pulled * pulled + rubbed * rubbed) - pulled);
    }
    double bonded_slip(double trial, double limit, double tan_dilation) const {
      const double k = kept * ks, end = shear();
      const auto excess = [&](double slip) {
        return trial - k * slip - slip_limit(bond_after(slip), n - slip * tan_dilation);
      };
      return first_root(excess, trial - limit, end, excess(end));
    }
    double broken_slip(double trial, double tan_dilation) const {
      const double over = trial - slip_limit(0.0, n);
      if (over <= 0.0) return 0.0;
      return std::min(over / (kept * (ks + kn * tan_dilation * law.residual_tan_friction)), shear());
    }
    void slip_by(double slip, double tan_dilation) {
      const double length = shear(), share = length > 0.0 ? slip / length : 0.0;
      memory.s += share * s, memory.t += share * t;
      s -= share * s, t -= share * t;
      memory.n += slip * tan_dilation, n -= slip * tan_dilation;
      memory.slip += slip;
    }

    /// Associated return to the cap p² + Css τ² = strength² with p the pressure, in effective stress. Returns true if
    /// the point yielded. With the plastic multiplier x/((1 − x) kn) the pressure falls to the fraction 1 − x and the
    /// shear to the fraction shear_left(x).
    bool crush() {
      const double pressure = std::max(0.0, -kn * n), drag = ks * shear(), css = law.cap_shear;
      const double trial = std::sqrt(pressure * pressure + css * drag * drag);
      if (memory.crushed == 0.0 && trial <= CrushingCurve::begin * law.crushing) return false;
      const CrushingCurve curve(law, kn);
      const double holds = curve.effective(memory.crushed);
      if (trial <= holds) return false;
      result.elastic = false;
      const double faster = css * ks / kn;
      const auto shear_left = [&](double x) { return (1.0 - x) / (1.0 - x + faster * x); };
      const auto crushed = [&](double x) {
        const double normal = pressure / kn * x, along = drag / ks * (1.0 - shear_left(x));
        return memory.crushed + std::sqrt(normal * normal + along * along) / CrushingCurve::lasting;
      };
      const auto excess = [&](double x) {
        const double p = pressure * (1.0 - x), d = drag * shear_left(x);
        return std::sqrt(p * p + css * d * d) - curve.effective(crushed(x));
      };
      const double end = 1.0 - 1e-12;
      const double x = first_root(excess, trial - holds, end, excess(end));
      yield(holds / trial, x, shear_left(x), crushed(x), curve);
      return true;
    }
    /// Dissipated energy: mean stress times plastic jump, and mean energy times the loss of stiffness.
    void yield(double touched, double x, double left, double crushed, const CrushingCurve& curve) {
      const double kept_then = kept;
      const double closing = n < 0.0 ? -n * x : 0.0, along = shear() * (1.0 - left);
      const double pressed = std::max(0.0, -n) * (touched + 1.0 - x), dragged = shear() * (touched + left);
      memory.crushed = crushed;
      memory.closure += closing;
      memory.n -= closing, n += closing;
      memory.s += (1.0 - left) * s, memory.t += (1.0 - left) * t;
      s *= left, t *= left;
      kept = curve.kept(crushed);
      result.fracture += 0.25 * (kept_then + kept) * (kn * pressed * closing + ks * dragged * along) +
                         0.125 * (kept_then - kept) * (kn * pressed * pressed + ks * dragged * dragged);
    }
  };

  static bool is_open(const Point& p) { return p.memory.broken && p.n >= 0.0; }

  /// An open point carries nothing. Its plastic shear jump follows the total jump, and its plastic normal jump keeps
  /// the crushed part. It therefore closes where the crushed faces touch, without a sudden force.
  static PointResult open(double us, double ut, Point& p) {
    p.memory.n = -p.memory.closure;
    p.memory.s = us, p.memory.t = ut;
    p.result.open = true;
    p.result.elastic = false;
    p.result.friction = 0.0;
    return p.result;
  }
};

}  // namespace voussoir
