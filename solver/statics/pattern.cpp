#include "solver/statics/pattern.h"

#include <algorithm>

namespace voussoir {

namespace {

Vec3 node_force(const Array<double>& nodes, std::size_t i) {
  return nodes.empty() ? Vec3(Vec3::Zero()) : Vec3(&nodes[i]);
}

/// Calls `take` with the difference of each load and the displacement of where it acts; zero without a state.
template <class Take>
void for_each_load(const Model& model, const State* state, const LoadsAtWork& pattern, const Take& take) {
  const auto centre = [&](std::size_t i) { return state ? Vec3(&state->pose[pose_width * i]) : Vec3(Vec3::Zero()); };
  const auto node = [&](std::size_t i) { return state ? Vec3(&state->fill.pose[i]) : Vec3(Vec3::Zero()); };
  const auto turned = [&](std::size_t i, const Vec3& arm) {
    return state ? Vec3(rotation_of(*state, i) * arm - arm) : Vec3(Vec3::Zero());
  };
  const Vec3 a = pattern.acceleration_to - pattern.acceleration_from;
  if (!a.isZero(0.0)) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      if (!model.bodies[i].still()) take(model.bodies[i].mass * a, centre(i));
    for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) take(model.fill.mass[i] * a, node(node_width * i));
  }
  for (const PointLoad& p : pattern.points) {
    const auto i = std::size_t(p.body);
    take(p.to - p.from, centre(i) + turned(i, p.arm));
  }
  for (std::size_t i = 0; i < std::max(pattern.nodes_from.size(), pattern.nodes_to.size()); i += node_width)
    take(node_force(pattern.nodes_to, i) - node_force(pattern.nodes_from, i), node(i));
}

}  // namespace

LoadsAtWork one_a_point(LoadsAtWork loads) {
  std::vector<PointLoad> merged;
  std::size_t first_of_body = 0;
  for (const PointLoad& p : loads.points) {
    if (!merged.empty() && merged.back().body != p.body) first_of_body = merged.size();
    const auto same = std::find_if(merged.begin() + std::ptrdiff_t(first_of_body), merged.end(),
                                   [&](const PointLoad& q) { return q.arm == p.arm; });
    if (same == merged.end())
      merged.push_back(p);
    else
      same->from += p.from, same->to += p.to;
  }
  loads.points = std::move(merged);
  if (loads.first.empty()) return loads;
  std::fill(loads.first.begin(), loads.first.end(), 0);
  for (const PointLoad& p : loads.points) ++loads.first[std::size_t(p.body) + 1];
  for (std::size_t i = 1; i < loads.first.size(); ++i) loads.first[i] += loads.first[i - 1];
  return loads;
}

LoadsAtWork pattern_between(const LoadsAtWork& before, const LoadsAtWork& after) {
  LoadsAtWork both = after;
  both.acceleration_from = before.acceleration_to;
  for (PointLoad& p : both.points) p.from = Vec3::Zero();
  for (PointLoad p : before.points) {
    p.from = p.to, p.to = Vec3::Zero();
    both.points.push_back(p);
  }
  std::stable_sort(both.points.begin(), both.points.end(),
                   [](const PointLoad& a, const PointLoad& b) { return a.body < b.body; });
  both.first = after.first.empty() ? before.first : after.first;
  both.nodes_from = before.nodes_to;
  return one_a_point(std::move(both));
}

LoadsAtWork at_share(LoadsAtWork loads, double share) {
  const LoadsAtWork pattern = loads;
  for (Array<double>* nodes : {&loads.nodes_from, &loads.nodes_to})
    nodes->resize(std::max(pattern.nodes_from.size(), pattern.nodes_to.size()), 0.0);
  set_share(pattern, share, loads);
  return loads;
}

void set_share(const LoadsAtWork& pattern, double share, LoadsAtWork& loads) {
  const auto between = [share](const auto& from, const auto& to) -> Vec3 { return (1.0 - share) * from + share * to; };
  loads.acceleration_to = between(pattern.acceleration_from, pattern.acceleration_to);
  for (std::size_t i = 0; i < loads.points.size(); ++i)
    loads.points[i].to = between(pattern.points[i].from, pattern.points[i].to);
  for (std::size_t i = 0; i < loads.nodes_to.size(); i += node_width)
    Eigen::Map<Vec3>(&loads.nodes_to[i]) = between(node_force(pattern.nodes_from, i), node_force(pattern.nodes_to, i));
}

double pattern_force(const Model& model, const LoadsAtWork& pattern) {
  double sum = 0.0;
  for_each_load(model, nullptr, pattern, [&](const Vec3& force, const Vec3&) { sum += force.norm(); });
  return sum;
}

double pattern_displacement(const Model& model, const State& state, const LoadsAtWork& pattern) {
  double work = 0.0, force = 0.0;
  for_each_load(model, &state, pattern, [&](const Vec3& f, const Vec3& u) { work += f.dot(u), force += f.norm(); });
  return force > 0.0 ? work / force : 0.0;
}

Eigen::VectorXd pattern_vector(const Model& model, const State& state, const Unknowns& unknowns,
                               const LoadsAtWork& pattern) {
  std::vector<Vector6> at(model.sites(), Vector6::Zero());
  const Vec3 a = pattern.acceleration_to - pattern.acceleration_from;
  const std::size_t bodies = model.bodies.size();
  for (std::size_t i = 0; i < bodies; ++i) at[i].head<3>() = model.bodies[i].mass * a;
  for (const PointLoad& p : pattern.points) {
    const Vec3 force = p.to - p.from, arm = rotation_of(state, std::size_t(p.body)) * p.arm;
    at[std::size_t(p.body)].head<3>() += force;
    at[std::size_t(p.body)].tail<3>() += arm.cross(force);
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    at[bodies + i].head<3>() = model.fill.mass[i] * a + node_force(pattern.nodes_to, node_width * i) -
                               node_force(pattern.nodes_from, node_width * i);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(unknowns.count);
  for (std::size_t i = 0; i < at.size(); ++i)
    if (unknowns.any(i)) set_part(all, unknowns, i, at[i]);
  return all;
}

std::vector<char> bodies_loaded(const Model& model, const LoadsAtWork& pattern) {
  if (pattern.acceleration_from != pattern.acceleration_to) return {};
  std::vector<char> loaded(model.bodies.size(), 0);
  bool any = !pattern.nodes_to.empty() || !pattern.nodes_from.empty();
  for (const PointLoad& p : pattern.points)
    if (p.to != p.from) loaded[std::size_t(p.body)] = 1, any = true;
  return any ? loaded : std::vector<char>{};
}

}  // namespace voussoir
