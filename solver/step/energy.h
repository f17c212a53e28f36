// The energy balance in joules. The external work equals the stored plus the dissipated energy; otherwise the results
// of the run are not valid.
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
  double clipping = 0.0;         // elastic energy removed (negative: added) when patches were clipped again
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

/// Every term of the energy balance with its name, in the order above.
const std::vector<std::pair<const char*, double Energies::*>>& energy_terms();

/// Call at a sampling point of the time step or after patches_only(): positions and patches are at this time step, and
/// `pass` contains the next velocities.
Energies compute_energies(const Stepper& stepper, const BodyPass& pass);
/// The energies of one tile: of its joints, contacts and bodies.
Energies energies_of_tile(const Stepper& stepper, const BodyPass& pass, std::size_t tile);
/// The energies of one tile of the fill.
Energies energies_of_fill(const FillPass& pass, std::size_t tile);

}  // namespace voussoir
