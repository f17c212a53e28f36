// The energy ledger, joules. What was put in equals what is stored plus what is lost, or the run is not to be believed.
#pragma once
#include <utility>
#include <vector>

#include "solver/contact/patch_energy.h"
#include "solver/step/stepper.h"

namespace voussoir {

struct Energies {
  double kinetic = 0.0;
  double gravitational = 0.0;    // relative to the reference placement
  double elastic = 0.0;          // in joints, interface and fill
  double damping_springs = 0.0;  // in Maxwell branches
  double friction = 0.0;         // dissipated
  double fracture = 0.0;         // lost with bonds
  double plastic = 0.0;          // dissipated by the fill's flow
  double joint_damping = 0.0;    // dissipated by branches
  double body_damping = 0.0;     // dissipated by local and mass damping
  double clipping = 0.0;         // elastic energy that new clippings of patches took out (or, negative, put in)
  double external_work = 0.0;    // done by the moving ground, driven blocks and loads
  double stored() const { return kinetic + gravitational + elastic + damping_springs; }
  double lost() const { return friction + fracture + plastic + joint_damping + body_damping + clipping; }
  /// stored + lost − external work: constant in exact arithmetic.
  double total() const { return stored() + lost() - external_work; }
  void add(const Energies& e) {
    kinetic += e.kinetic, gravitational += e.gravitational, elastic += e.elastic;
    damping_springs += e.damping_springs, friction += e.friction, fracture += e.fracture;
    plastic += e.plastic;
    joint_damping += e.joint_damping, body_damping += e.body_damping, clipping += e.clipping;
    external_work += e.external_work;
  }
};

/// Every term of the ledger by its name, in the order above.
const std::vector<std::pair<const char*, double Energies::*>>& energy_terms();

/// At a sampling point of the step, or after patches_only(): positions and patches are at this step; `pass` knows the
/// velocities to come.
Energies compute_energies(const Stepper& stepper, const BodyPass& pass);
/// The part of a tile: its joints, its contacts, its bodies.
Energies energies_of_tile(const Stepper& stepper, const BodyPass& pass, std::size_t tile);
/// The part of one of the fill's tiles.
Energies energies_of_fill(const FillPass& pass, std::size_t tile);

}  // namespace voussoir
