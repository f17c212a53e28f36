// A case as a list of keys.
#include "io/case/flat_case.h"

#include <gtest/gtest.h>

#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(FlatCase, NamesEveryValue) {
  const auto flat =
      flat_case("a = 1\n[b]\nc = [1.0, 2.5]\ng = 7.2000000000000002\n[[d]]\ne = \"x\"\n[[d]]\nf = true\n", "case.toml");
  EXPECT_EQ(flat.at("a"), "1");
  EXPECT_EQ(flat.at("b.c"), "[1, 2.5]");
  EXPECT_EQ(flat.at("b.g"), "7.2") << "the fewest digits";
  EXPECT_EQ(flat.at("d[1].e"), "'x'");
  EXPECT_EQ(flat.at("d[2].f"), "true");
  EXPECT_EQ(flat.size(), 5u);
  EXPECT_THROW(flat_case("a = [", "case.toml"), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
