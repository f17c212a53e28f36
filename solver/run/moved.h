// Stones that a stage without time has taken away from where their joints held them: because equilibrium was sought in
// vain, or was found somewhere else.
#pragma once
#include <string>
#include <vector>

#include "solver/model/state.h"

namespace voussoir {

/// Who touched whom, and where all stood, before a stage.
struct Standing {
  Array<double> pose;
  Array<std::uint8_t> joint_mode;  // of Model::joints, whose order no stage without time changes
  std::vector<Patch> contacts;     // those that were closed
  bool drawn = true;               // joints were where they are drawn: else they count from where they were made
};
Standing standing_of(const State& state);

/// Free bodies that went elsewhere, the farthest first: the two faces of one of their joints have moved against each
/// other by more than 5 % of the smaller stone's size (the cube root of its volume) or have turned by more than 3°, and
/// it is the one of the two that moved more; or, of a body that touched nothing, the same of itself relative to the
/// base. Elastic joints may add up to any settlement: what counts is one joint's.
std::vector<std::int32_t> moved_away(const Assembly& assembly, const Model& model, const Standing& before,
                                     const State& after);

/// The free bodies that have gone farthest from one placement to another, at most `count` of those that have gone at
/// least a tenth as far as the first: displacement of the centroid plus turn times greatest radius.
std::vector<std::int32_t> farthest_moved(const Model& model, const Array<double>& from, const State& to,
                                         std::size_t count);

/// A line for each body: number, component, place, where it went from `from` and how far it turned, and which of the
/// joints that it had `before` open in a hinge or slide on the way.
std::string moved_text(const Assembly& assembly, const Model& model, const std::vector<std::int32_t>& bodies,
                       const Standing& before, const Array<double>& from, const State& to);

}  // namespace voussoir
