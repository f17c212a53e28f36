// Damage of a run by parts of the bridge, with the places where it is worst.
#pragma once
#include <nlohmann/json.hpp>

#include "geometry/assembly.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// One entry for the joints within each part of the bridge (parts_of_blocks(): "arch 0", "pier 1"), and one with two
/// `parts` for the joints between each two parts. Each has the members that damage_sentence() reads, `fill` (whether
/// one of the parts is soil or loose infill), and `at`: the place of the largest opening or, if no joint opened, of the
/// largest slip (m, as built for joints of the assembly). The widest comes first.
nlohmann::json part_damage_json(const Assembly& assembly, const Snapshot& snapshot);

/// "arch 0", "between arch 0 and pier 1".
std::string part_words(const nlohmann::json& entry);
/// "at x = 3.20, y = -1.10, z = 4.25 m".
std::string place_words(const nlohmann::json& place);

}  // namespace voussoir
