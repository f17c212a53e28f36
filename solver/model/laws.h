// Joint laws at one point of a patch. A law is a struct with `update`: given the jump and the point's memory it returns
// the elastic jump (traction over stiffness) and updates the memory. A new law is a new struct here (or in a separate
// file) and one line in with_law().
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/assembly.h"

namespace voussoir {

/// Constants of a law for the computation (tangents instead of angles).
struct LawConstants {
  JointLaw::Kind kind = JointLaw::Kind::brittle;
  double tension = 0.0, cohesion = 0.0, tan_friction = 0.0;     // Pa, Pa, –: while bonded
  double residual_cohesion = 0.0, residual_tan_friction = 0.0;  // Pa, –: bond lost
  double tan_dilation = 0.0;
  double mode_1 = 0.0, mode_2 = 0.0;  // J/m2, softening
  double prestress = 0.0;             // Pa, tie
  // Composite: Pa (0: no crushing), J/m2, m (0: the elastic jump), –, m (0: no decay), Pa (0: no decay).
  double crushing = 0.0, mode_c = 0.0, crushing_peak = 0.0, cap_shear = 0.0;
  double dilation_length = 0.0, dilation_pressure = 0.0;
  double plain_pressure = 0.0;  // Pa, up to which a point without bond does not crush, for any shear
  // Limits of the elastic path. An elastic law has none, and tension ends at the apex of the cone.
  double most_tension = 0.0, most_cohesion = 0.0, slope = 0.0;
};
LawConstants law_constants(const JointLaw& law);
inline bool is_composite(const LawConstants& law) {
  return law.kind == JointLaw::Kind::composite;
}
inline bool crushes(const LawConstants& law) {
  return law.crushing > 0.0;
}
/// Whether a joint of this law begins with a bond that it can lose. Elastic joints count although they never lose it.
inline bool has_bond(const LawConstants& law) {
  return law.kind == JointLaw::Kind::elastic || law.tension > 0.0 || law.cohesion > law.residual_cohesion;
}

/// Memory of a point: plastic jump (normal, s, t), loss of the bond, and softening.
struct PointMemory {
  double n = 0.0, s = 0.0, t = 0.0;  // m
  double softening = 0.0;            // 0 intact … 1 fully softened; softening and composite laws only
  bool broken = false;
  // Composite law only, m: inelastic jump of crushing, crushed part of the normal jump (it remains when the point
  // opens), and accumulated slip.
  double crushed = 0.0, closure = 0.0, slip = 0.0;
};

/// Result of one update. `n, s, t` is the elastic jump: traction is (kn n, ks s, ks t). Energies per unit area, J/m2.
struct PointResult {
  double n = 0.0, s = 0.0, t = 0.0;
  double friction = 0.0, fracture = 0.0;
  bool elastic = true;  // the point did not slide, open or break in this update
  bool open = false;    // carries nothing
};

/// An unbonded point: open in tension, else Coulomb friction with return to the cone along the shear direction. With a
/// dilation angle, slip |Δus| opens the joint by |Δus| tan ψ. While the point is open its plastic shear jump follows
/// the total jump, so that it closes without a sudden shear force.
inline PointResult coulomb(const LawConstants& law, double kn, double ks, double un, double us, double ut,
                           double cohesion, double tan_friction, PointMemory& memory) {
  PointResult r;
  const double n = un - memory.n;
  if (n >= 0.0) {
    memory.s = us;
    memory.t = ut;
    memory.n = 0.0;  // an opened joint has no dilation any more
    r.open = true;
    r.elastic = false;
    return r;
  }
  const double s = us - memory.s, t = ut - memory.t;
  const double trial = ks * std::sqrt(s * s + t * t);
  const double limit = cohesion - kn * n * tan_friction;
  r.n = n;
  r.s = s;
  r.t = t;
  if (trial <= limit) return r;
  // Return with dilation: slip d lowers the shear by ks d and raises the compression by kn d tan ψ.
  const double slip = (trial - limit) / (ks + kn * law.tan_dilation * tan_friction);
  const double keep = trial > 0.0 ? 1.0 - ks * slip / trial : 0.0;
  memory.s += (1.0 - keep) * s;
  memory.t += (1.0 - keep) * t;
  memory.n += slip * law.tan_dilation;
  r.n = un - memory.n;
  r.s = keep * s;
  r.t = keep * t;
  r.friction = (keep * trial + kn * r.n * law.tan_dilation) * slip;  // shear work less the work of dilation
  r.elastic = false;
  return r;
}

/// Mohr–Coulomb with tension cut-off. Past either limit the bond is lost permanently, as in the usual distinct element
/// codes for masonry (Hart, Cundall & Lemos 1988; Lemos 2007).
struct BrittleLaw {
  static constexpr bool crushes = false;
  static PointResult update(const LawConstants& law, double kn, double ks, double un, double us, double ut,
                            PointMemory& memory) {
    if (!memory.broken) {
      const double n = un - memory.n, s = us - memory.s, t = ut - memory.t;
      const double shear = ks * std::sqrt(s * s + t * t);
      if (kn * n <= law.tension && shear <= law.cohesion - kn * n * law.tan_friction) {
        PointResult r;
        r.n = n;
        r.s = s;
        r.t = t;
        return r;
      }
      memory.broken = true;
      const double before = 0.5 * (kn * n * n + ks * (s * s + t * t));
      PointResult r = coulomb(law, kn, ks, un, us, ut, law.residual_cohesion, law.residual_tan_friction, memory);
      const double after = 0.5 * (kn * r.n * r.n + ks * (r.s * r.s + r.t * r.t));
      r.fracture = std::max(0.0, before - after);  // energy of the spring that is lost at once
      r.friction = 0.0;
      r.elastic = false;
      return r;
    }
    return coulomb(law, kn, ks, un, us, ut, law.residual_cohesion, law.residual_tan_friction, memory);
  }
};

/// Linear softening of tension and cohesion with fracture energies GI, GII: one softening variable, driven by the
/// plastic opening over wI = 2 GI / ft and the plastic slip over wII = 2 GII / c (after Lourenço & Rots 1997, linear
/// instead of exponential). A softening branch that is too steep for the spring (snap-back) is brittle. Friction does
/// not soften.
struct SofteningLaw {
  static constexpr bool crushes = false;
  static PointResult update(const LawConstants& law, double kn, double ks, double un, double us, double ut,
                            PointMemory& memory) {
    if (memory.broken)
      return coulomb(law, kn, ks, un, us, ut, law.residual_cohesion, law.residual_tan_friction, memory);
    PointResult r;
    double n = un - memory.n;
    const double soft_cohesion = residual(law, memory.softening);
    // The cone can end below the tension limit. Tension does not exceed its apex.
    const double apex = law.tan_friction > 0.0 ? soft_cohesion / law.tan_friction : 1e300;
    const double tension = std::min(law.tension * (1.0 - memory.softening), apex);
    if (kn * n > tension) {
      const double width = law.tension > 0.0 ? 2.0 * law.mode_1 / law.tension : 0.0;  // m, wI
      const double slope = width > 0.0 ? law.tension / width : kn;
      const double opening = kn > slope ? (kn * n - tension) / (kn - slope) : n;
      const double used = width > 0.0 ? opening / width : 1.0;
      if (memory.softening + used >= 1.0) return lose_bond(law, kn, ks, un, us, ut, memory);
      memory.n += opening;
      memory.softening += used;
      n = un - memory.n;
      r.fracture += 0.5 * (tension + kn * n) * opening;
      r.elastic = false;
    }
    double s = us - memory.s, t = ut - memory.t;
    const double trial = ks * std::sqrt(s * s + t * t);
    const double cohesion = residual(law, memory.softening);
    const double limit = cohesion - kn * n * law.tan_friction;
    if (trial > limit) {
      const double drop = law.cohesion - law.residual_cohesion;
      const double width = drop > 0.0 ? 2.0 * law.mode_2 / drop : 0.0;  // m, wII
      const double slope = width > 0.0 ? drop / width : 0.0;
      if (width <= 0.0 || ks <= slope) return lose_bond(law, kn, ks, un, us, ut, memory);
      const double slip = (trial - limit) / (ks - slope);
      if (memory.softening + slip / width >= 1.0) return lose_bond(law, kn, ks, un, us, ut, memory);
      const double keep = 1.0 - ks * slip / trial;
      if (!(limit >= 0.0) || keep < 0.0)
        return lose_bond(law, kn, ks, un, us, ut, memory);  // less stiff than the remaining strength requires
      memory.s += (1.0 - keep) * s;
      memory.t += (1.0 - keep) * t;
      memory.softening += slip / width;
      s *= keep;
      t *= keep;
      const double mean_cohesion = 0.5 * (cohesion + residual(law, memory.softening));
      r.fracture += (mean_cohesion - law.residual_cohesion) * slip;
      r.friction += (0.5 * (limit + keep * trial) - mean_cohesion + law.residual_cohesion) * slip;
      r.elastic = false;
    }
    r.n = n;
    r.s = s;
    r.t = t;
    return r;
  }

