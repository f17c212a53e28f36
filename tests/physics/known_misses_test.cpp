// A rung's known miss fails nobody, however far it is off. Here it does when it grows beyond what it was known for.
#include <gtest/gtest.h>

#include <map>

#include "tools/ladder/rung.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Beyond these the reasons given for the misses no longer explain them.
const std::map<std::string, double> known_size = {{"intact-shortcut", 1e-7},
                                                  {"falling-blocks", 0.01},
                                                  {"colliding-blocks", 0.01},
                                                  {"fill-footing", 0.065},
                                                  {"fill-rankine", 0.09}};

TEST(KnownMisses, StayAsSmallAsTheyAre) {
  for (const ladder::Rung& rung : ladder::rungs()) {
    if (rung.slow) continue;  // minutes
    for (const ladder::Finding& finding : rung.climb(1)) {
      if (finding.check.miss.empty()) continue;
      ASSERT_TRUE(known_size.count(rung.name)) << rung.name << " has a known miss without a size";
      EXPECT_LT(std::abs(finding.error()), known_size.at(rung.name)) << rung.name << ": " << finding.check.quantity;
    }
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
