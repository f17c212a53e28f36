// Finds stones that have moved away from their joints during a stage without simulated time. This happens if the solver
// finds no equilibrium, or an equilibrium at another position.
#pragma once
#include <string>
#include <vector>

#include "solver/model/state.h"

namespace voussoir {

/// Placements of the bodies, and patches in contact, before a stage.
struct Standing {
  Array<double> pose;
  Array<std::uint8_t> joint_mode;  // of Model::joints; a stage without simulated time does not change their order
  std::vector<Patch> contacts;     // the closed contacts
  bool drawn = true;               // true: joint displacements count from the placement `pose`; false: from that in
                                   // which the joint was made
};
Standing standing_of(const State& state);

/// Free bodies that have moved away, the farthest first. A body counts if the two faces of one of its joints have moved
/// relative to each other by more than 5 % of the size of the smaller free stone (the cube root of its volume), or have
/// rotated by more than 3°, and if it moved more than the other stone. For a body without contact the same limits hold
/// for its displacement relative to the base. The limits apply to single joints because the deformations of many
/// elastic joints can add up to a large settlement.
std::vector<std::int32_t> moved_away(const Assembly& assembly, const Model& model, const Standing& before,
                                     const State& after);

/// The free bodies that have moved farthest between two placements: at most `count`, and only those that have moved at
/// least a tenth as far as the first. The distance is the displacement of the centroid plus rotation times greatest
/// radius.
std::vector<std::int32_t> farthest_moved(const Model& model, const Array<double>& from, const State& to,
                                         std::size_t count);

/// One line for each body: number, component, place, displacement and rotation since `from`, and which of its joints in
/// `before` hinge or slide during this motion.
std::string moved_text(const Assembly& assembly, const Model& model, const std::vector<std::int32_t>& bodies,
                       const Standing& before, const Array<double>& from, const State& to);

}  // namespace voussoir
