#include "solver/linear/unknowns.h"

namespace voussoir {

Unknowns number_unknowns(const Model& model) {
  Unknowns unknowns;
  for (const Body& body : model.bodies) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = body.held(c) ? -1 : unknowns.count++;
  }
  unknowns.bodies = model.bodies.size();
  for (const std::uint8_t held : model.fill.held) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = c > 2 || held >> c & 1 ? -1 : unknowns.count++;
  }
  return unknowns;
}

Unknowns without(const Unknowns& unknowns, const std::vector<bool>& held) {
  Unknowns left;
  left.bodies = unknowns.bodies;
  for (std::size_t site = 0; site < unknowns.of.size(); ++site) {
    auto& of = left.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = held[site] || unknowns.of[site][c] < 0 ? -1 : left.count++;
  }
  return left;
}

}  // namespace voussoir
