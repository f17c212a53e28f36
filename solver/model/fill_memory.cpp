#include "solver/model/fill_memory.h"

namespace voussoir {

FillMemory initial_fill(const FillModel& fill) {
  FillMemory memory;
  memory.pose.assign(node_width * fill.nodes.size(), 0.0);
  memory.motion.assign(node_width * fill.nodes.size(), 0.0);
  memory.searched.assign(node_width * fill.nodes.size(), 1e18f);  // never looked for: as if they had come from far
  memory.plastic.assign(plastic_width * lane_count * fill.batches.size(), 0.0);
  memory.yield.assign(lane_count * fill.batches.size(), 0);
  memory.lost.assign(4 * fill.tiles.size(), 0.0);
  return memory;
}

void set_fill_branches(const FillModel& fill, FillMemory& memory, int count) {
  const std::size_t rows = 6 * lane_count * fill.batches.size();
  if (memory.branch.size() == rows * std::size_t(count)) return;
  memory.branch.assign(rows * std::size_t(count), 0.0f);
  memory.last.assign(count > 0 ? strain_rows * lane_count * fill.batches.size() : 0, 0.0f);
}

}  // namespace voussoir
