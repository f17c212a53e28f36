#include "solver/motion/target.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

namespace {

/// What a code makes of site and soil: the four branches have one form.
struct Shape {
  double factor = 1.0;                  // S: soil and topography
  double plateau = 2.5;                 // over ag S
  double tb = 0.0, tc = 0.0, td = 0.0;  // s
};

std::size_t letter(const TargetSpectrum& t) {
  if (t.soil < 'A' || t.soil > 'E') throw InputError("the soil class is '{}'. It must be A, B, C, D or E.", t.soil);
  return std::size_t(t.soil - 'A');
}

double topography(const TargetSpectrum& t) {
  constexpr double factors[] = {1.0, 1.2, 1.2, 1.4};
  if (t.topography < 1 || t.topography > 4)
    throw InputError("the topographic class is T{}. It must be T1, T2, T3 or T4.", t.topography);
  return factors[t.topography - 1];
}

Shape ntc2018(const TargetSpectrum& t) {
  struct Soil {
    double low, high, at_zero, slope;  // S_S = at_zero − slope F0 ag/g, within low and high
    double scale, power;               // C_C = scale Tc*^power
  };
  constexpr Soil soils[] = {{1.0, 1.0, 1.0, 0.0, 1.0, 0.0},
                            {1.0, 1.2, 1.4, 0.4, 1.1, -0.2},
                            {1.0, 1.5, 1.7, 0.6, 1.05, -0.33},
                            {0.9, 1.8, 2.4, 1.5, 1.25, -0.5},
                            {1.0, 1.6, 2.0, 1.1, 1.15, -0.4}};
  const Soil& soil = soils[letter(t)];
  Shape shape;
  shape.factor = std::clamp(soil.at_zero - soil.slope * t.f0 * t.ag, soil.low, soil.high) * topography(t);
  shape.plateau = t.f0;
  shape.tc = soil.scale * std::pow(t.tc, soil.power) * t.tc;
  shape.tb = shape.tc / 3.0;
  shape.td = 4.0 * t.ag + 1.6;
  return shape;
}

Shape en1998(const TargetSpectrum& t, bool type_2) {
  constexpr Shape soils[2][5] = {{{1.0, 2.5, 0.15, 0.4, 2.0},
                                  {1.2, 2.5, 0.15, 0.5, 2.0},
                                  {1.15, 2.5, 0.2, 0.6, 2.0},
                                  {1.35, 2.5, 0.2, 0.8, 2.0},
                                  {1.4, 2.5, 0.15, 0.5, 2.0}},
                                 {{1.0, 2.5, 0.05, 0.25, 1.2},
                                  {1.35, 2.5, 0.05, 0.25, 1.2},
                                  {1.5, 2.5, 0.1, 0.25, 1.2},
                                  {1.8, 2.5, 0.1, 0.3, 1.2},
                                  {1.6, 2.5, 0.05, 0.25, 1.2}}};
  Shape shape = soils[type_2][letter(t)];
  shape.factor *= topography(t);
  return shape;
}

Shape shape_of(const TargetSpectrum& t) {
  return t.code == TargetCode::ntc2018 ? ntc2018(t) : en1998(t, t.code == TargetCode::en1998_type_2);
}

double eta_of(const TargetSpectrum& t) {
  return std::max(0.55, std::sqrt(10.0 / (5.0 + 100.0 * t.damping)));
}

}  // namespace

void check_target(const TargetSpectrum& t) {
  if (!(t.ag > 0.0 && t.ag < 5.0)) throw InputError("ag is {} g. It must be above 0 and below 5 g.", t.ag);
  if (t.code == TargetCode::ntc2018) {
    if (!(t.f0 >= 2.0 && t.f0 < 5.0))
      throw InputError("f0 is {}. It must be at least 2 and below 5; usual values are 2.2 to 3.", t.f0);
    if (!(t.tc > 0.0 && t.tc < 2.0)) throw InputError("tc is {} s. It must be Tc*, above 0 and below 2 s.", t.tc);
  }
  if (!(t.damping > 0.0 && t.damping < 0.3))
    throw InputError("damping is {}. It must be above 0 and below 0.3.", t.damping);
  shape_of(t);
}

const std::vector<std::string>& target_codes() {
  static const std::vector<std::string> names = {"ntc2018", "en1998-1", "en1998-2"};
  return names;
}

double vertical_spectral_acceleration(const TargetSpectrum& t, double period) {
  constexpr double tb = 0.05, tc = 0.15, td = 1.0;  // s, on every soil
  double ground = 0.0, top = 0.0;                   // g
  if (t.code == TargetCode::ntc2018) {
    // F_v = 1.35 F0 √(ag/g); amplified by the topography, not by the soil.
    ground = t.ag * topography(t) * 1.35 * std::sqrt(t.ag);
    top = ground * eta_of(t) * t.f0;
  } else {
    ground = t.ag * (t.code == TargetCode::en1998_type_1 ? 0.90 : 0.45);
    top = ground * eta_of(t) * 3.0;
  }
  if (period < tb) return ground + (top - ground) * period / tb;
  if (period < tc) return top;
  if (period < td) return top * tc / period;
  return top * tc * td / (period * period);
}

double spectral_acceleration(const TargetSpectrum& t, double period) {
  const Shape s = shape_of(t);
  const double eta = eta_of(t);
  const double ground = t.ag * s.factor, top = ground * eta * s.plateau;
  if (period < s.tb) return ground + (top - ground) * period / s.tb;
  if (period < s.tc) return top;
  if (period < s.td) return top * s.tc / period;
  return top * s.tc * s.td / (period * period);
}

}  // namespace voussoir
