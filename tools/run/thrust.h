// Bed joints of vaults as a table, and their lines of thrust as a figure.
#pragma once
#include <string>
#include <vector>

#include "solver/base/csv.h"
#include "solver/run/simulation.h"
#include "solver/statics/bed_joints.h"

namespace voussoir {

/// At the end of a run: the last equilibrium of a collapse stage, or what a gravity stage has brought to rest. Empty
/// after a stage in which time passes.
RestForces rest_at_end(const Simulation& run);

/// Of a state from a checkpoint, which errors name `file`, and that a stage of this kind has left or is in. Throws
/// InputError where its stones move or are on their way down after a collapse stage, and where there is no vault.
std::vector<BedJoint> bed_joints_of_state(const Assembly& assembly, const Model& model, const State& state,
                                          StageSettings::Kind stage, const std::string& file);

/// joints.csv (docs/formats.md): a row a bed joint. Cells of what is not finite are empty.
std::string bed_joint_table(const std::vector<BedJoint>& beds);
/// The same read: without widths across, areas and couples, and with d zero where an earlier version wrote the table
/// without it. Throws InputError for another table.
std::vector<BedJoint> bed_joints_from_table(const TextFile& file);

/// What one line of thrust is of.
struct ThrustLine {
  std::string name;  // in the legend
  std::vector<BedJoint> beds;
};

/// The rings of the first, intrados and extrados, and in them the lines of thrust of all, one line a ring, seen along
/// y. Both axes have one scale, m. As SVG; empty without a bed joint.
std::string thrust_chart(const std::vector<ThrustLine>& lines);

}  // namespace voussoir
