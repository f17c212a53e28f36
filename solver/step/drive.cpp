#include "solver/step/drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

Vec3 Drive::at(double time, double duration) const {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double t = std::clamp(time, 0.0, duration), share = t / duration;
  return t * velocity + (share - std::sin(turn * share) / turn) * displacement;
}

namespace {

const std::vector<std::int64_t>& group_of(const Assembly& assembly, const std::string& name, const std::string& stage) {
  const auto group = assembly.groups.find(name);
  if (group != assembly.groups.end()) return group->second;
  std::vector<std::string> fixed;  // the groups that could be meant
  for (const auto& [other, blocks] : assembly.groups)
    if (std::all_of(blocks.begin(), blocks.end(), [&](std::int64_t b) { return assembly.blocks[b].fixed; }))
      fixed.push_back(other);
  if (fixed.empty())
    throw InputError("stage '{}' drives the group '{}', but the assembly has no group of fixed blocks", stage, name);
  throw InputError("stage '{}' drives the group '{}', which the assembly does not have{}", stage, name,
                   suggestion(name, fixed));
}

}  // namespace

void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  for (const StageSettings& stage : stages) {
    std::set<std::int64_t> driven;
    for (const Drive& drive : stage.drives)
      for (std::int64_t block : group_of(assembly, drive.group, stage.label)) {
        if (!assembly.blocks[block].fixed)
          throw InputError(
              "stage '{}' drives the group '{}', but its block {} is free: only fixed blocks can be driven",
              stage.label, drive.group, block);
        if (!driven.insert(block).second)
          throw InputError("stage '{}' drives block {} twice, the second time in the group '{}'", stage.label, block,
                           drive.group);
      }
  }
}

}  // namespace voussoir
