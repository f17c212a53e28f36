// Files that come with the program are found from any folder.
#include "solver/base/shipped.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

namespace fs = std::filesystem;

/// The test programs stand below the source tree as the program does.
TEST(Shipped, IsFoundAboveTheProgram) {
  const std::string cases = shipped("cases/validation");
  EXPECT_TRUE(fs::is_directory(cases)) << cases;
  EXPECT_TRUE(fs::path(shipped_library("libvoussoir_mesher.so")).is_absolute());
}

TEST(Shipped, NamesTheFoldersLookedAt) {
  try {
    shipped("no/such/file");
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    for (const std::string word : {"'no/such/file'", "share/voussoir", "copy the file into"})
      EXPECT_NE(text.find(word), std::string::npos) << text;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
