// Nodes of the fill: means of the volumetric strain about them, and their motion.
#include <algorithm>

#include "solver/fill/fill_pass.h"

namespace voussoir {

void FillPass::means(std::size_t tile) const {
  if (!averaged) return;
  const FillTile& t = fill->tiles[tile];
  for (std::int32_t node = t.first_node; node < t.end_node; ++node) {
    double sum = 0.0;
    for (std::int32_t i = fill->first_sum[std::size_t(node)]; i < fill->first_sum[std::size_t(node) + 1]; ++i)
      sum += volume_sums[fill->sums[std::size_t(i)]];
    memory->pose[node_width * std::size_t(node) + 3] = sum / fill->weight[std::size_t(node)];
  }
}

namespace {

void put(const Quad& q, double* to) {
  std::memcpy(to, &q, sizeof(q));
}
double dot3(const Quad& a, const Quad& b) {
  const Quad c = a * b;
  return c[0] + c[1] + c[2];
}

double sign(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

}  // namespace

Quad FillPass::load(std::size_t node) const {
  const Vec3& a = load_acceleration;
  Quad force = fill->mass[node] * Quad{a.x(), a.y(), a.z(), 0.0};
  if (loads_from)
    force += (1.0 - load_share) * load_quad(loads_from + node_width * node) +
             load_share * load_quad(loads_to + node_width * node);
  return force;
}

double FillPass::load_work(std::size_t node, const Quad& velocity) const {
  return 0.5 * dt * dot3(load(node), velocity);
}

NodeUpdate FillPass::update(std::size_t node) const {
  NodeUpdate next;
  Quad force = fill->mass[node] * Quad{gravity.x(), gravity.y(), gravity.z(), 0.0};
  for (std::int32_t i = fill->first_sum[node]; i < fill->first_sum[node + 1]; ++i)
    force += load_quad(sums + node_width * std::size_t(fill->sums[std::size_t(i)]));
  if (outside)
    for (std::int32_t i = (*first_of_node)[node]; i < (*first_of_node)[node + 1]; ++i)
      force += load_quad(outside + node_width * std::size_t((*of_node)[std::size_t(i)]));
  if (loaded) force += load(node);
  next.force = force;
  const Quad before = load_quad(&memory->motion[node_width * node]);
  if (local > 0.0)  // Cundall: a share of the force, against the velocity
    for (int c = 0; c < 3; ++c) force[c] -= local * std::abs(force[c]) * sign(before[c]);
  const double rate = 0.5 * mass_rate * dt;
  Quad pulled = (1.0 - rate) * before + (dt / fill->inertial[node]) * force;
  if (rate > 0.0)  // as for stones, the velocity relative to the ground's is damped
    pulled += (2.0 * rate) * Quad{base_velocity.x(), base_velocity.y(), base_velocity.z(), 0.0};
  next.velocity = (1.0 / (1.0 + rate)) * pulled;
  if (fill->held[node])
    for (int c = 0; c < 3; ++c)
      if (fill->held[node] >> c & 1) next.velocity[c] = before[c];
  next.velocity[3] = 0.0;
  return next;
}

namespace {

/// Work taken by held nodes and by damping of nodes in a step, J.
void count_losses(const FillPass& pass, std::size_t node, const NodeUpdate& next, double* lost) {
  const double* v = &pass.memory->motion[node_width * node];
  for (int c = 0; c < 3; ++c) {
    const double mean = 0.5 * (v[c] + next.velocity[c]);
    if (pass.fill->held[node] >> c & 1)
      lost[2] -= pass.dt * next.force[c] * mean;
    else
      lost[3] += mean * (pass.dt * next.force[c] - pass.fill->inertial[node] * (next.velocity[c] - v[c]));
  }
}

}  // namespace

/// The sums of a node lie apart, and so do forces from outside: those on a node to come are asked for before it is.
void FillPass::fetch_forces(std::size_t node) const {
  if (node >= fill->nodes.size()) return;
  for (std::int32_t i = fill->first_sum[node]; i < fill->first_sum[node + 1]; ++i)
    __builtin_prefetch(sums + node_width * std::size_t(fill->sums[std::size_t(i)]));
  if (!outside) return;
  for (std::int32_t i = (*first_of_node)[node]; i < (*first_of_node)[node + 1]; ++i)
    __builtin_prefetch(outside + node_width * std::size_t((*of_node)[std::size_t(i)]));
}

FillReport FillPass::nodes(std::size_t tile) const {
  using Floats = float __attribute__((vector_size(16)));
  constexpr double past_sense = 1000.0;  // m/s
  const FillTile& t = fill->tiles[tile];
  const bool damped = mass_rate > 0.0 || local > 0.0;
  const Quad base = {base_displacement.x(), base_displacement.y(), base_displacement.z(), 0.0};
  FillReport report;
  for (std::int32_t i = t.first_node; i < t.end_node; ++i) {
    const auto node = std::size_t(i);
    fetch_forces(node + 4);
    const NodeUpdate next = update(node);
    if (damped || fill->held[node]) count_losses(*this, node, next, &memory->lost[4 * tile]);
    if (loaded)
      memory->lost[4 * tile + 2] += load_work(node, load_quad(&memory->motion[node_width * node]) + next.velocity);
    double* u = &memory->pose[node_width * node];
    const Quad moved = load_quad(u) + dt * next.velocity;
    put(next.velocity, &memory->motion[node_width * node]);
    put(moved, u);
    Floats from;
    std::memcpy(&from, &memory->searched[node_width * node], sizeof(from));
    const Quad far = moved - base - __builtin_convertvector(from, Quad);
    report.search |= dot3(far, far) > search_distance * search_distance;
    const bool runs = !(dot3(next.velocity, next.velocity) < past_sense * past_sense);
    if (runs && (report.runaway < 0 || fill->mesh_node[node] < report.runaway)) report.runaway = fill->mesh_node[node];
  }
  return report;
}

}  // namespace voussoir
