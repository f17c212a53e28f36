// A support whose motion differs from the record, because of softer or stiffer soil under it or waves that reach it
// later. Only its base has the displacement factor × u(t − delay), where u is that of the ground (drive_path()).
#include <algorithm>

#include "solver/base/error.h"
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// The drive of the group in the stage; a new one if there is none.
Drive& drive_of(StageSettings& stage, const std::string& group) {
  const auto at =
      std::find_if(stage.drives.begin(), stage.drives.end(), [&](const Drive& d) { return d.group == group; });
  if (at != stage.drives.end()) return *at;
  stage.drives.push_back({});
  stage.drives.back().group = group;
  return stage.drives.back();
}

void apply_support_motion(SolverSettings& settings, const std::string& where, const std::vector<double>& values) {
  // The settings are read before there is an assembly whose only support could be meant.
  if (where.empty())
    throw InputError("effect support_motion: 'where' is missing. Name the support, for example \"pier 0\".");
  for (StageSettings& stage : settings.stages) {
    if (stage.kind != StageSettings::Kind::motion) continue;
    Drive& drive = drive_of(stage, "base " + where);
    drive.factor = values[0];
    drive.delay = values[1];
  }
}

}  // namespace

Effect support_motion() {
  return {
      "support_motion",
      "the motion of one support differs from the ground-motion record",
      "Place a sensor on that support, in addition to the sensor on the ground.",
      {{"factor", "-", "factor on the motion of the ground, for the base of the support", 0.0, 3.0, 1.0, 1.0, 0.3},
       {"delay", "s", "delay of the motion behind that of the ground; negative: earlier", -0.5, 0.5, 0.0, 0.0, 0.05}},
      supports,
      nullptr,
      apply_support_motion};
}

}  // namespace voussoir
