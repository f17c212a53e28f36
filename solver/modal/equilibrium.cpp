#include "solver/modal/equilibrium.h"

#include <fmt/format.h>

#include <Eigen/CholmodSupport>

#include "solver/modal/stiffness.h"

namespace voussoir {

namespace {

/// Everything a patch pass changes.
struct PatchBackup {
  PatchMemory joint, contact, interface;
  Array<double> slip;
  Array<float> branch;
  FillMemory fill;  // without displacements
  explicit PatchBackup(const State& s)
      : joint(s.joint),
        contact(s.contact),
        interface(s.interface_memory),
        slip(s.slip),
        branch(s.branch),
        fill(s.fill) {}
  void restore(State& s) const {
    s.joint = joint, s.contact = contact, s.interface_memory = interface, s.slip = slip, s.branch = branch;
    s.fill.plastic = fill.plastic, s.fill.last = fill.last, s.fill.branch = fill.branch;
    s.fill.yield = fill.yield, s.fill.lost = fill.lost;
  }
};

void move_bodies(const Model& model, const Unknowns& unknowns, const Array<double>& from, const Eigen::VectorXd& step,
                 double share, State& state) {
  state.pose = from;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vector6 part = share * part_of(step, unknowns, i);
    double* pose = &state.pose[pose_width * i];
    for (int c = 0; c < 3; ++c) pose[c] += part[c];
    const Vec3 turn = part.tail<3>();
    const double angle = turn.norm();
    const Eigen::Quaterniond dq =
        angle > 0.0 ? Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle)) : Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond q = (dq * Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6])).normalized();
    pose[3] = q.w(), pose[4] = q.x(), pose[5] = q.y(), pose[6] = q.z();
  }
}

/// The same for the nodes of the fill.
void move_nodes(const Model& model, const Unknowns& unknowns, const Array<double>& from, const Eigen::VectorXd& step,
                double share, State& state) {
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const Vector6 part = share * part_of(step, unknowns, model.bodies.size() + i);
    for (std::size_t c = 0; c < 3; ++c)
      state.fill.pose[node_width * i + c] = from[node_width * i + c] + part[Eigen::Index(c)];
  }
}

/// K with every diagonal entry raised by a ten-millionth, so that a sliver of a mechanism does not stop Newton, and by
/// a tenth of a thousandth of a millionth of the largest, for what nothing holds.
SparseMatrix slightly_held(BlockMatrix k, const Unknowns& unknowns) {
  constexpr double share = 1e-7;
  double largest = 0.0;
  for (std::size_t site = 0; site < k.sites(); ++site)
    if (unknowns.any(site)) largest = std::max(largest, k.diagonal(std::int32_t(site)).diagonal().maxCoeff());
  for (std::size_t site = 0; site < k.sites(); ++site) {
    auto diagonal = k.diagonal(std::int32_t(site)).diagonal().array();
    diagonal = (diagonal + share * 1e-3 * largest) * (1.0 + share);
  }
  return k.over(unknowns);
}

using Cholesky = Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower>;

}  // namespace

OutOfBalance out_of_balance(Stepper& stepper, const Unknowns& unknowns) {
  stepper.patches_only();
  const BodyPass pass = stepper.body_pass();
  OutOfBalance r;
  r.force.resize(unknowns.count);
  const double size = stepper.model->typical_size;
  for (std::size_t i = 0; i < stepper.model->bodies.size(); ++i) {
    if (!unknowns.any(i)) continue;
    const BodyUpdate u = pass.update(i);
    Vector6 force;
    force << u.force.x, u.force.y, u.force.z, u.moment.x, u.moment.y, u.moment.z;
    set_part(r.force, unknowns, i, force);
    force = part_of(r.force, unknowns, i);  // less what the supports take
    r.largest = std::max({r.largest, force.head<3>().norm(), force.tail<3>().norm() / size});
  }
  const FillPass fill = stepper.fill_pass();
  for (std::size_t i = 0; i < stepper.model->fill.nodes.size(); ++i) {
    const NodeUpdate u = fill.update(i);
    Vector6 force = Vector6::Zero();
    force.head<3>() << u.force[0], u.force[1], u.force[2];
    set_part(r.force, unknowns, stepper.model->bodies.size() + i, force);
    r.largest = std::max(r.largest, part_of(r.force, unknowns, stepper.model->bodies.size() + i).norm());
  }
  r.largest /= std::max(stepper.model->average_weight, 1e-300);
  return r;
}

