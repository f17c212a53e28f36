#include "solver/statics/mexe.h"

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

namespace {

// Limits of the nomogram, BA 16/97 figure 3/1. The scale of spans begins at 1.5 m and ends at the 18 m that the method
// is for; those of the crown thickness and of the axle load end at 1.8 m and 70 t.
constexpr double least_span = 1.5, most_span = 18.0;    // m
constexpr double least_total = 0.25, most_total = 1.8;  // m
constexpr double most_provisional = 70.0;               // t

void check(double value, double low, double high, const char* what, const char* unit, const char* remedy) {
  if (value >= low && value <= high) return;
  throw InputError("MEXE: {} is {:g}{}. It must be from {:g} to {:g}{}. {}", what, value, unit, low, high, unit,
                   remedy);
}

void check_factor(double value, const char* what) {
  if (value > 0.0 && value <= 2.0) return;
  throw InputError("MEXE: {} is {:g}. It must be above 0 and at most 2. Take it from the tables of BA 16/97.", what,
                   value);
}

void check_input(const MexeInput& in) {
  check(in.span, least_span, most_span, "the span", " m", "Use a model to assess other spans.");
  if (!(in.rise > 0.0 && in.rise <= in.span))
    throw InputError("MEXE: the rise is {:g} m. It must be above 0 and at most the span, {:g} m.", in.rise, in.span);
  if (!(in.quarter_rise > 0.0 && in.quarter_rise < in.rise))
    throw InputError(
        "MEXE: the rise at the quarter points is {:g} m. It must be above 0 and less than the rise at the crown, {:g} "
        "m.",
        in.quarter_rise, in.rise);
  if (!(in.ring > 0.0)) throw InputError("MEXE: the thickness of the barrel is {:g} m. It must be above 0.", in.ring);
  if (!(in.fill >= 0.0)) throw InputError("MEXE: the fill over the crown is {:g} m. It must be 0 or more.", in.fill);
  check_factor(in.barrel, "the barrel factor F_b");
  check_factor(in.fill_factor, "the fill factor F_f");
  check_factor(in.width, "the width factor F_w");
  check_factor(in.depth, "the depth factor F_d");
  check_factor(in.mortar, "the mortar factor F_mo");
  check_factor(in.condition, "the condition factor F_cM");
  if (in.span_rise) check_factor(*in.span_rise, "the span/rise factor F_sr");
}

/// 1 for ratios up to 4; for larger ratios the method gives a figure and no formula.
double span_rise_factor(const MexeInput& in, double ratio) {
  if (in.span_rise) return *in.span_rise;
  if (ratio <= 4.0) return 1.0;
  throw InputError(
      "MEXE: span / rise is {:.3g}, which is more than 4. Give the span/rise factor F_sr from BA 16/97, figure 3/3.",
      ratio);
}

/// BA 16/97 3.12.
double profile_factor(double quarter_ratio) {
  return quarter_ratio <= 0.75 ? 1.0 : 2.3 * std::pow(1.0 - quarter_ratio, 0.6);
}

}  // namespace

MexeResult mexe(const MexeInput& in) {
  check_input(in);
  MexeResult out;
  out.fill = in.fill_at_most_ring ? std::min(in.fill, in.ring) : in.fill;
  out.total = in.ring + out.fill;
  check(out.total, least_total, most_total, "the thickness of barrel and fill at the crown", " m",
        "Use a model to assess other arches.");
  // BA 16/97 3.10, in t and m.
  out.provisional = std::min(most_provisional, 740.0 * out.total * out.total / std::pow(in.span, 1.3));
  out.span_rise_ratio = in.span / in.rise;
  out.quarter_ratio = in.quarter_rise / in.rise;
  out.span_rise = span_rise_factor(in, out.span_rise_ratio);
  out.profile = profile_factor(out.quarter_ratio);
  out.material = (in.barrel * in.ring + in.fill_factor * out.fill) / out.total;  // 3.13
  out.joint = in.width * in.depth * in.mortar;                                   // 3.16
  out.condition = in.condition;
  out.modified = out.span_rise * out.profile * out.material * out.joint * out.condition * out.provisional;  // 3.24
  return out;
}

}  // namespace voussoir
