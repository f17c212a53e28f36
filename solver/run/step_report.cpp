#include "solver/run/step_report.h"

#include <fmt/format.h>

#include <numeric>

#include "solver/run/runaway.h"

namespace voussoir {

namespace {

double stiffness(const Patch& patch) {
  return patch.area * std::max(patch.kn, patch.ks);
}

/// Sites that anything pulls at, the fastest first.
std::vector<std::int32_t> moving_by(const std::vector<LocalRate>& rates, double LocalRate::*rate) {
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (rates[i].own > 0.0) order.push_back(std::int32_t(i));
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) {
    return rates[std::size_t(i)].*rate > rates[std::size_t(j)].*rate;
  });
  return order;
}

double step_without(const Model& model, const State& state, std::int32_t site) {
  std::vector<bool> held(model.sites(), false);
  held[std::size_t(site)] = true;
  return critical_step(model, state, without(number_unknowns(model), held)).step;
}

StiffSite stiff_site(const Model& model, const State& state, std::int32_t index, const LocalRate& rate) {
  StiffSite site;
  const auto bodies = std::int32_t(model.bodies.size());
  if (index < bodies)
    site.body = index, site.patch = stiffest_patch(model, index);
  else
    site.node = model.fill.mesh_node[std::size_t(index - bodies)];
  site.step = step_at(rate.bound), site.without = step_without(model, state, index);
  return site;
}

/// 1, 10, 100 sites and 0.1, 1, 10 % of them.
std::vector<std::int64_t> counts_up_to(std::int64_t all) {
  std::vector<std::int64_t> counts = {1, 10, 100, all / 1000, all / 100, all / 10};
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  std::erase_if(counts, [&](std::int64_t n) { return n < 1 || n >= all; });
  return counts;
}

}  // namespace

double StepReport::at_share(double share) const {
  return local.empty() ? 0.0 : local[std::min(local.size() - 1, std::size_t(share * double(local.size())))];
}

StepReport report_step(const Model& model, const State& state, int count) {
  StepReport report;
  report.critical = critical_step(model, state);
  const std::vector<LocalRate> rates = local_rates(model, state);
  const std::vector<std::int32_t> worst = moving_by(rates, &LocalRate::bound);
  for (std::int32_t i : worst) report.local.push_back(step_at(rates[std::size_t(i)].bound));
  for (std::size_t i = 0; i < std::min(report.local.size(), std::size_t(count)); ++i)
    report.stiffest.push_back(stiff_site(model, state, worst[i], rates[std::size_t(worst[i])]));
  const std::vector<std::int32_t> order = moving_by(rates, &LocalRate::own);
  for (std::int64_t raised : counts_up_to(std::int64_t(report.local.size()))) {
    Model scaled = model;
    const MassScaling scaling = raise_to(scaled, rates, rates[std::size_t(order[std::size_t(raised)])].own);
    report.raised.push_back({raised, scaling.share, critical_step(scaled, state).step});
  }
  return report;
}

std::int64_t stiffest_patch(const Model& model, std::int32_t body) {
  std::int64_t best = -1;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& patch = model.joints[i];
    if (patch.a != body && patch.b != body) continue;
    if (best < 0 || stiffness(patch) > stiffness(model.joints[std::size_t(best)])) best = std::int64_t(i);
  }
  return best;
}

double least_thickness(const Model& model, std::int32_t body) {
  const std::vector<Convex>& cells = model.cells[std::size_t(body)];
  double least = 1e300;
  for (const Convex& cell : cells)
    for (const Plane& plane : cell.planes) {
      double low = 1e300, high = -1e300;
      for (const Convex& other : cells)
        for (const Vec3& v : other.vertices)
          low = std::min(low, plane.normal.dot(v)), high = std::max(high, plane.normal.dot(v));
      least = std::min(least, high - low);
    }
  return least;
}

std::string describe_stiff_body(const Assembly& assembly, const Model& model, std::int32_t body) {
  std::string text =
      fmt::format("{}, {:.3g} kg, {:.3g} m thick", block_label(assembly, model.block_of_body[std::size_t(body)]),
                  model.bodies[std::size_t(body)].mass, least_thickness(model, body));
  const std::int64_t index = stiffest_patch(model, body);
  if (index < 0) return text;
  const Patch& patch = model.joints[std::size_t(index)];
  const std::int32_t other = patch.a == body ? patch.b : patch.a;
  return text + fmt::format("; stiffest joint kn A = {:.3g} N/m ({:.3g} m2) with {}", patch.kn * patch.area, patch.area,
                            block_label(assembly, model.block_of_body[std::size_t(other)]));
}

std::string node_name(const Assembly& assembly, std::int32_t node) {
  const Vec3& at = assembly.fill.nodes[std::size_t(node)];
  return fmt::format("node {} of the fill at ({:.2f}, {:.2f}, {:.2f}) m", node, at.x(), at.y(), at.z());
}

std::string short_name(const Assembly& assembly, const Model& model, const CriticalStep& critical) {
  return critical.node >= 0 ? node_name(assembly, critical.node) : body_name(assembly, model, critical.body);
}

std::string describe_fastest(const Assembly& assembly, const Model& model, const CriticalStep& critical) {
  StiffSite site;
  site.body = critical.body, site.node = critical.node;
  return describe_stiff_site(assembly, model, site);
}

std::string describe_stiff_site(const Assembly& assembly, const Model& model, const StiffSite& site) {
  if (site.node < 0) return describe_stiff_body(assembly, model, site.body);
  const auto node = std::size_t(model.fill.node_of[std::size_t(site.node)]);
  return fmt::format("{}, {:.3g} kg", node_name(assembly, site.node), model.fill.mass[node]);
}

}  // namespace voussoir
