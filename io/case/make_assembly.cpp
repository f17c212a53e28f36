#include <algorithm>

#include "geometry/fill_mesh.h"
#include "geometry/joints.h"
#include "geometry/nearest_block.h"
#include "geometry/rings.h"
#include "geometry/stiffness.h"
#include "io/case/case.h"
#include "io/case/composite_joints.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double reach = 0.05;  // m: largest distance of a sensor from the surface of its block

/// Sets the stiffness and strength that the case gives for all joints between two materials of an assembly file. A
/// fixed stone has the material of the fill that touches it.
void override_joints(Assembly& assembly, const std::string& pair, const GeneratorInput::JointOverride& joint) {
  std::int64_t changed = 0;
  const auto set = [&](auto& j) {
    ++changed;
    if (joint.kn > 0.0) j.kn = joint.kn;
    if (joint.ks > 0.0) j.ks = joint.ks;
    if (joint.has_law) j.law = law_index(assembly.laws, joint.law);
  };
  if (pair == ring_pair) {
    const RingJoints between(assembly);
    for (Joint& j : assembly.joints)
      if (between(j)) set(j);
    if (changed == 0)
      throw InputError("[joints.{}]: no vault of the assembly has more than one ring. Leave the table out.", pair);
    return;
  }
  const auto change = [&](auto& j, std::int32_t a, std::int32_t b) {
    const std::string& p = assembly.materials[std::size_t(a)].name;
    const std::string& q = assembly.materials[std::size_t(b)].name;
    if (pair == p + "-" + q || pair == q + "-" + p) set(j);
  };
  const auto block = [&](std::int64_t i) -> const Block& { return assembly.blocks[std::size_t(i)]; };
  for (Joint& j : assembly.joints) change(j, block(j.a).material, block(j.b).material);
  const std::vector<std::int32_t> tets = triangle_tets(assembly.fill);
  for (FillJoint& j : assembly.fill_joints) {
    const std::int32_t fill = assembly.fill.material[std::size_t(tets[std::size_t(j.triangle)])];
    change(j, block(j.block).fixed ? fill : block(j.block).material, fill);
  }
  if (changed > 0) return;
  std::vector<std::string> names;
  for (const Material& m : assembly.materials) names.push_back(m.name);
  throw InputError("[joints.{}]: the assembly has no joint between these materials. Its materials are: {}", pair,
                   fmt::join(names, ", "));
}

/// Overlapping blocks would be thrown apart in the first time step.
void check_overlaps(const Assembly& assembly, const Case& c) {
  const double gap = c.settings.contact.gap_tolerance;
  const auto overlaps = find_overlaps(assembly, gap);
  if (overlaps.empty()) return;
  const auto name = [&](std::int64_t i) {
    return fmt::format("{} ({})", i, component_names()[std::size_t(assembly.blocks[std::size_t(i)].component)]);
  };
  throw InputError(
      "{}: {}. The first pair, {} and {}, overlaps by {:.3g} m. Move the blocks apart, or raise [contact] "
      "gap_tolerance ({} m).",
      c.assembly_file, counted(overlaps.size(), "pair of blocks overlaps", "pairs of blocks overlap"),
      name(overlaps[0].a), name(overlaps[0].b), overlaps[0].depth, gap);
}

/// Puts the path of the case before its own messages.
template <class Work>
void in_case(const Case& c, Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    throw InputError("{}: {}", c.path, error.what());
  }
}

}  // namespace

void attach_sensors(Assembly& assembly, const std::vector<SensorSpec>& sensors) {
  for (const SensorSpec& sensor : sensors) {
    const auto [block, distance] = nearest_block(assembly, sensor.position);
    if (block < 0 || distance > reach)
      throw InputError(
          "sensor \"{}\" at ({}, {}, {}) m is {:.3g} m away from the nearest block, block {}. Move it onto a block.",
          sensor.id, sensor.position.x(), sensor.position.y(), sensor.position.z(), distance, block);
    assembly.sensors.push_back({sensor.id, sensor.position, sensor.direction, block});
  }
}

Assembly make_assembly(const Case& c) {
  Assembly assembly;
  if (!c.generator.empty()) {
    in_case(c, [&] { assembly = find_generator(c.generator).build(c.generator_input); });
    assembly.generator = c.generator;
  } else {
    assembly = read_assembly(c.assembly_file, careful_search(c.settings.contact.gap_tolerance));
    check_overlaps(assembly, c);
    in_case(c, [&] {
      for (const auto& [pair, joint] : c.generator_input.joints) override_joints(assembly, pair, joint);
    });
    // The copy in a run directory already holds the case's sensors.
    std::erase_if(assembly.sensors, [&](const Sensor& own) {
      return std::any_of(c.sensors.begin(), c.sensors.end(), [&](const SensorSpec& s) { return s.id == own.id; });
    });
  }
  // The copy in a run directory already has the case's effects.
  std::vector<std::string> done = assembly.effects;
  in_case(c, [&] {
    for (const EffectSetting& effect : c.effects) {
      const auto found = std::find(done.begin(), done.end(), effect.text());
      if (found == done.end())
        apply_effect(assembly, effect);
      else
        done.erase(found);
    }
  });
  in_case(c, [&] { check_composite_joints(assembly); });
  assembly.case_text = c.text;
  in_case(c, [&] {
    attach_sensors(assembly, c.sensors);
    for (const EffectSetting& effect : c.effects) apply_effect(assembly.sensors, effect);
  });
  return assembly;
}

}  // namespace voussoir
