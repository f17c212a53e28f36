#include "solver/step/drive.h"

#include <algorithm>
#include <set>

#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/step/loads.h"

namespace voussoir {

Vec3 Drive::at(double time, double duration) const {
  return std::clamp(time, 0.0, duration) * velocity + eased(time, duration) * displacement;
}

Vec3 drive_path(const Drive& drive, const GroundPath& ground, double time, double duration) {
  const Vec3 own = drive.at(time, duration);
  if (drive.with_ground()) return own;
  return own + drive.factor * ground.displacement(time - drive.delay) - ground.displacement(time);
}

const std::vector<std::int64_t>& group_of(const Assembly& assembly, const std::string& name, const std::string& who,
                                          bool fixed) {
  const auto group = assembly.groups.find(name);
  if (group != assembly.groups.end()) return group->second;
  std::vector<std::string> known;  // the groups that could be meant
  for (const auto& [other, blocks] : assembly.groups)
    if (std::all_of(blocks.begin(), blocks.end(), [&](std::int64_t b) { return assembly.blocks[b].fixed == fixed; }))
      known.push_back(other);
  if (known.empty())
    throw InputError("{} the group '{}', but the assembly has no group of {} blocks", who, name,
                     fixed ? "fixed" : "free");
  throw InputError("{} the group '{}', which does not exist in the assembly{}", who, name, suggestion(name, known));
}

void apply_guides(const Assembly& assembly, const std::vector<Guide>& guides, Model& model) {
  for (const Guide& guide : guides)
    for (std::int64_t block : group_of(assembly, guide.group, "a [[guide]] is for", true)) {
      if (!assembly.blocks[std::size_t(block)].fixed)
        throw InputError(
            "a [[guide]] is for the group '{}', but its block {} is already free. Only fixed blocks can be guided.",
            guide.group, block);
      Body& body = model.bodies[std::size_t(model.body_of_block[std::size_t(block)])];
      for (int c = 0; c < 3; ++c)
        if (guide.free[std::size_t(c)]) body.free_ways |= std::uint8_t(1 << c);
      body.turns |= guide.turn;
    }
}

std::vector<std::string> names_held(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& [name, blocks] : assembly.groups)
    if (!blocks.empty() &&
        std::ranges::all_of(blocks, [&](std::int64_t b) { return assembly.blocks[std::size_t(b)].fixed; }))
      names.push_back(name);
  return names;
}

namespace {

void check_against_guide(const StageSettings& stage, const Drive& drive, const Guide& guide) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (!guide.free[c]) continue;
    if (drive.velocity[long(c)] != 0.0 || drive.displacement[long(c)] != 0.0)
      throw InputError(
          "stage '{}' drives the group '{}' along {}, but a [[guide]] leaves it free along this axis. Set this "
          "component to 0, or hold the axis.",
          stage.label, drive.group, "xyz"[c]);
    if (!drive.with_ground())
      throw InputError(
          "stage '{}' moves the group '{}' differently from the ground ('factor', 'delay'), but a [[guide]] leaves it "
          "free along {}. Remove both keys, or hold the axis.",
          stage.label, drive.group, "xyz"[c]);
  }
}

}  // namespace

void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages,
                  const std::vector<Guide>& guides) {
  const auto share_a_block = [&](const std::string& driven, const std::string& guided) {
    const auto one = assembly.groups.find(driven), other = assembly.groups.find(guided);
    if (one == assembly.groups.end() || other == assembly.groups.end()) return false;  // refused elsewhere
    return std::ranges::any_of(one->second, [&](std::int64_t block) {
      return std::ranges::find(other->second, block) != other->second.end();
    });
  };
  for (const StageSettings& stage : stages)
    for (const Drive& drive : stage.drives)
      for (const Guide& guide : guides)
        if (share_a_block(drive.group, guide.group)) check_against_guide(stage, drive, guide);
  for (const StageSettings& stage : stages) {
    std::set<std::int64_t> driven;
    for (const Drive& drive : stage.drives)
      for (std::int64_t block : group_of(assembly, drive.group, "stage '" + stage.label + "' drives", true)) {
        if (!assembly.blocks[block].fixed)
          throw InputError(
              "stage '{}' drives the group '{}', but its block {} is free. Only fixed blocks can be driven.",
              stage.label, drive.group, block);
        if (!driven.insert(block).second)
          throw InputError("stage '{}' drives block {} twice, the second time in the group '{}'", stage.label, block,
                           drive.group);
      }
  }
}

void check_placements(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i)
    for (const Placement& p : stages[i].placements) {
      if (i > 0 && stages[i - 1].timed())
        throw InputError(
            "stage '{}' places the group '{}', but the blocks may be moving at that time. Place them in the first "
            "stage, or in a stage after a gravity stage.",
            stages[i].label, p.group);
      for (std::int64_t block : group_of(assembly, p.group, "stage '" + stages[i].label + "' places", false))
        if (assembly.blocks[std::size_t(block)].fixed)
          throw InputError(
              "stage '{}' places the group '{}', but its block {} is fixed. Only free blocks can be placed.",
              stages[i].label, p.group, block);
    }
}

}  // namespace voussoir