double out_of_balance(Stepper& stepper) {
  const PatchBackup backup(*stepper.state);
  const double largest = out_of_balance(stepper, number_unknowns(*stepper.model)).largest;
  backup.restore(*stepper.state);
  return largest;
}

Equilibrium newton_equilibrium(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
                               const std::function<void(int, double)>& progress) {
  const Model& model = *stepper.model;
  State& state = *stepper.state;
  const Unknowns unknowns = number_unknowns(model);
  const PatchBackup start(state);
  Equilibrium result;
  Cholesky cholesky;
  bool analysed = false;
  OutOfBalance r = out_of_balance(stepper, unknowns);
  result.first_residual = result.residual = r.largest;
  Array<double> elastic_pose = state.pose, elastic_nodes = state.fill.pose;
  const int most_iterations = 40, patience = 6;
  for (int i = 0; i < most_iterations && r.largest > tolerance && !(stop && stop->load()); ++i) {
    // At first nothing presses yet, so the present tangent would be nothing at all: begin with every joint closed.
    const PatchTangent tangent = i == 0 ? PatchTangent::intact : PatchTangent::present;
    const SparseMatrix k = slightly_held(stiffness_blocks(model, state, tangent), unknowns);
    if (!analysed) cholesky.analyzePattern(k);
    analysed = true;
    cholesky.factorize(k);
    if (cholesky.info() != Eigen::Success) break;
    const Eigen::VectorXd step = cholesky.solve(r.force);
    const Array<double> before = state.pose, nodes_before = state.fill.pose;
    const auto move = [&](double share) {
      move_bodies(model, unknowns, before, step, share, state);
      move_nodes(model, unknowns, nodes_before, step, share, state);
    };
    // Line search on the norm of the residual; a full step first, the best of the tries if none is good.
    double best_norm = 1e300, best_share = 0.0;
    const double norm = r.force.norm();
    for (double share = 1.0; share > 0.05; share *= 0.5) {
      move(share);
      start.restore(state);
      const double now = out_of_balance(stepper, unknowns).force.norm();
      if (now < best_norm) best_norm = now, best_share = share;
      if (now < (1.0 - 0.1 * share) * norm) break;
    }
    if (!(best_norm < 1e300)) break;
    move(best_share);
    start.restore(state);
    r = out_of_balance(stepper, unknowns);
    result.iterations = i + 1;
    if (progress) progress(i + 1, r.largest);
    if (i == 0) elastic_pose = state.pose, elastic_nodes = state.fill.pose;
    result.residual = std::min(result.residual, r.largest);
    if (i >= patience && result.residual > 1e-2)
      break;  // joints keep changing state: it would only go round in circles
  }
  result.converged = r.largest <= tolerance;
  if (!result.converged) {
    // Nothing half-broken is handed on, only where the assembly would be if all its joints held: a relaxation from
    // there overshoots far less than one from the unloaded placement, and overshooting breaks joints that rest would
    // not.
    state.pose = elastic_pose;
    state.fill.pose = elastic_nodes;
    start.restore(state);
  }
  stop_motion(state);
  result.account =
      fmt::format("Newton {} after {} iterations: out-of-balance force {:.2e} of an average block's weight",
                  result.converged ? "converged" : "did not converge", result.iterations, result.residual);
  return result;
}

}  // namespace voussoir
