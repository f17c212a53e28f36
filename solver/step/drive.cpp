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
  throw InputError("{} the group '{}', which the assembly does not have{}", who, name, suggestion(name, known));
}

void check_drives(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  for (const StageSettings& stage : stages) {
    std::set<std::int64_t> driven;
    for (const Drive& drive : stage.drives)
      for (std::int64_t block : group_of(assembly, drive.group, "stage '" + stage.label + "' drives", true)) {
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

void check_placements(const Assembly& assembly, const std::vector<StageSettings>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i)
    for (const Placement& p : stages[i].placements) {
      if (i > 0 && stages[i - 1].timed())
        throw InputError(
            "stage '{}' places the group '{}', but the blocks may be moving then: place them in the first "
            "stage, or in one after a gravity stage",
            stages[i].label, p.group);
      for (std::int64_t block : group_of(assembly, p.group, "stage '" + stages[i].label + "' places", false))
        if (assembly.blocks[std::size_t(block)].fixed)
          throw InputError(
              "stage '{}' places the group '{}', but its block {} is fixed: only free blocks can be placed",
              stages[i].label, p.group, block);
    }
}

}  // namespace voussoir
