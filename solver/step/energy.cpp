#include "solver/step/energy.h"

namespace voussoir {

namespace {

/// What the patches of batches [begin, end) have lost, and the work done on their branches.
void add_losses(const PatchMemory& memory, std::size_t begin, std::size_t end, Energies& e) {
  for (std::size_t batch = begin; batch < end; ++batch)
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      e.friction += memory.energy[energy_index({batch, lane}, 0)];
      e.fracture += memory.energy[energy_index({batch, lane}, 1)];
      e.joint_damping += memory.energy[energy_index({batch, lane}, 2)];
    }
}

void add_body(const Stepper& stepper, const BodyPass& pass, std::size_t i, Energies& e) {
  const Body& body = stepper.model->bodies[i];
  const double* motion = &stepper.state->motion[motion_width * i];
  const double* pose = &stepper.state->pose[pose_width * i];
  e.external_work += motion[6];
  e.body_damping += motion[7];
  const BodyUpdate next = pass.update(i);
  // The half step that leads up to now; the other half is added with the step itself.
  for (int c = 0; c < 3; ++c)
    if (body.held(c)) e.external_work -= 0.5 * pass.dt * next.force[c] * motion[c];
  if (body.still()) return;
  e.body_damping += 0.5 * next.loss;
  if (pass.loads) e.external_work += load_work(pass, i, next, triple(motion), triple(motion + 3));
  // ½ v⁻·M v⁺: with this product, not with the square of the mean, the leapfrog keeps the energy of a linear system
  // exactly.
  const Triple<double> before = turn_back(pose_rotation(pose), triple(motion + 3));
  const Triple<double> after = turn_back(pose_rotation(pose), next.momentum);
  for (int c = 0; c < 3; ++c) {
    if (body.held(c)) continue;
    e.kinetic += 0.5 * body.inertial_mass * motion[c] * next.velocity[c];
    e.gravitational -= body.mass * stepper.model->gravity[c] * pose[c];
  }
  e.kinetic += 0.5 * Vec3(before.x, before.y, before.z).dot(body.inverse_inertia * Vec3(after.x, after.y, after.z));
}

}  // namespace

const std::vector<std::pair<const char*, double Energies::*>>& energy_terms() {
  static const std::vector<std::pair<const char*, double Energies::*>> terms = {
      {"kinetic", &Energies::kinetic},
      {"gravitational", &Energies::gravitational},
      {"elastic", &Energies::elastic},
      {"damping_springs", &Energies::damping_springs},
      {"friction", &Energies::friction},
      {"fracture", &Energies::fracture},
      {"plastic", &Energies::plastic},
      {"joint_damping", &Energies::joint_damping},
      {"body_damping", &Energies::body_damping},
      {"clipping", &Energies::clipping},
      {"external_work", &Energies::external_work}};
  return terms;
}

Energies energies_of_tile(const Stepper& stepper, const BodyPass& pass, std::size_t index) {
  const Model& model = *stepper.model;
  const State& state = *stepper.state;
  const Tile& tile = model.tiles[index];
  Energies e;
  e.elastic = stepper.tile_energies[index].elastic;
  e.damping_springs = stepper.tile_energies[index].branches;
  const auto add_patch = [&](std::size_t i) {
    const PatchEnergy patch = patch_energy(model, state, stepper.damping.branches, i);
    e.elastic += patch.elastic;
    e.damping_springs += patch.branches;
  };
  for (std::int32_t i = tile.first_joint; i < tile.end_joint; ++i)
    if (!in_tile_energy(model, state, std::size_t(i))) add_patch(std::size_t(i));

  e.external_work += state.support_work[index];
  for (std::int32_t i = tile.first_body; i < tile.end_body; ++i) add_body(stepper, pass, std::size_t(i), e);
  const std::vector<std::int32_t>& of_interface = state.interface.first_batch;
  add_losses(state.interface_memory, std::size_t(of_interface[index]), std::size_t(of_interface[index + 1]), e);
  add_losses(state.joint, std::size_t(tile.first_batch), std::size_t(tile.end_batch), e);
  for (std::int32_t i = stepper.first_contact_batch[index]; i < stepper.first_contact_batch[index + 1]; ++i) {
    const auto batch = std::size_t(stepper.contact_batches[std::size_t(i)]);
    add_losses(state.contact, batch, batch + 1, e);
  }
  for (int lane = 0; lane < lane_count; ++lane)
    e.joint_damping += state.branch_work[lane_count * index + std::size_t(lane)];
  return e;
}

Energies energies_of_fill(const FillPass& pass, std::size_t tile) {
  const FillTile& t = pass.fill->tiles[tile];
  const double* lost = &pass.memory->lost[4 * tile];
  Energies e;
  e.elastic = pass.energies[tile].elastic;
  e.damping_springs = pass.energies[tile].branches;
  e.plastic = lost[0], e.joint_damping = lost[1], e.external_work = lost[2], e.body_damping = lost[3];
  for (auto node = std::size_t(t.first_node); node < std::size_t(t.end_node); ++node) {
    const NodeUpdate next = pass.update(node);
    const double *v = &pass.memory->motion[node_width * node], *u = &pass.memory->pose[node_width * node];
    if (pass.loaded) e.external_work += pass.load_work(node, load_quad(v));
    for (int c = 0; c < 3; ++c) {
      // As for bodies: ½ v⁻ M v⁺, and of what is held the half step that leads up to now.
      if (pass.fill->held[node] >> c & 1)
        e.external_work -= 0.5 * pass.dt * next.force[c] * v[c];
      else
        e.kinetic += 0.5 * pass.fill->inertial[node] * v[c] * next.velocity[c];
      e.gravitational -= pass.fill->mass[node] * pass.gravity[c] * u[c];
    }
  }
  return e;
}

Energies compute_energies(const Stepper& stepper, const BodyPass& pass) {
  const State& state = *stepper.state;
  const std::size_t tiles = stepper.model->tiles.size(), all = tiles + stepper.model->fill.tiles.size();
  Energies e;
  if (pass.energies) {
    for (std::size_t tile = 0; tile < all; ++tile) e.add((*pass.energies)[tile]);
  } else {
    FillPass fill = stepper.fill_pass();
    fill.energies = stepper.fill_energies.data();
    stepper.load_fill(fill, pass.load_share);
    for (std::size_t tile = 0; tile < tiles; ++tile) e.add(energies_of_tile(stepper, pass, tile));
    for (std::size_t tile = tiles; tile < all; ++tile) e.add(energies_of_fill(fill, tile - tiles));
  }
  e.friction += state.retired_energy()[0];
  e.fracture += state.retired_energy()[1];
  e.joint_damping += state.retired_energy()[2];
  e.joint_damping -= e.damping_springs;  // of the work done on the branches, what their springs do not hold is lost
  e.clipping = state.clipped_energy();
  return e;
}

}  // namespace voussoir
