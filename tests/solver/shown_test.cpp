// Values of files and options as messages show them.
#include "solver/base/shown.h"

#include <gtest/gtest.h>

namespace voussoir {
namespace VOUSSOIR_FILE {

TEST(Shown, ShortTextStaysAsItIs) {
  EXPECT_EQ(shown(""), "");
  EXPECT_EQ(shown("arch 3"), "arch 3");
  EXPECT_EQ(shown("Brücke №5 ≥ 3 𝄞"), "Brücke №5 ≥ 3 𝄞");
}

TEST(Shown, LongTextIsCutBetweenCharactersWithItsSize) {
  EXPECT_EQ(shown(std::string(2000000, 'x')), std::string(60, 'x') + "… (2000000 bytes)");
  EXPECT_EQ(shown(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(shown("xüüü", 2), "xü… (7 bytes)");
}

TEST(Shown, BytesThatAreNoTextAreNumbers) {
  EXPECT_EQ(shown("\x1b[31mred\n"), "\\x1b[31mred\\x0a");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b");  // a control character of eight bits
}

TEST(Shown, MessagesKeepTheirWordsAndLoseWhatNoPersonReads) {
  const std::string message = "c.toml:3: 'kind' is \"x\":\n  expected one of: a, b";
  EXPECT_EQ(without_long_words(message), message);
  EXPECT_EQ(without_long_words("is " + std::string(5000, 'x') + ": no"),
            "is " + std::string(100, 'x') + "… (5001 bytes) no");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
