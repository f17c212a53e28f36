#include "solver/run/runaway.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {

std::string body_name(const Assembly& assembly, const Model& model, std::int32_t body) {
  const std::int64_t block = model.block_of_body[std::size_t(body)];
  return fmt::format("block {} ({})", block,
                     component_names()[std::size_t(assembly.blocks[std::size_t(block)].component)]);
}

std::string runaway_text(const Assembly& assembly, const Model& model, const State& state, const Advance& last) {
  const FillMesh& mesh = assembly.fill;
  const auto place = [&](std::int32_t node) {
    const double* u = &state.fill.pose[node_width * std::size_t(model.fill.node_of[std::size_t(node)])];
    const Vec3 at = mesh.nodes[std::size_t(node)] + Vec3(u);
    return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", at.x(), at.y(), at.z());
  };
  if (last.inverted_tet >= 0)
    return fmt::format(
        "tetrahedron {} of the fill at {} has lost its volume: the fill has deformed more than this mesh allows. Stop "
        "the run earlier, give the fill more cohesion, or use a coarser mesh there",
        last.inverted_tet, place(mesh.tets[std::size_t(last.inverted_tet)][0]));
  const std::string what = last.runaway_body >= 0
                               ? body_name(assembly, model, last.runaway_body)
                               : fmt::format("node {} of the fill at {}", last.runaway_node, place(last.runaway_node));
  return what +
         " moves faster than 1000 m/s or its speed is not finite. Lower [analysis] safety or time_step, and check its "
         "joints";
}

namespace {

bool finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

std::string first_not_finite(const Assembly& assembly, const Stepper& stepper) {
  const Model& model = *stepper.model;
  const State& state = *stepper.state;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (!finite(&state.pose[pose_width * i], 7) || !finite(&state.motion[motion_width * i], motion_width))
      return "first in " + body_name(assembly, model, std::int32_t(i));
  for (std::size_t i = 0; i < model.joints.size() + state.contacts.size(); ++i) {
    const PatchEnergy e = patch_energy(model, state, stepper.damping.branches, i);
    if (std::isfinite(e.elastic) && std::isfinite(e.branches)) continue;
    const bool joint = i < model.joints.size();
    const Patch& p = joint ? model.joints[i] : state.contacts[i - model.joints.size()];
    return fmt::format("first in the {} between {} and {}", joint ? "joint" : "contact",
                       body_name(assembly, model, p.a), body_name(assembly, model, p.b));
  }
  return model.fill.empty() ? "in no stone and no joint" : "in the fill or its patches";
}

}  // namespace

std::string not_finite_text(const Assembly& assembly, const Stepper& stepper, const Energies& energies) {
  std::string terms;
  for (const auto& [name, term] : energy_terms())
    if (!std::isfinite(energies.*term)) terms += fmt::format("{}{}", terms.empty() ? "" : ", ", name);
  if (terms.empty()) return {};
  return fmt::format("these terms of the energy balance are not finite: {} ({})", terms,
                     first_not_finite(assembly, stepper));
}

}  // namespace voussoir
