// Damage of a run by structural parts, with the places where it is worst.
#pragma once
#include <nlohmann/json.hpp>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// Of the joints within each part of the bridge (parts_of_blocks(): "arch 0", "pier 1"), and between each two, which
/// are one entry with two `parts`: what damage_sentence() reads, `fill`: whether soil or loose infill is one of them,
/// and `at`: where it opened most, or, where nothing opened, slid most (m, as built for joints of the assembly). The
/// widest first.
nlohmann::json part_damage_json(const Assembly& assembly, const Snapshot& snapshot);

/// "arch 0", "between arch 0 and pier 1".
std::string part_words(const nlohmann::json& entry);
/// "at x = 3.20, y = -1.10, z = 4.25 m".
std::string place_words(const nlohmann::json& place);

}  // namespace voussoir
