// What a bridge is made of and stands on, for the summary and the page of a run.
#pragma once
#include <nlohmann/json.hpp>

#include "solver/run/simulation.h"

namespace voussoir {

/// `materials`: of each that is used its moduli (Pa), density (kg/m3), strengths (Pa), angles (degrees) and how much of
/// it there is (kg). `joints`: of each family of joints (joint_family(); "arch-fill" with a deformable fill) how many,
/// their area (m2), the ranges of kn and ks (Pa/m) and the laws with the area that has each. `supports`: each group of
/// fixed blocks with their number; `supports_each_once`: whether every fixed block is in one of them and in one only,
/// so that their reactions add up to all there are. `weight`: of what is free to move (N), stones and fill.
nlohmann::json inventory_json(const Simulation& run);

}  // namespace voussoir
