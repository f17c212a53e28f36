// Bed joints of vaults as a table, and their lines of thrust as a figure.
#pragma once
#include <string>
#include <vector>

#include "solver/base/csv.h"
#include "solver/run/simulation.h"
#include "solver/statics/bed_joints.h"

namespace voussoir {

/// The forces at the end of a run: in the last equilibrium of a collapse stage, or after a gravity or quasi-static
/// stage. Empty after a stage in which time passes.
RestForces rest_at_end(const Simulation& run);

/// The bed joints of a state from the checkpoint `file`, which a stage of the kind `stage` has written. Throws
/// InputError if its stones move, if a collapse stage has written it, or if there is no vault.
std::vector<BedJoint> bed_joints_of_state(const Assembly& assembly, const Model& model, const State& state,
                                          StageSettings::Kind stage, const std::string& file);

/// The text of joints.csv (docs/formats.md): one row for each bed joint. The cell of a value that is not finite is
/// empty.
std::string bed_joint_table(const std::vector<BedJoint>& beds);
/// Reads joints.csv. In the result `area` and `torsion` are 0, `n` has its default and `g` is zero; `d` is zero if an
/// earlier version wrote the table without it. Throws InputError for another table.
std::vector<BedJoint> bed_joints_from_table(const TextFile& file);

/// A line of thrust: its name and its bed joints.
struct ThrustLine {
  std::string name;  // name in the legend
  std::vector<BedJoint> beds;
};

/// A chart, seen along y, of intrados and extrados of the rings of the first entry, with the lines of thrust of all
/// entries, one line for each ring. Both axes have the same scale, m. As SVG; empty without a bed joint.
std::string thrust_chart(const std::vector<ThrustLine>& lines);

}  // namespace voussoir
