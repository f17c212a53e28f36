// Errors end as sentences do.
#include "solver/base/error.h"

#include <gtest/gtest.h>

#include "io/toml/table_reader.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(Errors, EndWithOneFullStop) {
  EXPECT_STREQ(InputError("{} is {}", "width", 3).what(), "width is 3.");
  EXPECT_STREQ(InputError("{} is {}. It must be positive.", "width", -3).what(), "width is -3. It must be positive.");
  EXPECT_STREQ(InputError("unknown key 'with': did you mean 'width'?").what(),
               "unknown key 'with': did you mean 'width'?");
  EXPECT_STREQ(RunError(std::string("the disk is full (/data)")).what(), "the disk is full (/data).");
  EXPECT_STREQ(RunError("one of: a, b, …").what(), "one of: a, b, …");
  EXPECT_STREQ(InputError("{}: {}", "c.toml", InputError("no width").what()).what(), "c.toml: no width.");
}

TEST(Errors, AListOfLinesHasNoFullStop) {
  EXPECT_STREQ(RunError("no equilibrium. These stones moved:\n  block 1\n  block 2").what(),
               "no equilibrium. These stones moved:\n  block 1\n  block 2");
  EXPECT_STREQ(RunError("the disk is full\nContinue with 'voussoir resume demo'").what(),
               "the disk is full\nContinue with 'voussoir resume demo'.");
}

TEST(Errors, OfATableAreSentences) {
  const toml::table table = toml::parse("width = 'x'\n");
  TableReader reader(table, "c.toml", "[bridge]");
  try {
    reader.fail("width", "is no number");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "c.toml:1: 'width' in [bridge] is no number.");
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
