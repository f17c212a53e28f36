// Second pass of a step: every body adds the wrenches of its patches in ascending patch order and moves at once.
//
// Leapfrog: v and L live at half steps. v⁺ = v⁻ + dt (F/m + g), L⁺ = L⁻ + dt T in the spatial frame; ω = R Ib⁻¹ Rᵀ L at
// the half step from a predicted half rotation (Fincham 1992), the quaternion by the exponential map.
#pragma once
#include "solver/contact/patch_kernel.h"
#include "solver/step/loads.h"

namespace voussoir {

/// Patches of each body in ascending order: 2 × slot, plus 1 where the body is the patch's second one.
struct Incidence {
  std::vector<std::int32_t> first;  // per body, and one past the end
  std::vector<std::int32_t> patches;
};
Incidence find_incidence(const Model& model, const State& state);

/// Out-of-balance force and moment about the centroid (gravity and loads included), and the velocities that follow.
struct BodyUpdate {
  Triple<double> force, moment;                              // N, N m, of the patches, gravity and loads
  Triple<double> velocity;                                   // m/s at the next half step
  Triple<double> momentum;                                   // kg m2/s at the next half step
  double loss = 0.0;                                         // J, body damping over this step
  Triple<double> load = {0, 0, 0}, load_moment = {0, 0, 0};  // the loads' part of force and moment
};

struct BodyReport {
  bool search = false;        // some body has moved far enough for a new search of contacts
  std::int32_t runaway = -1;  // lowest body whose velocity is not finite or past any sense
  void merge(const BodyReport& other) {
    search |= other.search;
    if (other.runaway >= 0 && (runaway < 0 || other.runaway < runaway)) runaway = other.runaway;
  }
};

struct BodyPass {
  const Model* model = nullptr;
  State* state = nullptr;
  const Incidence* incidence = nullptr;
  const double* wrenches = nullptr;
  double dt = 0.0;                             // s
  double mass_rate = 0.0;                      // 1/s, Rayleigh
  double local = 0.0;                          // Cundall
  double search_distance = 1e300;              // m
  const Array<std::int32_t>* drive = nullptr;  // of each body, which of drive_velocity is its own or -1; empty: none
  std::vector<Vec3> drive_velocity;            // relative to the ground, at the next half step
  const LoadsAtWork* loads = nullptr;          // none: nothing beside gravity
  double load_share = 1.0;                     // at this step
  Vec3 base_velocity_now = Vec3::Zero();       // at the last half step
  Vec3 base_velocity_next = Vec3::Zero();      // at the next half step
  Vec3 base_displacement_next = Vec3::Zero();  // at the next step

  /// Of a fixed body at the next half step.
  Vec3 prescribed_velocity(std::size_t body) const {
    const std::int32_t which = drive->empty() ? -1 : (*drive)[body];
    return which < 0 ? base_velocity_next : base_velocity_next + drive_velocity[std::size_t(which)];
  }
  BodyUpdate update(std::size_t body) const;
  void turn(std::size_t body, Triple<double> moment, BodyUpdate& update) const;
  BodyUpdate held_update(std::size_t body, const Triple<double>& patches, const Triple<double>& moment) const;
  BodyReport bodies(std::size_t begin, std::size_t end) const;
};

/// Work of the loads on a body over half a step at this velocity and angular momentum, J.
double load_work(const BodyPass& pass, std::size_t body, const BodyUpdate& next, const Triple<double>& velocity,
                 const Triple<double>& momentum);

}  // namespace voussoir
