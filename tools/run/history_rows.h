// The channels of a run's history, and the row that one sample fills.
#pragma once
#include "geometry/assembly.h"
#include "io/hdf5/history_file.h"
#include "solver/run/simulation.h"

namespace voussoir {

/// Points whose largest displacement is a demand: the groups of the assembly named "keystone …" (x) and "spandrel …"
/// (y).
struct DemandPoint {
  std::string group;
  int axis = 0;
};
std::vector<DemandPoint> demand_points(const Assembly& assembly);
/// "demand/GROUP AXIS"
std::string demand_channel(const DemandPoint& point);

/// All channels, in the order of a row; held_groups: those of fixed blocks.
std::vector<Channel> history_channels(const Assembly& assembly, const std::vector<std::string>& held_groups);
std::vector<double> history_row(const Simulation& run, const Sample& sample);

}  // namespace voussoir
