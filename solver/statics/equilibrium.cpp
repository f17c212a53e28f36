#include "solver/statics/equilibrium.h"

#include <fmt/format.h>

#include <new>

#include "solver/base/counted.h"
#include "solver/linear/factor.h"
#include "solver/linear/krylov.h"
#include "solver/linear/multigrid.h"
#include "solver/linear/stiffness.h"

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

/// How a step of displacement and turn is taken: the displacement as it is, or both as one screw, so that a stone that
/// turns about an edge stays on it.
enum class Way { straight, screw };

/// Where a centroid goes that sets out along `u` and turns with `turn` all the while:
/// u + (1 − cos φ)/φ² ω × u + (φ − sin φ)/φ³ ω × (ω × u).
Vec3 screwed(const Vec3& u, const Vec3& turn) {
  const double angle = turn.norm();
  constexpr double small = 1e-4;  // rad: series below, exact to rounding
  const double second = angle < small ? 0.5 - angle * angle / 24.0 : (1.0 - std::cos(angle)) / (angle * angle);
  const double third = angle < small ? 1.0 / 6.0 : (angle - std::sin(angle)) / (angle * angle * angle);
  const Vec3 across = turn.cross(u);
  return u + second * across + third * turn.cross(across);
}

void move_bodies(const Model& model, const Unknowns& unknowns, const Array<double>& from, const Eigen::VectorXd& step,
                 double share, Way way, State& state) {
  state.pose = from;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vector6 part = share * part_of(step, unknowns, i);
    double* pose = &state.pose[pose_width * i];
    const Vec3 turn = part.tail<3>();
    const Vec3 u = way == Way::screw ? screwed(part.head<3>(), turn) : Vec3(part.head<3>());
    for (int c = 0; c < 3; ++c) pose[c] += u[c];
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

/// K with every diagonal entry raised by a share of itself, so that a sliver of a mechanism does not stop Newton, and
/// by a tenth of a thousandth of a millionth of the largest, for what nothing holds. What is raised is left undone of a
/// step, the more the higher a wall (docs/theory/equilibrium.md), so less where every joint is closed and there are
/// few mechanisms.
BlockMatrix slightly_held(BlockMatrix k, const Unknowns& unknowns, PatchTangent kind) {
  const double share = kind == PatchTangent::intact ? 1e-9 : 1e-7;
  double largest = 0.0;
  for (std::size_t site = 0; site < k.sites(); ++site)
    if (unknowns.any(site)) largest = std::max(largest, k.diagonal(std::int32_t(site)).diagonal().maxCoeff());
  for (std::size_t site = 0; site < k.sites(); ++site) {
    auto diagonal = k.diagonal(std::int32_t(site)).diagonal().array();
    diagonal = (diagonal + 1e-10 * largest) * (1.0 + share);
  }
  return k;
}

/// The inverse of a tangent. A large assembly of blocks without fill uses multigrid as long as it converges; other
/// assemblies use a direct factorisation. A large assembly uses the factorisation only if it takes no longer than some
/// thousand iterations of dynamic relaxation.
class TangentInverse {
 public:
  TangentInverse(const Model& model, const Unknowns& unknowns) : model_(model), unknowns_(unknowns) {}

  bool compute(BlockMatrix k, const State& state) {
    k_ = std::move(k);
    k_.hold(unknowns_);
    by_cycles_ = false;
    if (large()) {
      std::vector<Vec3> places;
      for (std::size_t i = 0; i < model_.bodies.size(); ++i)
        places.push_back(model_.bodies[i].centroid + Vec3(&state.pose[pose_width * i]));
      try {
        by_cycles_ = multigrid_.compute(k_, unknowns_, places);
      } catch (const std::bad_alloc&) {  // relaxation may still do with what there is
        multigrid_ = {};
      }
    }
    return by_cycles_ || compute_factor();
  }
  /// K⁻¹ b, with an error of `tolerance` |b| in K x; exact where by a factor.
  std::optional<Eigen::VectorXd> times(const Eigen::VectorXd& b, double tolerance) {
    constexpr int most_iterations = 100;
    if (by_cycles_) {
      if (auto x = multigrid_.solve(k_, unknowns_, b, tolerance, most_iterations)) return x;
      by_cycles_ = false;
      if (!compute_factor()) return {};
    }
    return factor_.solve(b);
  }
  const Factor& factor() const { return factor_; }
  /// What stood in the way of a factor, or nothing.
  const std::string& remark() const { return remark_; }

 private:
  bool large() const {
    constexpr std::size_t many = 5000;  // bodies; fewer are quicker with a factor
    return model_.fill.empty() && model_.bodies.size() >= many;
  }
  bool compute_factor() {
    const double most = large() ? 5e6 * double(model_.bodies.size()) : 1e300;  // 0.2 to 0.4 ms a body
    if (factor_.compute(k_.over(unknowns_), most)) return true;
    if (factor_.operations() > most)
      remark_ = fmt::format(" (multigrid did not converge, and a direct factorisation would take {:.1e} operations)",
                            factor_.operations());
    return false;
  }

  const Model& model_;
  const Unknowns& unknowns_;
  BlockMatrix k_{0, {}};
  Multigrid multigrid_;
  Factor factor_;
  std::string remark_;
  bool by_cycles_ = false;
};

/// Relative tolerance of a linear solution: smaller than the remaining residual of the previous iteration, which shows
/// the effect of the changing tangent, but not smaller than necessary at the end (after Eisenstat & Walker 1996).
double step_tolerance(double left_before, double wanted) {
  return std::clamp(0.3 * std::max(left_before, wanted), 1e-3, 0.1);
}

/// A placement, and the out-of-balance forces of placements near it, all evaluated from the patch state at the start.
struct Surroundings {
  Stepper& stepper;
  const Unknowns& unknowns;
  const PatchBackup& start;
  Array<double> pose, nodes;
  Way way = Way::straight;

  OutOfBalance moved(const Eigen::VectorXd& step, double share) const {
    move_bodies(*stepper.model, unknowns, pose, step, share, way, *stepper.state);
    move_nodes(*stepper.model, unknowns, nodes, step, share, *stepper.state);
    start.restore(*stepper.state);
    return out_of_balance(stepper, unknowns);
  }
};

/// K x of the tangent consistent with what patches and elements do, sliding, opening and plastic flow included: the
/// derivative of the out-of-balance forces `here`, along x, by differences (Knoll & Keyes 2004).
Eigen::VectorXd tangent_times(const Surroundings& at, const Eigen::VectorXd& here, const Eigen::VectorXd& x) {
  const double size = x.lpNorm<Eigen::Infinity>();
  if (size == 0.0) return Eigen::VectorXd::Zero(x.size());
  constexpr double reach = 1e-9;  // m or rad: far above rounding, far below what makes a joint slide
  const double share = reach / size;
  return (here - at.moved(x, share).force) / share;
}

/// The Newton step of a model with a fill: plastic flow leaves a tangent that is not symmetric, so the factored
/// stiffness, in which the fill is elastic, only preconditions it. (With less stiffness for elements that flow it took
/// three to ten times as many products.)
Eigen::VectorXd consistent_step(const Surroundings& at, const Factor& factor, const Eigen::VectorXd& force) {
  constexpr double tolerance = 1e-3;
  constexpr int most_products = 150;
  return solve_by_products([&](const Eigen::VectorXd& x) { return tangent_times(at, force, x); },
                           [&](const Eigen::VectorXd& b) -> Eigen::VectorXd { return factor.solve(b); }, force,
                           tolerance, most_products);
}

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

void look_at_rest(Stepper& stepper, const std::function<void()>& look) {
  const PatchBackup backup(*stepper.state);
  stepper.patches_only();
  look();
  backup.restore(*stepper.state);
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
  TangentInverse inverse(model, unknowns);
  bool renew = true;  // the inverse
  OutOfBalance r = out_of_balance(stepper, unknowns);
  result.first_residual = result.residual = r.largest;
  Array<double> elastic_pose = state.pose, elastic_nodes = state.fill.pose;
  const int most_iterations = 40, patience = model.fill.empty() ? 6 : 15,
            trial = model.fill.empty() ? 3 : most_iterations;
  Eigen::VectorXd last_force, last_step;
  double elastic_residual = 0.0, left = 0.03;  // left: share of the residual, by the step before
  for (int i = 0; i < most_iterations && r.largest > tolerance && !(stop && stop->load()); ++i) {
    // At first nothing presses yet, so the present tangent would be nothing at all: begin with every joint closed.
    const PatchTangent tangent = i == 0 ? PatchTangent::intact : PatchTangent::present;
    const bool fresh = renew;
    if (fresh && !inverse.compute(slightly_held(stiffness_blocks(model, state, tangent), unknowns, tangent), state))
      break;
    const Surroundings here = {stepper, unknowns, start, state.pose, state.fill.pose, Way::straight};
    const bool consistent = i > 0 && !model.fill.empty();
    // What the last step with this inverse changed is known: it is taken again, by the share that leaves least, and the
    // inverse finds what goes with the rest (Anderson 1965, one step remembered).
    double again = 0.0;
    Eigen::VectorXd rest = r.force;
    if (!fresh) {
      const Eigen::VectorXd change = r.force - last_force;
      again = -r.force.dot(change) / change.squaredNorm();
      rest += again * change;
    }
    const std::optional<Eigen::VectorXd> found = consistent
                                                     ? consistent_step(here, inverse.factor(), rest)
                                                     : inverse.times(rest, step_tolerance(left, tolerance / r.largest));
    if (!found) break;
    Eigen::VectorXd step = *found;
    if (!fresh) step += again * last_step;
    last_force = r.force;
    // Line search on the norm of the residual; a full step first, the best of the tries if none is good.
    double best_norm = 1e300, best_share = 0.0, tried = 0.0;
    const double norm = r.force.norm();
    for (double share = 1.0; share > 0.05; share *= 0.5) {
      r = here.moved(step, tried = share);
      const double now = r.force.norm();
      if (now < best_norm) best_norm = now, best_share = share;
      if (now < (1.0 - 0.1 * share) * norm) break;
    }
    if (!(best_norm < 1e300)) break;
    // One inverse serves for several steps while each leaves but a tenth (Shamanskii 1967). A step of an old one that
    // leaves more than half is not taken.
    renew = !model.fill.empty() || !(best_norm < 0.1 * norm);
    if (renew && !fresh && best_norm > 0.5 * norm) best_share = 0.0;
    if (best_share != tried) r = here.moved(step, best_share);
    left = r.force.norm() / norm;
    last_step = best_share * step;
    result.iterations = i + 1;
    if (progress) progress(i + 1, r.largest);
    if (i == 0) elastic_pose = state.pose, elastic_nodes = state.fill.pose, elastic_residual = r.largest;
    result.residual = std::min(result.residual, r.largest);
    // Joints keep changing state, and it would only go round in circles: no better off than with all of them closed
    // after some tries, or far from the end after many.
    if (result.iterations >= trial && r.largest > elastic_residual) break;
    if (i >= patience && result.residual > 1e-2) break;
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
      fmt::format("Newton {} after {}: out-of-balance force {:.2e} of an average block's weight{}",
                  result.converged ? "converged" : "did not converge", counted(result.iterations, "iteration"),
                  result.residual, result.converged ? "" : inverse.remark());
  return result;
}

namespace {

/// The factored tangent in the present placement, with the geometric stiffness of the joint forces if the sum is
/// positive definite.
bool factor_tangent(Stepper& stepper, const Unknowns& unknowns, TangentInverse& inverse) {
  const Model& model = *stepper.model;
  const BlockMatrix plain =
      slightly_held(stiffness_blocks(model, *stepper.state, PatchTangent::present), unknowns, PatchTangent::present);
  BlockMatrix whole = plain;
  add_geometric_stiffness(whole, model, *stepper.state, stepper.wrenches);
  return inverse.compute(std::move(whole), *stepper.state) || inverse.compute(plain, *stepper.state);
}

/// A Newton step, and by how much the multiplier changes with it: K x = r + Δλ g with gᵀ x = G (head − a) (the bordered
/// system of displacement control, Batoz & Dhatt 1979).
struct PushedStep {
  Eigen::VectorXd x;
  double multiplier = 0.0;
};

std::optional<PushedStep> pushed_step(const Stepper& stepper, const Unknowns& unknowns, const Machine* machine,
                                      TangentInverse& inverse, const Eigen::VectorXd& force) {
  constexpr double accuracy = 1e-3;
  std::optional<Eigen::VectorXd> x = inverse.times(force, accuracy);
  if (!x || !machine) return x ? std::optional(PushedStep{std::move(*x), 0.0}) : std::nullopt;
  const Eigen::VectorXd g = pattern_vector(*stepper.model, *stepper.state, unknowns, machine->pattern);
  const std::optional<Eigen::VectorXd> y = inverse.times(g, accuracy);
  if (!y || !(g.dot(*y) > 0.0)) return {};
  const double wanted = pattern_force(*stepper.model, machine->pattern) *
                        (machine->head - pattern_displacement(*stepper.model, *stepper.state, machine->pattern));
  const double change = (wanted - g.dot(*x)) / g.dot(*y);
  return PushedStep{*x + change * *y, change};
}

}  // namespace

Equilibrium newton_step(Stepper& stepper, double tolerance, Machine* machine, const std::atomic<bool>* stop,
                        const std::function<void(int, double)>& progress) {
  constexpr int most_iterations = 30;
  const Model& model = *stepper.model;
  State& state = *stepper.state;
  const Unknowns unknowns = number_unknowns(model);
  const PatchBackup start(state);
  const Array<double> first_pose = state.pose, first_nodes = state.fill.pose;
  double multiplier = machine ? machine->multiplier : 0.0;
  if (machine) stepper.loads = at_share(machine->pattern, multiplier);
  Equilibrium result;
  TangentInverse inverse(model, unknowns);
  OutOfBalance r = out_of_balance(stepper, unknowns);
  result.first_residual = result.residual = r.largest;
  bool pushes = machine != nullptr;  // the head has not moved yet
  for (int i = 0; i < most_iterations && (pushes || r.largest > tolerance) && !(stop && stop->load()); ++i) {
    if (!factor_tangent(stepper, unknowns, inverse)) break;
    const std::optional<PushedStep> step = pushed_step(stepper, unknowns, machine, inverse, r.force);
    if (!step) break;
    const Surroundings here = {stepper, unknowns, start, state.pose, state.fill.pose, Way::screw};
    const auto moved = [&](double share) {
      if (machine) set_share(machine->pattern, multiplier + share * step->multiplier, stepper.loads);
      return here.moved(step->x, share);
    };
    double best_norm = 1e300, best_share = 0.0, tried = 0.0;
    const double norm = pushes ? 1e300 : r.force.norm();  // the first push is taken whole
    for (double share = 1.0; share > 0.05; share *= 0.5) {
      r = moved(tried = share);
      const double now = r.force.norm();
      if (now < best_norm) best_norm = now, best_share = share;
      if (now < (1.0 - 0.1 * share) * norm) break;
    }
    if (!(best_norm < 1e300)) break;
    if (best_share != tried) r = moved(best_share);
    multiplier += best_share * step->multiplier;
    pushes = false;
    result.iterations = i + 1;
    result.residual = r.largest;
    if (progress) progress(i + 1, r.largest);
  }
  result.converged = !pushes && r.largest <= tolerance;
  if (!result.converged) {
    state.pose = first_pose, state.fill.pose = first_nodes;
    start.restore(state);
  } else if (machine) {
    machine->multiplier = multiplier;
  }
  stop_motion(state);
  result.account = fmt::format("Newton {} after {}: out-of-balance force {:.2e} of an average block's weight",
                               result.converged ? "converged" : "did not converge",
                               counted(result.iterations, "iteration"), result.residual);
  return result;
}

}  // namespace voussoir
