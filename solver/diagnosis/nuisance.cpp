#include "solver/diagnosis/nuisance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

// Standard deviations: of one part against the mean of its material, which is fitted (docs/theory/diagnosis.md).
constexpr double part_stiffness = 0.08, part_density = 0.02;
constexpr double contact_stiffness = 0.3, base_stiffness = 0.15;

/// Joints that are `chosen` by the numbers of their blocks' parts.
void scale_joints(Assembly& assembly, const std::function<bool(const Joint&)>& chosen, double factor) {
  for (Joint& joint : assembly.joints)
    if (!is_tie(assembly, joint) && chosen(joint)) joint.kn *= factor, joint.ks *= factor;
}

/// Names of single parts: the groups of several are sums of these.
std::vector<std::string> single_parts(const Assembly& assembly) {
  std::vector<std::string> names = masonry_parts(assembly);
  static const std::vector<std::string> groups = {"arches", "piers", "abutments", "spandrels", "all"};
  std::erase_if(names, [](const auto& name) { return std::find(groups.begin(), groups.end(), name) != groups.end(); });
  return names;
}

/// The part of each block, numbered as the names; −1: it is in none.
std::vector<int> part_of_blocks(const Assembly& assembly, const std::vector<std::string>& names) {
  std::vector<int> of(assembly.blocks.size(), -1);
  for (std::size_t p = 0; p < names.size(); ++p) {
    const BlockSet in = masonry_part(assembly, names[p]);
    for (std::size_t i = 0; i < of.size(); ++i)
      if (in[i]) of[i] = int(p);
  }
  return of;
}

bool is_fill(const Assembly& assembly, std::int64_t block) {
  return assembly.blocks[std::size_t(block)].component == Component::backfill;
}

Nuisance factor(const std::string& name, double spread, const std::function<void(Assembly&, double factor)>& scale) {
  constexpr double step = 1e-3;  // K and M are linear in the factor
  return {name, "-", spread, step, [scale](const Assembly& base, double amount) {
            Assembly changed = base;
            scale(changed, 1.0 + amount);
            return changed;
          }};
}

}  // namespace

std::vector<Nuisance> part_nuisances(const Assembly& base) {
  std::vector<Nuisance> all;
  const auto add = [&](const std::string& name, double spread, const std::function<void(Assembly&, double)>& scale) {
    all.push_back(factor(name, spread, scale));
  };
  const std::vector<std::string> names = single_parts(base);
  for (const std::string& name : names) {
    const auto scale = [name](Assembly& a, double f) { scale_inside(a, masonry_part(a, name), f); };
    add("stiffness of " + name, part_stiffness, scale);
    add("density of " + name, part_density,
        [name](Assembly& a, double f) { scale_density(a, masonry_part(a, name), f); });
  }
  if (!all_if_any(base, Component::parapet).empty())
    add("stiffness of parapets", contact_stiffness, [](Assembly& a, double f) {
      const BlockSet parapets = component(a, Component::parapet);
      scale_joints(
          a, [&](const Joint& j) { return parapets[std::size_t(j.a)] || parapets[std::size_t(j.b)]; }, f);
    });
  const std::vector<int> part = part_of_blocks(base, names);
  add("joints between parts", contact_stiffness, [part](Assembly& a, double f) {
    scale_joints(
        a,
        [&](const Joint& j) {
          if (std::size_t(std::max(j.a, j.b)) >= part.size()) return false;
          const int one = part[std::size_t(j.a)], other = part[std::size_t(j.b)];
          return one >= 0 && other >= 0 && one != other;
        },
        f);
  });
  if (!all_if_filled(base).empty())
    add("contact of the fill", contact_stiffness, [](Assembly& a, double f) {
      scale_joints(
          a, [&](const Joint& j) { return is_fill(a, j.a) != is_fill(a, j.b); }, f);
      scale_patches(a, BlockSet(a.blocks.size(), true), f);
    });
  if (!all_if_filled(base).empty() && !all_if_any(base, Component::spandrel).empty())
    add("contact of the fill at the spandrel walls", contact_stiffness, [](Assembly& a, double f) {
      const BlockSet walls = masonry_part(a, "spandrels");
      scale_between(a, component(a, Component::backfill), walls, f);
      scale_patches(a, walls, f);
    });
  for (const std::string& support : supports(base))
    add("stiffness of the base of " + support, base_stiffness, [support](Assembly& a, double f) {
      const std::int64_t own = base_of(a, support);
      scale_joints(
          a, [&](const Joint& j) { return j.a == own || j.b == own; }, f);
    });
  return all;
}

