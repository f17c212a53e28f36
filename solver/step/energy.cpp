#include "solver/step/energy.h"

namespace voussoir {

namespace {

PatchEnergy intact_energy(const Model& model, const State& state, const Branches& branches, std::size_t index) {
  const Patch& patch = model.joints[index];
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  const auto batch = std::size_t(patch.batch), lane = std::size_t(patch.lane);
  const double* slip = &state.slip[3 * lane_count * batch + lane];
  const double u[6] = {j.n, j.s - slip[0], j.t - slip[lane_count], j.rn - slip[2 * lane_count], j.rs, j.rt};
  if (state.joint.mode[index] & mode_broken) {  // wholly open patches carry nothing
    bool open = true;
    for (int c = 0; c < patch.corner_count; ++c) {
      const PatchPoint corner = patch_corner(patch, model.corners, c);
      open &= u[0] + u[4] * corner.t - u[5] * corner.s >= 0.0;
    }
    if (open) return {};
  }
  const double k[6] = {patch.kn * patch.area, patch.ks * patch.area,
                       patch.ks * patch.area, patch.ks * (patch.ss + patch.tt),
                       patch.kn * patch.tt,   patch.kn * patch.ss};
  PatchEnergy e;
  for (int c = 0; c < 6; ++c) {
    e.elastic += 0.5 * k[c] * u[c] * u[c];
    for (int b = 0; b < branches.count; ++b) {
      const double q = state.branch[branch_index(branches.count, batch, c, b) + lane];
      e.branches += 0.5 * k[c] * branches.stored[b] * q * q;
    }
  }
  return e;
}

PatchEnergy points_energy(const Model& model, bool yielding, const Patch& patch, const Array<double>& points,
                          const PatchMemory& memory, const State& state, const Branches& branches) {
  const Jump<double> j = patch_jump(patch, &state.pose[pose_width * patch.a], &state.pose[pose_width * patch.b]);
  PatchEnergy e;
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Triple<double> u = elastic_jump(patch, j, point, memory, i);
    double x[3] = {u.x, u.y, u.z};
    if (memory.broken[point_index(patch, i, 1, 0)]) {
      if (x[0] >= 0.0) continue;
      const LawConstants& law = model.laws[patch.law];
      const double limit = law.residual_cohesion - patch.kn * u.x * law.residual_tan_friction;
      const double shear = patch.ks * std::hypot(u.y, u.z);
      if (yielding && law.kind != JointLaw::Kind::elastic && shear > limit)
        x[1] *= limit / shear, x[2] *= limit / shear;
    }
    for (int c = 0; c < 3; ++c) {
      const double k = point.weight * (c == 0 ? patch.kn : patch.ks);
      e.elastic += 0.5 * k * x[c] * x[c];
      for (int b = 0; b < branches.count; ++b) {
        const double q = memory.point_branch[point_index(patch, i, 3 * branches.count, 3 * b + c)];
        e.branches += 0.5 * k * branches.stored[b] * q * q;
      }
    }
  }
  return e;
}

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
    if (body.held(c)) e.external_work -= 0.5 * pass.dt * (&next.force.x)[c] * motion[c];
  if (body.still()) return;
  e.body_damping += 0.5 * next.loss;
  if (pass.loads) e.external_work += load_work(pass, i, next, triple(motion), triple(motion + 3));
  // ½ v⁻·M v⁺: with this product, not with the square of the mean, the leapfrog keeps the energy of a linear system
  // exactly.
  const Triple<double> before = turn_back(pose_rotation(pose), triple(motion + 3));
  const Triple<double> after = turn_back(pose_rotation(pose), next.momentum);
  for (int c = 0; c < 3; ++c) {
    if (body.held(c)) continue;
    e.kinetic += 0.5 * body.inertial_mass * motion[c] * (&next.velocity.x)[c];
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

PatchEnergy patch_energy(const Model& model, const State& state, const Branches& branches, std::size_t index,
                         bool yielding) {
  if (index >= model.joints.size() && !state.has_contact(index - model.joints.size())) return {};
  if (index >= model.joints.size())
    return points_energy(model, yielding, state.contacts[index - model.joints.size()], state.contact_points,
                         state.contact, state, branches);
  const std::uint8_t mode = state.joint.mode[index];
  if (mode & mode_gone) return {};
  if (mode & mode_points)
    return points_energy(model, yielding, model.joints[index], model.points, state.joint, state, branches);
  return intact_energy(model, state, branches, index);
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
