// The channels of a run's history, and the row of values of one sample.
#pragma once
#include "geometry/assembly.h"
#include "io/hdf5/history_file.h"
#include "solver/run/simulation.h"
#include "tools/run/deck_line.h"

namespace voussoir {

/// Points whose largest displacement is a demand: the groups of the assembly named "keystone …" (x) and "spandrel …"
/// (y). A demand is the mean displacement of the blocks of the group, relative to the base and to the state after
/// gravity.
struct DemandPoint {
  std::string group;
  int axis = 0;  // 0, 1, 2 for x, y, z
};
std::vector<DemandPoint> demand_points(const Assembly& assembly);
/// "demand/GROUP AXIS"
std::string demand_channel(const DemandPoint& point);

/// Groups whose mean displacement and rotation are recorded: those named "keystone …", "quarter …" and "pier top …".
std::vector<std::string> shown_places(const Assembly& assembly);

/// All channels, in the order of a row.
std::vector<Channel> history_channels(const Simulation& run);
/// The values of all channels for one sample. `deck` is used only in runs with quasi-static stages.
std::vector<double> history_row(const Simulation& run, const Sample& sample, const DeckLine& deck);

/// The channels with the increments of quasi-static stages, such as "steps/share", in the order of a row.
const std::vector<std::pair<const char*, double StepRow::*>>& step_channels();

}  // namespace voussoir