 private:
  static double residual(const LawConstants& law, double softening) {
    return law.cohesion - softening * (law.cohesion - law.residual_cohesion);
  }
  static PointResult lose_bond(const LawConstants& law, double kn, double ks, double un, double us, double ut,
                               PointMemory& memory) {
    const double n = un - memory.n, s = us - memory.s, t = ut - memory.t;
    const double before = 0.5 * (kn * n * n + ks * (s * s + t * t));
    memory.broken = true;
    memory.softening = 1.0;
    memory.n = 0.0;  // the cracked faces touch again at their original position
    PointResult r = coulomb(law, kn, ks, un, us, ut, law.residual_cohesion, law.residual_tan_friction, memory);
    r.fracture = std::max(0.0, before - 0.5 * (kn * r.n * r.n + ks * (r.s * r.s + r.t * r.t)));
    r.friction = 0.0;
    r.elastic = false;
    return r;
  }
};

/// A spring without limits, for verification.
struct ElasticLaw {
  static constexpr bool crushes = false;
  static PointResult update(const LawConstants&, double, double, double un, double us, double ut, PointMemory&) {
    PointResult r;
    r.n = un;
    r.s = us;
    r.t = ut;
    return r;
  }
};

/// A bar that acts only in tension and yields without hardening. Its jump is negative when it is stretched
/// (tie_jump()). It therefore counts as compressed when taut and open when slack, like a dry contact. Its plastic jump
/// is the yielded length, which remains when it is slack.
struct TieLaw {
  static constexpr bool crushes = false;
  static PointResult update(const LawConstants& law, double kn, double, double un, double, double,
                            PointMemory& memory) {
    PointResult r;
    memory.broken = true;  // there is no bond to lose
    const double most = law.tension / kn;
    r.n = un - memory.n;
    r.open = r.n >= 0.0;
    r.elastic = !r.open && r.n >= -most;
    if (r.open) r.n = 0.0;
    if (r.n >= -most) return r;
    memory.n += r.n + most;
    r.n = -most;
    return r;
  }
};

}  // namespace voussoir

#include "solver/model/composite_law.h"

namespace voussoir {

/// Calls `use` with the law of that kind.
template <class F>
auto with_law(JointLaw::Kind kind, F&& use) {
  switch (kind) {
    case JointLaw::Kind::softening:
      return use(SofteningLaw{});
    case JointLaw::Kind::elastic:
      return use(ElasticLaw{});
    case JointLaw::Kind::tie:
      return use(TieLaw{});
    case JointLaw::Kind::composite:
      return use(CompositeLaw{});
    default:
      return use(BrittleLaw{});
  }
}

}  // namespace voussoir
