// The computations of the convergence studies, each with one specimen and one varied quantity, and their closed forms.
// All of them use the library like a case does. Errors are thrown as RunError.
#pragma once
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

// --- A square joint ---

/// A rigid block on a square bed without tension.
struct Bed {
  double turn = 0.0;     // rad, towards the load
  double sinking = 0.0;  // m, of the middle of the bed; negative if it lifts
};
constexpr double bed_side = 1.0, bed_force = 1e4, bed_kn = 1e10;  // m, N, Pa/m

/// Closed form of an elastic bed without tension under P = bed_force at `eccentricity` (share of the side, below 0.5).
/// Inside the kern the pressure is linear over the whole bed. Outside it the pressure acts over c = 3 (b/2 − e) with
/// the edge pressure 2P/(c d), where b = d = bed_side and e is the eccentricity in m.
Bed exact_bed(double eccentricity);
/// The same from the equilibrium of the joint with `points` integration points per side.
Bed computed_bed(double eccentricity, int points);

/// Moment about its normal at which a square joint under uniform pressure p slides, divided by the exact value μ p ∫ r
/// dA = μ p a³ (√2 + ln(1 + √2)) / 6. A couple on a block is increased until it slides.
double torsion_capacity(int points);

// --- Collapse multipliers ---

constexpr double oppenheim_rigid = 0.373612;  // flat-faced voussoirs, least of all four-hinge mechanisms
/// Horizontal acceleration, as a multiplier of gravity, at collapse of the arch of cases/validation/oppenheim.toml.
double arch_multiplier(double kn, int points);

constexpr double slab_width = 1.0, slab_height = 4.0;  // m; the block tips at their quotient
/// Horizontal acceleration, as a multiplier of gravity, at which a block of slab_width × slab_height tips.
double slab_multiplier(double kn, int points);
/// First-order reduction of that multiplier λ by the finite stiffness of a joint. The block of width B and height H
/// tips when the row of points at the edge, with its share w of the area A, carries the whole weight W. The row has
/// then sunk by W/(w kn A), and the next row, at g times the width from it, just opens. The block leans by θ = W/(w g
/// kn A B), and λ = tan(α − θ), tan α = B/H: a reduction of (1 + tan² α) θ.
double slab_loss(double kn, int points);
/// The same for a face that is elastic everywhere. With the contact length c at a lean θ and the depth d of the block,
/// W = kn d θ c²/2. With k = 1 + tan² α, λ = B/H − 2c/(3H) − k θ. The maximum B/H − 3 k θ is at θ = (√(2W/(kn d)) / (3
/// k H))^(2/3).
double slab_loss_of_an_elastic_face(double kn);

// --- Rocking ---

/// Quarter of the cycle of free rocking of a block (m) released at a tilt (rad), by quadrature, s (Housner 1963).
double exact_rocking_quarter(double width, double height, double start);
/// The same for 0.6 × 2.4 m and a tilt of half of α.
double exact_rocking_quarter();
/// The same, computed: time from rest to the change of sign of the tilt, with time steps of 2e-6 s. Without `reclip`
/// the joint keeps its initial polygon and memory for any rotation of the block.
double rocking_quarter(double kn, bool reclip);

// --- Steps ---

/// One bonded block, released from a displacement along the normal of its joint.
struct LetGo {
  double exact = 0.0;         // rad/s, √(kn A / m)
  double dt = 0.0;            // s
  double frequency = 0.0;     // rad/s, of the time-stepping run
  double displacement = 0.0;  // after 1¼ cycles, share of the initial one
  double expected = 0.0;      // of the exact motion at the same time
};
/// `share` is the time step divided by the critical one.
LetGo let_go(double share);

/// Response to a pulse of the base: displacement of the top (mean of its blocks) relative to the base at 41 times, m,
/// and the largest error of the energy balance. The time step is `share` of the critical one or slightly less, so that
/// half the share gives half the time step.
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
/// Largest difference from a reference at any of the times, divided by the largest displacement of the reference.
double difference(const PulseResponse& response, const PulseResponse& reference);

// --- Load rate ---

struct Push {
  double peak = 0.0;  // N, largest reaction of the beam
  double end = 0.0;   // N, at the end of the stroke
};
/// A dry wall of 5 × 9 blocks, 0.2 × 0.1 × 0.2 m, under a level beam with 100 kN that is driven by 10 mm along the
/// wall within `duration` (s). `local` is the local damping coefficient, 0: none.
Push push_wall(double duration, double local);

}  // namespace voussoir
