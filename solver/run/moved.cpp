#include "solver/run/moved.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/constants.h"
#include "solver/contact/jump.h"
#include "solver/run/runaway.h"
#include "solver/statics/collapse.h"

namespace voussoir {

namespace {

constexpr double far_share = 0.05;           // of the smaller stone's size
constexpr double far_turn = 3.0 * pi / 180;  // rad

/// Of one body between two placements.
struct Way {
  Vec3 displacement = Vec3::Zero();  // m, of the centroid
  double turn = 0.0;                 // rad
};

Way way_of(const Array<double>& from, const Array<double>& to, std::size_t body) {
  const double *p = &from[pose_width * body], *q = &to[pose_width * body];
  const Eigen::Quaterniond before(p[3], p[4], p[5], p[6]), after(q[3], q[4], q[5], q[6]);
  return {Vec3(q) - Vec3(p), before.angularDistance(after)};
}

/// Cube root of the volume, m.
std::vector<double> sizes_of(const Assembly& assembly, const Model& model) {
  std::vector<double> sizes(model.bodies.size(), 0.0);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = std::cbrt(mass_properties(assembly.blocks[std::size_t(model.block_of_body[i])].cells).volume);
  }
  return sizes;
}

/// How the faces of a patch have moved against each other: at its centroid (m), and turned (rad). `from` none: since it
/// was made.
Way between_faces(const Patch& patch, const Array<double>* from, const Array<double>& to) {
  const auto jump = [&](const Array<double>& pose) {
    return patch_jump(patch, &pose[pose_width * std::size_t(patch.a)], &pose[pose_width * std::size_t(patch.b)]);
  };
  const Jump<double> x = from ? jump(*from) : Jump<double>{}, y = jump(to);
  return {Vec3(y.n - x.n, y.s - x.s, y.t - x.t), Vec3(y.rn - x.rn, y.rs - x.rs, y.rt - x.rt).norm()};
}

std::string direction_words(const Vec3& u) {
  static constexpr const char* words[3][2] = {{"along −x", "along +x"}, {"along −y", "along +y"}, {"down", "up"}};
  std::string text;
  for (int c : {2, 0, 1})
    if (std::abs(u[c]) > 0.3 * u.norm()) text += (text.empty() ? "" : " and ") + std::string(words[c][u[c] > 0.0]);
  return text;
}

std::string joints_text(const std::vector<MechanismJoint>& mechanism, std::int64_t block) {
  std::string text;
  int named = 0;
  for (const MechanismJoint& joint : mechanism) {
    if ((joint.a != block && joint.b != block) || named++ >= 4) continue;
    text += fmt::format("{} {} block {}", text.empty() ? ";" : ",", joint.slides ? "slides on" : "hinges on",
                        joint.a == block ? joint.b : joint.a);
  }
  return text;
}

}  // namespace

Standing standing_of(const State& state) {
  Standing standing;
  standing.pose = state.pose, standing.joint_mode = state.joint.mode;
  for (std::size_t i = 0; i < state.contacts.size(); ++i)
    if (state.has_contact(i) && !(state.contact.mode[i] & mode_open)) standing.contacts.push_back(state.contacts[i]);
  return standing;
}

std::vector<std::int32_t> moved_away(const Assembly& assembly, const Model& model, const Standing& before,
                                     const State& after) {
  const std::vector<double> sizes = sizes_of(assembly, model);
  std::vector<std::uint8_t> touched(model.bodies.size(), 0), gone(model.bodies.size(), 0);
  std::vector<Way> ways;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) ways.push_back(way_of(before.pose, after.pose, i));
  const auto reach = [&](std::size_t body) { return body_displacement(model, before.pose, after.pose, body); };
  const auto is_far = [](const Way& way, double size) {
    return way.displacement.norm() > far_share * size || way.turn > far_turn;
  };
  const auto look = [&](const Patch& patch) {
    const auto a = std::size_t(patch.a), b = std::size_t(patch.b);
    touched[a] = touched[b] = 1;
    const double size = model.bodies[a].fixed   ? sizes[b]
                        : model.bodies[b].fixed ? sizes[a]
                                                : std::min(sizes[a], sizes[b]);
    if (!is_far(between_faces(patch, before.drawn ? &before.pose : nullptr, after.pose), size)) return;
    const bool first = reach(a) > reach(b);
    gone[first ? a : b] = 1;
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (!(before.joint_mode[i] & mode_gone) && model.joints[i].length == 0.0) look(model.joints[i]);
  for (const Patch& patch : before.contacts) look(patch);
  std::vector<std::int32_t> bodies;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (model.bodies[i].fixed) continue;
    if (gone[i] || (!touched[i] && is_far(ways[i], sizes[i]))) bodies.push_back(std::int32_t(i));
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](std::int32_t a, std::int32_t b) { return reach(std::size_t(a)) > reach(std::size_t(b)); });
  return bodies;
}

std::vector<std::int32_t> farthest_moved(const Model& model, const Array<double>& from, const State& to,
                                         std::size_t count) {
  std::vector<double> reach(model.bodies.size(), 0.0);
  std::vector<std::int32_t> bodies;
  for (std::size_t i = 0; i < reach.size(); ++i) {
    if (model.bodies[i].fixed) continue;
    reach[i] = body_displacement(model, from, to.pose, i);
    if (reach[i] > 0.0) bodies.push_back(std::int32_t(i));
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](std::int32_t a, std::int32_t b) { return reach[std::size_t(a)] > reach[std::size_t(b)]; });
  while (!bodies.empty() &&
         (bodies.size() > count || reach[std::size_t(bodies.back())] < 0.1 * reach[std::size_t(bodies.front())]))
    bodies.pop_back();
  return bodies;
}

std::string moved_text(const Assembly& assembly, const Model& model, const std::vector<std::int32_t>& bodies,
                       const Standing& before, const Array<double>& from, const State& to) {
  State then = to;
  then.pose = from;
  then.joint.mode = before.joint_mode;
  const std::vector<MechanismJoint> mechanism = find_mechanism(model, then, to);
  std::string text;
  for (const std::int32_t body : bodies) {
    const auto i = std::size_t(body);
    const Way way = way_of(from, to.pose, i);
    const Vec3 at = model.bodies[i].centroid + Vec3(&to.pose[pose_width * i]);
    text += fmt::format("\n  {} at ({:.2f}, {:.2f}, {:.2f}) m: {:.3g} m {}, turned by {:.3g}°{}",
                        body_name(assembly, model, body), at.x() + 0.0, at.y() + 0.0, at.z() + 0.0,
                        way.displacement.norm(), direction_words(way.displacement), way.turn * 180.0 / pi,
                        joints_text(mechanism, model.block_of_body[i]));
  }
  return text;
}

}  // namespace voussoir
