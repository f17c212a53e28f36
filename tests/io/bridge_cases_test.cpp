// The cases of real bridges (docs/bridges.md) can be read and generated, and their stones have sensible sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "io/case/case.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(BridgeCases, CanBeGenerated) {
  std::vector<std::filesystem::path> cases;
  for (const auto& entry : std::filesystem::directory_iterator(VOUSSOIR_SOURCE_DIR "/cases/bridges"))
    if (entry.path().extension() == ".toml") cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  EXPECT_GE(cases.size(), 11u);
  for (const auto& path : cases) {
    const Assembly assembly = make_assembly(read_case(path.string()));
    EXPECT_GT(assembly.blocks.size(), 200u) << path;
    EXPECT_LT(assembly.blocks.size(), 20000u) << path;
    double least = 1e300, mass = 0.0;
    std::size_t free = 0;
    for (const Block& block : assembly.blocks) {
      if (block.fixed) continue;
      least = std::min(least, block.mass), mass += block.mass, ++free;
    }
    EXPECT_GT(least, 0.02 * mass / double(free)) << path << ": a sliver";
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
