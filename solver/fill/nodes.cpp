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

Quad quad(const double* from) {
  Quad q;
  std::memcpy(&q, from, sizeof(q));
  return q;
}

double sign(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

}  // namespace

NodeUpdate FillPass::update(std::size_t node) const {
  NodeUpdate next;
  Quad force = {};
  for (std::int32_t i = fill->first_sum[node]; i < fill->first_sum[node + 1]; ++i)
    force += quad(sums + node_width * std::size_t(fill->sums[std::size_t(i)]));
  if (outside)
    for (std::int32_t i = (*first_of_node)[node]; i < (*first_of_node)[node + 1]; ++i)
      force += quad(outside + node_width * std::size_t((*of_node)[std::size_t(i)]));
  const double weighs = fill->mass[node];
  force += Quad{weighs * gravity.x(), weighs * gravity.y(), weighs * gravity.z(), 0.0};
  next.force = force;
  const Quad before = quad(&memory->motion[node_width * node]);
  const double inertia = fill->inertial[node];
  if (local > 0.0)  // Cundall: a share of the force, against the velocity
    for (int c = 0; c < 3; ++c) force[c] -= local * std::abs(force[c]) * sign(before[c]);
  const double rate = 0.5 * mass_rate * dt;
  next.velocity = ((1.0 - rate) * before + (dt / inertia) * force) / (1.0 + rate);
  for (int c = 0; c < 3; ++c)
    if (fill->held[node] >> c & 1) next.velocity[c] = before[c];
  next.velocity[3] = 0.0;
  return next;
}

FillReport FillPass::nodes(std::size_t tile) const {
  const FillTile& t = fill->tiles[tile];
  FillReport report;
  double* lost = &memory->lost[4 * tile];
  for (std::int32_t i = t.first_node; i < t.end_node; ++i) {
    const auto node = std::size_t(i);
    const NodeUpdate next = update(node);
    double *u = &memory->pose[node_width * node], *v = &memory->motion[node_width * node];
    constexpr double past_sense = 1000.0;  // m/s
    bool runs = false;
    for (int c = 0; c < 3; ++c) {
      const double mean = 0.5 * (v[c] + next.velocity[c]);
      if (fill->held[node] >> c & 1)
        lost[2] -= dt * next.force[c] * mean;
      else if (mass_rate > 0.0 || local > 0.0)
        lost[3] += mean * (dt * next.force[c] - fill->inertial[node] * (next.velocity[c] - v[c]));
      v[c] = next.velocity[c];
      u[c] += dt * v[c];
      runs |= !(std::abs(v[c]) < past_sense);
    }
    const float* from = &memory->searched[node_width * node];
    double far2 = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double far = u[c] - base_displacement[c] - double(from[c]);
      far2 += far * far;
    }
    report.search |= far2 > search_distance * search_distance;
    if (runs && (report.runaway < 0 || fill->mesh_node[node] < report.runaway)) report.runaway = fill->mesh_node[node];
  }
  return report;
}

}  // namespace voussoir
