// The computations that the convergence studies repeat, each of one specimen with one thing varied, and their closed
// forms. Everything runs through the library as a case would. Errors are thrown as RunError.
#pragma once
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

// --- A square joint ---

/// A rigid block on a square bed without tension.
struct Bed {
  double turn = 0.0;     // rad, towards the load
  double sinking = 0.0;  // m, of the bed's middle; negative where it lifts
};
constexpr double bed_side = 1.0, bed_force = 1e4, bed_kn = 1e10;  // m, N, Pa/m

/// Closed form of an elastic bed that bears no tension, under bed_force at `eccentricity` (share of the side, below
/// 0.5): linear pressure over all of the bed within the kernel; beyond it over c = 3 (b/2 − e), edge pressure 2P/(c d).
Bed exact_bed(double eccentricity);
/// The same from the equilibrium of the joint with `points` a side.
Bed computed_bed(double eccentricity, int points);

/// Moment about its normal at which a square joint under uniform pressure p slides, over the exact one:
/// μ p ∫ r dA = μ p a³ (√2 + ln(1 + √2)) / 6. Found by raising a couple on a block.
double torsion_capacity(int points);

// --- Collapse multipliers ---

constexpr double oppenheim_rigid = 0.373612;  // flat-faced voussoirs, least of all four-hinge mechanisms
/// Multiplier of gravity, sideways, of the arch of cases/validation/oppenheim.toml.
double arch_multiplier(double kn, int points);

constexpr double slab_width = 1.0, slab_height = 4.0;  // m; tips at their quotient
/// Multiplier of gravity, sideways, at which a block of slab_width × slab_height tips.
double slab_multiplier(double kn, int points);
/// First-order loss of that multiplier by a joint of finite stiffness. The block tips when the row of points on the
/// edge, with its share w of the area, bears all of the weight W: it has sunk by W/(w kn A), and the next row, at g
/// times the width from it, just opens. The block then leans by θ = W/(w g kn A b), and λ = tan(α − θ), tan α = B/H:
/// a loss of (1 + tan² α) θ.
double slab_loss(double kn, int points);
/// The same for a face that is elastic everywhere. Contact length c at a lean θ: W = kn d θ c²/2, so that, with
/// k = 1 + tan² α, λ = B/H − 2c/(3H) − k θ. It is largest at θ = (√(2W/(kn d)) / (3 k H))^(2/3): B/H − 3 k θ.
double slab_loss_of_an_elastic_face(double kn);

// --- Rocking ---

/// Quarter of the cycle of free rocking of a block (m) let go at a tilt (rad), by quadrature, s (Housner 1963).
double exact_rocking_quarter(double width, double height, double start);
/// The same from half of α, 0.6 × 2.4 m.
double exact_rocking_quarter();
/// That again, computed: time from rest to the change of sign of the tilt, with steps of 2e-6 s. Without `reclip` the
/// joint keeps the polygon and the memory it was made with, however far the block turns.
double rocking_quarter(double kn, bool reclip);

// --- Steps ---

/// One bonded block let go out of balance along the normal of its joint.
struct LetGo {
  double exact = 0.0;         // rad/s, √(kn A / m)
  double dt = 0.0;            // s
  double frequency = 0.0;     // rad/s, of the steps
  double displacement = 0.0;  // after 1¼ cycles, share of the start
  double expected = 0.0;      // of the exact motion at that time
};
/// `share` of the critical step.
LetGo let_go(double share);

/// A motion under a pulse of the base: displacement of the top (mean of its blocks) relative to the base at 41 times,
/// m, and the worst error of the energy balance. Steps are `share` of the critical one or a little less, so that halved
/// shares give halved steps.
struct PulseResponse {
  double dt = 0.0;  // s
  std::vector<double> displacement;
  double worst_balance = 0.0;  // share of the largest term
};
/// Ten bonded blocks under a smooth pulse of the base: nothing breaks.
PulseResponse column_response(double share);
/// A dry block that uplifts and lands under such a pulse.
PulseResponse rocking_response(double share);
/// A dry wall of 4 × 4 blocks that opens and slides under such a pulse, `scale` times as strong.
PulseResponse wall_response(double share, double scale = 1.0);
/// Largest absolute displacement, m.
double peak(const PulseResponse& response);
/// Largest difference from a reference at any of the times, over the reference's peak.
double difference(const PulseResponse& response, const PulseResponse& reference);

// --- Load rate ---

struct Push {
  double peak = 0.0;  // N, largest reaction of the beam
  double end = 0.0;   // N, at the end of the stroke
};
/// A dry wall of 5 × 9 blocks, 0.2 × 0.1 × 0.2 m, under a beam with 100 kN that stays level and is driven 10 mm along
/// the wall within `duration` (s); `local` damping coefficient, 0: none.
Push push_wall(double duration, double local);

}  // namespace voussoir
