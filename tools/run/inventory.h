// Materials, joints and supports of a bridge, for the summary and the page of a run.
#pragma once
#include <nlohmann/json.hpp>

#include "solver/run/simulation.h"

namespace voussoir {

/// An object with these members:
/// - `materials`: for each material in use its moduli (Pa), density (kg/m3), strengths (Pa), angles (degrees) and
///   mass (kg),
/// - `joints`: for each family of joints (joint_family(); "arch-fill" with a deformable fill) their number, area (m2),
///   ranges of kn and ks (Pa/m), and the laws with the area of each,
/// - `supports`: each group of fixed blocks with the number of blocks,
/// - `supports_each_once`: whether every fixed block is in exactly one of these groups, so that the sum of their
///   reactions is the total reaction,
/// - `weight`: weight of the stones and of the fill that are free to move (N).
nlohmann::json inventory_json(const Simulation& run);

}  // namespace voussoir