Sensitivities::Sensitivities(const Origin& origin, const std::vector<Sensor>& sensors, int wanted)
    : origin_(&origin), sensors_(sensors), modes_(origin.response().vectors) {
  wanted_ = std::min<Eigen::Index>(wanted, modes_.cols());
  for (const Sensor& sensor : sensors) {
    const auto at = std::find_if(places_.begin(), places_.end(), [&](const Sensor& place) {
      return place.block == sensor.block && place.position == sensor.position;
    });
    place_of_.push_back(std::size_t(at - places_.begin()));
    if (at == places_.end()) places_.push_back(sensor);
  }
  const Unknowns& unknowns = origin.model().unknowns;
  const auto count = 3 * Eigen::Index(places_.size());
  const Eigen::MatrixXd& inertia = origin.response().ground.inertia;
  Vectors loads = Vectors::Zero(unknowns.count, count + inertia.cols());
  loads.leftCols(count) = sensor_loads(origin.assembly(), unknowns, along_axes(places_));
  if (inertia.cols() > 0) loads.rightCols(inertia.cols()) = inertia;
  loads_ = origin.static_response(loads);
  motions_ = motions_at(origin.assembly(), unknowns, places_, modes_);
}

ModalData Sensitivities::derivative_to(const Assembly& changed, double amount) const {
  const Response& known = origin_->response();
  const Unknowns& unknowns = origin_->model().unknowns;
  const Contributions d = derivative(origin_->assembly(), changed, amount);
  const Vectors phi = modes_.leftCols(wanted_);
  const auto forces = [&](const Vectors& from) -> Eigen::MatrixXd {  // fromᵀ (λ M′ − K′) φ
    return project_mass(d, unknowns, from, phi) * known.eigenvalues.head(wanted_).asDiagonal() -
           project_stiffness(d, unknowns, from, phi);
  };
  const Eigen::MatrixXd g = forces(modes_), at_loads = forces(loads_);
  const Eigen::MatrixXd own_mass = project_mass(d, unknowns, phi, phi);
  const Eigen::Index axes = known.ground.inertia.cols(), count = loads_.cols() - axes, all = known.eigenvalues.size();
  ModalData m;
  m.log_frequency = Eigen::VectorXd::Zero(all);
  m.participation = Eigen::MatrixXd::Zero(axes, axes > 0 ? all : 0);
  const Eigen::MatrixXd vectors = phi;
  // The sensors stay where they are; the centroids, about which blocks turn, may not.
  Eigen::MatrixXd motions = (motions_at(changed, unknowns, places_, vectors) - motions_.leftCols(wanted_)) / amount;
  for (Eigen::Index i = 0; i < wanted_; ++i) {
    const double lambda = known.eigenvalues[i];
    m.log_frequency[i] = -0.5 * g(i, i) / lambda;
    // Shares of the known modes: what the static response has of them is taken out.
    Eigen::VectorXd shares(modes_.cols());
    for (Eigen::Index j = 0; j < shares.size(); ++j) {
      const double other = known.eigenvalues[j], apart = other - lambda, least = 1e-3 * lambda;
      const double own =
          j == i ? -0.5 * own_mass(i, i) : g(j, i) / (std::abs(apart) < least ? std::copysign(least, apart) : apart);
      shares[j] = own - g(j, i) / other;
    }
    motions.col(i) += motions_ * shares + at_loads.col(i).head(count);
    if (axes > 0) m.participation.col(i) = known.participation * shares + at_loads.col(i).tail(axes);
  }
  if (axes > 0) m.participation.leftCols(wanted_) += project_mass(d, unknowns, translations(unknowns), phi);
  m.sensors = Eigen::MatrixXd::Zero(Eigen::Index(sensors_.size()), all);
  m.motions = Eigen::MatrixXd::Zero(3 * Eigen::Index(sensors_.size()), all);
  for (std::size_t s = 0; s < sensors_.size(); ++s) {
    const auto own = motions.middleRows<3>(3 * Eigen::Index(place_of_[s]));
    m.motions.middleRows<3>(3 * Eigen::Index(s)).leftCols(wanted_) = own;
    m.sensors.row(Eigen::Index(s)).head(wanted_) = sensors_[s].direction.transpose() * own;
  }
  return m;
}

