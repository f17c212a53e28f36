// The modified MEXE method: an empirical axle load for a single masonry span, for comparison with a model.
#pragma once
#include <optional>

namespace voussoir {

/// Geometry of an arch barrel, and factors from an inspection. All must be given except F_sr. Source: BA 16/97, chapter
/// 3.
struct MexeInput {
  double span = 0.0;                              // m, L
  double rise = 0.0;                              // m, r_c, at the crown
  double quarter_rise = 0.0;                      // m, r_q, at the quarter points
  double ring = 0.0;                              // m, d, thickness of the barrel at the crown
  double fill = 0.0;                              // m, h, fill and surfacing over the crown
  bool fill_at_most_ring = true;                  // limit the fill in the calculation to the thickness of the barrel
  double barrel = 0.0, fill_factor = 0.0;         // F_b and F_f, of the materials
  double width = 0.0, depth = 0.0, mortar = 0.0;  // F_w, F_d, F_mo, of the joints
  double condition = 0.0;                         // F_cM
  std::optional<double> span_rise;                // F_sr, from figure 3/3; required if span / rise is more than 4
};

/// All intermediate values and the axle load.
struct MexeResult {
  double fill = 0.0, total = 0.0;         // m, h and d + h as used in the calculation
  double provisional = 0.0;               // t, provisional axle load (PAL), at most 70
  double span_rise_ratio = 0.0;           // L / r_c
  double quarter_ratio = 0.0;             // r_q / r_c
  double span_rise = 1.0, profile = 1.0;  // F_sr, F_p
  double material = 1.0, joint = 1.0;     // F_m, F_j
  double condition = 1.0;                 // F_cM
  double modified = 0.0;                  // t, modified axle load (MAL), without the axle factors of BA 16/97 3.27
};

/// Throws InputError for values outside the limits of the method: spans of 1.5 to 18 m, d + h of 0.25 to 1.8 m.
MexeResult mexe(const MexeInput& input);

}  // namespace voussoir
