// A column of blocks as a shear-flexible cantilever: its first bending frequency for finer and finer blocks.
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

std::vector<Finding> climb_bending_cantilever(int) {
  std::vector<Finding> findings;
  double worst = 0.0;
  for (const auto& [blocks, expected] : {std::pair{10, 2.0325}, std::pair{20, 2.1287}, std::pair{40, 2.1802}}) {
    const std::vector<Mode> modes = modes_of(Bench(bending_column_of(blocks)), 2);
    findings.push_back(near("first bending mode, " + std::to_string(blocks) + " blocks", expected, modes[0].frequency,
                            0.005, "Hz", "discrete shear-flexible beam"));
    worst = std::max(worst, std::abs(modes[1].frequency / modes[0].frequency - 1.0));
  }
  findings.push_back(nothing("difference of the first modes along x and y", worst, 1e-9, "-", "square section"));
  return findings;
}

}  // namespace

Rung bending_cantilever() {
  return {.name = "bending-cantilever",
          .help = "first frequency of a column of 10, 20, 40 blocks",
          .climb = climb_bending_cantilever};
}

}  // namespace voussoir::ladder
