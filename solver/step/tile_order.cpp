#include "solver/step/tile_order.h"

#include <algorithm>

namespace voussoir {

namespace {

/// The fill's tiles come after those of the bodies, whose patches with the fill are read by neither.
void add_fill(const Model& model, const State& state, Dependencies& order) {
  constexpr double interface_cost = 2.0, tet_cost = 1.5;  // of eight, against a batch of joints
  const auto tiles = std::int32_t(model.tiles.size());
  for (const InterfaceBatch& batch : state.interface.batches) {
    order.cost[std::size_t(batch.tile)] += interface_cost;
    std::vector<std::int32_t>& followers = order.followers[std::size_t(batch.tile)];
    for (const auto& corner : batch.node)
      for (const std::int32_t node : corner) followers.push_back(tiles + node / tile_nodes);
  }
  for (auto& followers : order.followers) {
    std::sort(followers.begin(), followers.end());
    followers.erase(std::unique(followers.begin(), followers.end()), followers.end());
  }
  for (const FillTile& tile : model.fill.tiles) {
    auto& followers = order.followers.emplace_back(tile.followers);
    for (std::int32_t& follower : followers) follower += tiles;
    order.cost.push_back(1.0 + tet_cost * (tile.end_batch - tile.first_batch));
  }
}

}  // namespace

Dependencies order_of_tiles(const Model& model, const State& state) {
  constexpr double contact_cost = 2.0;  // of eight, against a batch of joints
  Dependencies order;
  for (const Tile& tile : model.tiles) {
    order.followers.push_back(tile.followers);
    order.cost.push_back(1.0 + tile.end_batch - tile.first_batch);
  }
  for (const ContactBatch& batch : state.contact_batches) order.cost[std::size_t(batch.tile)] += contact_cost;
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (!state.has_contact(i)) continue;
    const JointBatch& batch = state.contact_batches[i / lane_count].patch;
    const std::int32_t a = model.tile_of(batch.body_a(i % lane_count)), b = model.tile_of(batch.body_b(i % lane_count));
    if (a == b) continue;
    std::vector<std::int32_t>& followers = order.followers[std::size_t(std::min(a, b))];
    if (std::find(followers.begin(), followers.end(), std::max(a, b)) == followers.end())
      followers.push_back(std::max(a, b));
  }
  add_fill(model, state, order);
  order.waits.assign(order.followers.size(), 1);
  for (const auto& followers : order.followers)
    for (const std::int32_t follower : followers) ++order.waits[std::size_t(follower)];
  return order;
}

}  // namespace voussoir
