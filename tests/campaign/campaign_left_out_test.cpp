// What a folder of records leaves out stands in the plan, each reason once.
#include <gtest/gtest.h>

#include "tests/campaign/campaign_folder.h"
#include "tools/campaign/plan.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

std::string at2(const std::string& component, const std::string& quantity) {
  return fmt::format(
      "PEER NGA STRONG MOTION DATABASE RECORD\nTown, 1/17/1994, Street, {}\n{} TIME SERIES IN UNITS OF G\n"
      "NPTS=  5, DT=   .0100 SEC,\n  1.0E-02  2.0E-02  3.0E-02  4.0E-02  5.0E-02\n",
      component, quantity);
}

TEST(CampaignPlan, WhatAFolderLeavesOutStandsInThePlan) {
  test::CampaignFolder folder;
  for (const auto& [name, heading] : {std::pair{"009", "9"}, {"099", "99"}, {"-UP", "UP"}}) {
    folder.write(fmt::format("records/RSN1_MUL{}.AT2", name), at2(heading, "ACCELERATION"));
    folder.write(fmt::format("records/RSN1_MUL{}.VT2", name), at2(heading, "VELOCITY"));
    folder.write(fmt::format("records/RSN1_MUL{}.DT2", name), at2(heading, "DISPLACEMENT"));
  }
  folder.write("records/lonely_EW.txt", "0 1\n0.01 2\n");
  const std::string file = folder.write("c.toml", "[campaign]\ncases = [\"column.toml\"]\nrecords = \"records\"\n");
  const Draft draft = make_draft(read_settings(file));
  EXPECT_EQ(draft.plan.records.size(), 1u);
  ASSERT_EQ(draft.plan.left_out.size(), 2u);
  EXPECT_TRUE(draft.plan.left_out[0].starts_with("6 files or recordings (RSN1_MUL-UP.DT2,")) << draft.plan.left_out[0];
  EXPECT_TRUE(draft.plan.left_out[1].starts_with("lonely (EW of one file): two horizontal components"))
      << draft.plan.left_out[1];
  write_draft(draft, folder / "camp");
  EXPECT_EQ(read_plan(folder / "camp").left_out, draft.plan.left_out);
  // A recording in one file of several channels runs as any other.
  folder.write("records/three.csv",
               "time (s), EW (g), NS (g), UD (g)\n0, 0.1, 0.2, 0.3\n0.01, 0, 0.1, 0\n0.02, 0, 0, 0.1\n");
  const Draft more = make_draft(read_settings(file));
  ASSERT_EQ(more.plan.records.size(), 2u);
  write_draft(more, folder / "camp");
  for (const PlannedRun& run : more.plan.runs)
    EXPECT_GT(case_of(more.plan, run, folder / "camp").settings.stages[1].motion.acceleration.at(1).y(), 0.0);
}

TEST(CampaignPlan, WhatEachOfTwoFoldersLeavesOutStandsInThePlan) {
  test::CampaignFolder folder;
  for (const char* place : {"one", "two"}) {
    folder.write(fmt::format("{}/three_{}.csv", place, place),
                 "time (s), EW (g), NS (g), UD (g)\n0, 0.1, 0.2, 0.3\n0.01, 0, 0.1, 0\n0.02, 0, 0, 0.1\n");
    folder.write(fmt::format("{}/lonely{}_EW.txt", place, place), "0 1\n0.01 2\n");
  }
  const std::string file =
      folder.write("c.toml", "[campaign]\ncases = [\"column.toml\"]\nrecords = [\"one\", \"two\"]\n");
  const std::vector<std::string> left_out = make_draft(read_settings(file)).plan.left_out;
  ASSERT_EQ(left_out.size(), 2u);
  EXPECT_TRUE(left_out[0].starts_with("lonelyone")) << left_out[0];
  EXPECT_TRUE(left_out[1].starts_with("lonelytwo")) << left_out[1];
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