namespace {

double outline_of(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  return sum;
}

/// Description of a different division into blocks in the second assembly, which differs by `amount` (m); empty if
/// there is none. If faces only move past each other, the common area of two blocks changes by a strip. At most a
/// `share` of the whole joint area may appear or disappear.
std::string other_cut(const Assembly& a, const Assembly& b, double amount, double share) {
  if (a.blocks.size() != b.blocks.size())
    return fmt::format("{} instead of {}", counted(b.blocks.size(), "block"), a.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i)
    if (a.blocks[i].fixed != b.blocks[i].fixed || a.blocks[i].component != b.blocks[i].component)
      return "blocks that belong to other parts";
  struct Shared {
    double more = 0.0, outline = 0.0;  // area of b over that of a; of both
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Shared> pairs;
  const auto count = [&](const Assembly& assembly, double sign) {
    for (const Joint& joint : assembly.joints) {
      Shared& shared = pairs[{joint.a, joint.b}];
      shared.more += sign * joint.area;
      shared.outline += outline_of(joint.polygon);
    }
  };
  count(a, -1.0), count(b, 1.0);
  double jumps = 0.0, all = 0.0;
  for (const Joint& joint : a.joints) all += joint.area;
  for (const auto& [blocks, shared] : pairs)
    if (std::abs(shared.more) > 2.0 * std::abs(amount) * shared.outline) jumps += std::abs(shared.more);
  if (jumps <= share * all) return {};
  return fmt::format("joints of {:.2g} m2 appear or disappear", jumps);
}

void scale_modes(ModalData& m, double factor) {
  m.log_frequency *= factor;
  m.sensors *= factor;
  m.motions *= factor;
  m.participation *= factor;
}

}  // namespace

Sensitivity Sensitivities::of(const Nuisance& n, const Assembly& base, const Hypothesis& hypothesis,
                              const Eigen::VectorXd& x) const {
  Sensitivity s = {n.name, n.unit, n.spread, {}, {}};
  constexpr double jumps = 0.005;  // of the area of all joints, for one standard deviation
  for (const double part : {1.0, -1.0, 0.25, -0.25, 0.05, -0.05}) {
    const double amount = part * n.step;
    try {
      Assembly changed = n.with(base, amount);
      hypothesis.change(changed, x);
      const std::string cut = other_cut(origin_->assembly(), changed, amount, jumps * std::abs(amount) / n.spread);
      if (cut.empty()) {
        s.modes = derivative_to(changed, amount);
        scale_modes(s.modes, n.spread);
        s.why.clear();
        return s;
      }
      s.why = fmt::format("a change of {:+g} {} divides the bridge differently: {}", amount, n.unit, cut);
    } catch (const std::runtime_error& error) {
      s.why = error.what();
    }
  }
  return s;
}

}  // namespace voussoir
