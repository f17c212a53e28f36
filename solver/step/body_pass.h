// The update of the bodies in a time step. Each body sums the joint wrenches of its tiles, tile by tile, then the
// wrenches of its contacts in ascending order, and moves immediately. Free bodies are computed eight side by side.
//
// Leapfrog: the velocity v and the angular momentum L are known at half steps. With F the force and T the moment on the
// body, v⁺ = v⁻ + dt (F/m + g), L⁺ = L⁻ + dt T in the spatial frame; ω = R Ib⁻¹ Rᵀ L at the half step from a predicted
// half rotation (Fincham 1992), the quaternion by the exponential map.
#pragma once
#include "solver/contact/patch_kernel.h"
#include "solver/step/loads.h"

namespace voussoir {

/// Contacts of each body in ascending order: 2 × index, plus 1 if the body is the second one of the contact. Patches of
/// the interface with the fill follow; their numbers come after the slots of the contacts.
struct Incidence {
  std::vector<std::int32_t> first;  // per body, and one past the end
  std::vector<std::int32_t> contacts;
};
Incidence find_incidence(const Model& model, const State& state);

/// Constants of eight consecutive bodies, without those that the ground or a guide holds.
struct alignas(64) BodyBatch {
  Lanes centroid[3], mass, inertial_mass, radius;
  Lanes inverse_inertia[6];  // xx, yy, zz, xy, xz, yz
  Lanes free;                // 1 for a free body, else 0; not a mask, so that the layout is the same for all processors
  [[gnu::always_inline]] LaneMask are_free() const { return less(splat(0.0), free); }
};
Array<BodyBatch> make_body_batches(const Model& model);

/// Out-of-balance force and moment about the centroid (gravity and loads included), and the velocities that follow.
struct BodyUpdate {
  Triple<double> force, moment;                              // N, N m, of the patches, gravity and loads
  Triple<double> velocity;                                   // m/s at the next half step
  Triple<double> momentum;                                   // kg m2/s at the next half step
  double loss = 0.0;                                         // J, body damping over this time step
  Triple<double> load = {0, 0, 0}, load_moment = {0, 0, 0};  // part of the loads in force and moment
};

struct BodyReport {
  // If displacements were checked: largest displacement of a body since its position was noted, and largest
  // displacement in one time step, m.
  double farthest = 0.0, fastest = 0.0;
  std::int32_t runaway = -1;  // lowest body whose velocity is not finite or exceeds the limit
  void merge(const BodyReport& other) {
    farthest = std::max(farthest, other.farthest);
    fastest = std::max(fastest, other.fastest);
    if (other.runaway >= 0 && (runaway < 0 || other.runaway < runaway)) runaway = other.runaway;
  }
};

struct Energies;

/// Positions of the bodies Model::still at one time step, and velocities at the half step before; rows as State::pose
/// and State::motion.
struct StillPlaces {
  Array<double> pose, motion;
};

struct BodyPass {
  const Model* model = nullptr;
  State* state = nullptr;
  const std::vector<std::int32_t>*first_sum = nullptr, *sum_places = nullptr;  // as Model::first_sum and sums
  const double* sums = nullptr;                                                // see PatchPass
  const Incidence* incidence = nullptr;
  const double* contact_wrenches = nullptr;
  const BodyBatch* batches = nullptr;
  const std::vector<Energies>* energies = nullptr;  // of each tile, if they were computed in advance for a sample
  double dt = 0.0;                                  // s
  double mass_rate = 0.0;                           // 1/s, Rayleigh
  double local = 0.0;                               // coefficient of local damping (Cundall)
  bool looks = false;                               // whether displacements are checked at the end of the time step,
                                                    // see BodyReport
  const Array<std::int32_t>* drive = nullptr;       // of each body: index in drive_velocity, or -1; empty: none
  std::vector<Vec3> drive_velocity;                 // m/s, relative to the ground, at the next half step
  const LoadsAtWork* loads = nullptr;               // none: only gravity acts
  double load_share = 1.0;                          // at this time step
  Vec3 base_velocity_now = Vec3::Zero();            // m/s, at the last half step
  Vec3 base_velocity_next = Vec3::Zero();           // m/s, at the next half step
  Vec3 base_displacement_next = Vec3::Zero();       // m, at the next time step
  // Of Model::still at the next time step and half step; none: the bodies of the state are moved one by one.
  const StillPlaces *still_now = nullptr, *still_next = nullptr;

  /// Velocity (m/s) of a fixed body at the next half step.
  Vec3 prescribed_velocity(std::size_t body) const {
    const std::int32_t which = drive->empty() ? -1 : (*drive)[body];
    return which < 0 ? base_velocity_next : base_velocity_next + drive_velocity[std::size_t(which)];
  }
  BodyUpdate update(std::size_t body) const;
  void turn(std::size_t body, Triple<double> moment, BodyUpdate& update) const;
  BodyUpdate held_update(std::size_t body, const Triple<double>& patches, const Triple<double>& moment) const;
  /// Work over the time step of the forces that hold or drive the still bodies, on the joints of a tile, J.
  double support_work(const Tile& tile) const;
  /// Moves the bodies [begin, end); `begin` is the first of a batch.
  BodyReport bodies(std::size_t begin, std::size_t end) const;

 private:
  Lanes wrench_sum(std::size_t body) const;
  bool runs_away(std::size_t body, double speed2) const;
  Lanes contact_sum(std::size_t body, Lanes sum) const;
  void move_body(std::size_t body, BodyReport& report) const;
  void move_still(std::size_t body, BodyReport& report) const;
  void fetch_constants(std::size_t first) const;
  void fetch_motion(std::size_t first) const;
  LaneMask move_lanes(std::size_t first, std::size_t end, BodyReport& report) const;
  void look_at(std::size_t body, const BodyUpdate& next, BodyReport& report) const;
};

/// Work over a time step of the forces that hold or drive a still body, J. `force` (N) is the force of the joints on
/// it; velocities (m/s) at both half steps.
double holding_work(const double* force, const double* velocity_now, const double* velocity_next, double dt);

/// Work of the loads on a body over half a time step at this velocity (m/s) and angular momentum (kg m2/s), J.
double load_work(const BodyPass& pass, std::size_t body, const BodyUpdate& next, const Triple<double>& velocity,
                 const Triple<double>& momentum);

}  // namespace voussoir
