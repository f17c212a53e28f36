// voussoir vehicles: the library as its page has it, one vehicle, JSON, and a name that is none.
#include <gtest/gtest.h>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(Vehicles, TheLibraryIsTheTableOfItsPage) {
  const Outcome outcome = voussoir({"vehicles"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = bytes_of(VOUSSOIR_SOURCE_DIR "/docs/vehicles.md");
  EXPECT_NE(page.find(outcome.out), std::string::npos) << "put this into docs/vehicles.md:\n" << outcome.out;
}

TEST(Vehicles, OneIsSaidWithAllThatMayBeChosen) {
  const Outcome outcome = voussoir({"vehicles", "cs454-normal-double-1.3", "lm71"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* piece : {"19.00 t", "not checked against the source: track", "impact", "the critical axle",
                            "lift-off rear", "no end", "carefully maintained", "80.00"})
    EXPECT_NE(outcome.out.find(piece), std::string::npos) << piece << "\n" << outcome.out;
}

TEST(Vehicles, AFileOfOnesOwnAsJson) {
  Folder folder;
  folder.write("mine.toml",
               "[vehicle]\ntitle = \"Mine\"\nsource = \"weighed\"\nkind = \"road\"\n[[axle]]\nx = 0\nload = 4e4\n"
               "track = 1.8\nwheel = [0.2, 0.3]\n");
  const Outcome outcome = voussoir({"vehicles", "mine.toml", "--json"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json mine = parse_json(outcome.out, "out")["vehicles"][0];
  EXPECT_EQ(mine["name"], "mine");
  EXPECT_EQ(mine["axle_weight"], 4e4);
  EXPECT_EQ(mine["patches"].size(), 2u);
  EXPECT_EQ(mine["patches"][0]["force"], 2e4);
}

TEST(Vehicles, AWrongNameIsCorrected) {
  expect_error(voussoir({"vehicles", "lm17"}), 2, {"'lm17'", "did you mean 'lm71'", "lm17.toml"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
