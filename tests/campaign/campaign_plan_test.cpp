// The plan: names, order, what is the same and what is another run.
#include <gtest/gtest.h>

#include <set>

#include "io/case/motion_source.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tests/campaign/campaign_folder.h"
#include "tools/campaign/json.h"
#include "tools/campaign/outcome.h"
#include "tools/campaign/plan.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

using test::CampaignFolder;
using test::one_record;

TEST(CampaignPlan, SlugsAreTameAndDifferent) {
  std::vector<std::string> taken;
  EXPECT_EQ(slug("L'Aquila 2009 (AQK)", "record", taken), "L-Aquila-2009-AQK");
  EXPECT_EQ(slug("$(touch x)", "record", taken), "touch-x");
  EXPECT_EQ(slug("../../etc", "record", taken), "etc");
  EXPECT_EQ(slug("-rf", "record", taken), "rf");
  EXPECT_EQ(slug("a__b  c", "record", taken), "a_b-c");
  EXPECT_EQ(slug("\n\"';`", "record", taken), "record");
  EXPECT_EQ(slug("çà", "record", taken), "record-2");
  EXPECT_EQ(slug("rf", "record", taken), "rf-2");
  const std::string allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  for (int c = 1; c < 256; ++c) {
    const std::string made = slug(std::string("a") + char(c) + std::string(300, char(c)) + "b", "record", taken);
    EXPECT_EQ(made.find_first_not_of(allowed), std::string::npos) << made;
    EXPECT_LE(made.size(), 44u);
    EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(made.front()))) << made;
  }
  EXPECT_EQ(std::set<std::string>(taken.begin(), taken.end()).size(), taken.size());
}

TEST(CampaignPlan, LimitStatesOfCasesHoldForThemAndChangeNoRun) {
  CampaignFolder folder;
  const std::string limit = "[[limit_state]]\nname = \"out\"\ndemand = \"edp.sensor.top\"\nthreshold = 0.01\n";
  const std::string campaign = "[campaign]\ncases = [\"column.toml\", \"own.toml\"]\n" + one_record +
                               "[[limit_state]]\nname = \"all\"\ndemand = \"edp.keystone_x\"\nthreshold = 0.02\n";
  folder.write("own.toml", test::column_case);
  const Plan before = make_draft(read_settings(folder.write("c.toml", campaign))).plan;
  folder.write("own.toml", test::column_case + limit);
  const Plan plan = make_draft(read_settings(folder / "c.toml")).plan;
  ASSERT_EQ(plan.limit_states.size(), 2u);
  EXPECT_EQ(plan.limit_states[0].only, "");
  EXPECT_EQ(plan.limit_states[1].name, "out");
  EXPECT_EQ(plan.limit_states[1].only, "own");
  EXPECT_EQ(plan.limit_states[1].threshold, 0.01);
  EXPECT_EQ(plan.runs[1].hash, before.runs[1].hash);
}

TEST(CampaignPlan, CasesTimesRecordsTimesScalesTimesSamples) {
  CampaignFolder folder;
  folder.write("sub/column.toml", test::column_case);
  const std::string file = folder.write("c.toml",
                                        "[campaign]\ncases = [\"column.toml\", \"sub/column.toml\"]\n"
                                        "scales = [0.5, 2]\nsamples = 3\n[[campaign.sample]]\n"
                                        "key = \"damping.ratio\"\ndistribution = \"lognormal\"\ncov = 0.1\n" +
                                            one_record +
                                            "[[record]]\nname = \"other\"\nfactor = 2.0\n"
                                            "pulse = { kind = \"sine\", axis = \"y\", amplitude = 1.0, "
                                            "frequency = 1.0 }\n");
  const Plan plan = make_draft(read_settings(file)).plan;
  ASSERT_EQ(plan.runs.size(), 24u);
  EXPECT_EQ(plan.runs[0].id.substr(plan.runs[0].id.find("__")), "__pulse__x0.5__s1");
  EXPECT_EQ(plan.runs[3].scale, 2.0);
  EXPECT_EQ(plan.cases[1].name, "sub/column");
  std::set<std::string> ids;
  std::set<std::uint64_t> hashes;
  for (const PlannedRun& run : plan.runs) ids.insert(run.id), hashes.insert(run.hash);
  EXPECT_EQ(ids.size(), 24u);
  EXPECT_EQ(hashes.size(), 12u) << "the two cases say the same, so do their runs";
  EXPECT_EQ(plan.runs[0].values, plan.runs[12].values);
  EXPECT_NEAR(plan.records[1].measures[0], 2.0, 1e-3) << "measures count the record's own factor";
  EXPECT_EQ(plan.records[1].event, "other");
}

TEST(CampaignPlan, TheFolderSaysTheSamePlan) {
  CampaignFolder folder;
  const Draft draft = make_draft(read_settings(folder.campaign(
      "scales = [0.3, 0.1]\nsamples = 2\n[[campaign.sample]]\nkey = [\"damping.ratio\"]\ndistribution = "
      "\"uniform\"\nlow = 0.01\nhigh = 0.05",
      one_record + "[[limit_state]]\nname = \"a \\\"b\\\"\"\ndemand = \"edp.sensor.top\"\nthreshold = 0.1\ncase = "
                   "\"column\"\n")));
  write_draft(draft, folder / "out");
  const Plan plan = read_plan(folder / "out");
  ASSERT_EQ(plan.runs.size(), draft.plan.runs.size());
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    EXPECT_EQ(plan.runs[i].id, draft.plan.runs[i].id);
    EXPECT_EQ(plan.runs[i].hash, draft.plan.runs[i].hash);
    EXPECT_EQ(plan.runs[i].values, draft.plan.runs[i].values);
    EXPECT_EQ(plan.runs[i].scale, draft.plan.runs[i].scale);
  }
  ASSERT_EQ(plan.limit_states.size(), 1u);
  EXPECT_EQ(plan.limit_states[0].name, "a \"b\"");
  EXPECT_EQ(plan.limit_states[0].only, "column");
}

TEST(CampaignPlan, ARunsCaseIsWhatThePlanSays) {
  CampaignFolder folder;
  folder.write("x.txt", "0.1\n0.2\n-0.1\n0.0\n0.05\n0.0\n");
  const Draft draft = make_draft(read_settings(folder.campaign(
      "scales = [3.0]\nfree_after = 0.7\nduration = 0.03\nfields_every = 0.25\nsamples = 1\n[[campaign.sample]]\n"
      "key = \"materials.masonry.density\"\ndistribution = \"normal\"\ncov = 0.1\n[campaign.set]\n"
      "\"damping.ratio\" = 0.031",
      "[[record]]\nname = \"r\"\nrecord = [\"\", \"x.txt\"]\nunits = \"g\"\ndt = 0.01\nfactor = 2.0\n")));
  write_draft(draft, folder / "out");
  const Plan plan = read_plan(folder / "out");
  std::filesystem::remove(folder / "x.txt");  // the folder is enough
  std::filesystem::remove(folder / "column.toml");
  const Case c = case_of(plan, plan.runs[0], folder / "out");
  ASSERT_EQ(c.settings.stages.size(), 3u);
  EXPECT_EQ(c.settings.stages[1].duration, 0.03);
  EXPECT_EQ(c.settings.stages[2].kind, StageSettings::Kind::free);
  EXPECT_EQ(c.settings.stages[2].duration, 0.7);
  EXPECT_EQ(c.settings.output.fields_every, 0.25);
  EXPECT_NEAR(c.settings.stages[1].motion.acceleration[1].y(), 6.0 * 0.2 * 9.80665, 1e-12);
  EXPECT_EQ(c.generator_input.materials.at("masonry").density, plan.runs[0].values[0]);
  EXPECT_NE(plan.runs[0].values[0], 2000.0);
  EXPECT_EQ(c.settings.damping.ratio, 0.031);
  // The resolved copy, which is what the run's folder holds, is the same again.
  std::filesystem::create_directory(folder / "run");
  write_resolved_case(c, folder / "run");
  const Case copy = read_case(folder / "run/case.toml");
  EXPECT_EQ(copy.settings.stages[1].motion.acceleration, c.settings.stages[1].motion.acceleration);
  EXPECT_EQ(resolved_text(copy), resolved_text(c));
}

/// Of three spans alike that a case gives as one.
TEST(CampaignPlan, ReachesEachEntryOfAList) {
  CampaignFolder folder;
  folder.write(
      "column.toml",
      "[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nclear_span = 4.0\nrepeat = 3\n[[stage]]\nkind = "
      "\"motion\"\nduration = 1.0\npulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, frequency = 1.0 }\n");
  const Draft draft = make_draft(read_settings(folder.campaign(
      "samples = 2\n[[campaign.sample]]\nkey = \"bridge.span.2.clear_span\"\ndistribution = \"normal\"\ncov = 0.1",
      one_record)));
  write_draft(draft, folder / "out");
  const Plan plan = read_plan(folder / "out");
  const Case c = case_of(plan, plan.runs[1], folder / "out");
  EXPECT_EQ(c.generator_input("span.2.clear_span"), plan.runs[1].values[0]);
  EXPECT_NE(plan.runs[1].values[0], 4.0);
  EXPECT_EQ(c.generator_input("span.1.clear_span"), 4.0);
  EXPECT_EQ(c.generator_input("span.3.clear_span"), 4.0);
}

TEST(CampaignPlan, GrowsButDoesNotChange) {
  CampaignFolder folder;
  const auto write = [&](const std::string& lines, const std::string& tables) {
    return test::message_of<InputError>(
        [&] { write_draft(make_draft(read_settings(folder.campaign(lines, tables))), folder / "out"); });
  };
  EXPECT_EQ(write("scales = [1.0]", one_record), "");
  EXPECT_EQ(write("scales = [1.0]", one_record), "");
  EXPECT_EQ(write("scales = [0.5, 1.0]", one_record), "") << "runs may be added, before others too";
  EXPECT_EQ(read_plan(folder / "out").runs.size(), 2u);
  EXPECT_NE(write("scales = [1.0]", one_record).find("which this campaign no longer has"), std::string::npos);
  const std::string other = write("scales = [0.5, 1.0]\nfree_after = 1.0", one_record);
  EXPECT_NE(other.find("column__pulse__x0.5, but its case, record, sample or duration has changed"), std::string::npos)
      << other;
  folder.write("column.toml", test::column_case + "[damping]\nratio = 0.03\n");
  EXPECT_NE(write("scales = [0.5, 1.0]", one_record).find("has changed"), std::string::npos);
}

TEST(CampaignPlan, AForeignFolderIsLeftAlone) {
  CampaignFolder folder;
  folder.write("out/thesis.tex", "x");
  const std::string why = test::message_of<InputError>(
      [&] { write_draft(make_draft(read_settings(folder.campaign(""))), folder / "out"); });
  EXPECT_NE(why.find("files that are not part of a campaign (thesis.tex)"), std::string::npos) << why;
}

TEST(CampaignPlan, SamplesMayBeAdded) {
  CampaignFolder folder;
  const auto plan = [&](int samples) {
    return make_draft(
               read_settings(folder.campaign(fmt::format(
                   "samples = {}\n[[campaign.sample]]\nkey = \"damping.ratio\"\ndistribution = \"lognormal\"\ncov "
                   "= 0.3",
                   samples))))
        .plan;
  };
  const Plan few = plan(2), more = plan(5);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(few.runs[i].id, more.runs[i].id);
    EXPECT_EQ(few.runs[i].hash, more.runs[i].hash);
  }
}

TEST(CampaignPlan, OutcomesBelongToTheirRun) {
  CampaignFolder folder;
  const Draft draft = make_draft(read_settings(folder.campaign("")));
  write_draft(draft, folder / "out");
  PlannedRun run = draft.plan.runs[0];
  EXPECT_EQ(read_outcome(folder / "out", run).status, Status::missing);
  write_outcome(folder / "out", run,
                {Status::failed, "no\nway, see " + (folder / "out") + "/runs/x", 1.5, false, true});
  const Outcome o = read_outcome(folder / "out", run);
  EXPECT_EQ(o.status, Status::failed);
  EXPECT_EQ(o.reason, "no way, see runs/x");
  EXPECT_EQ(o.seconds, 1.5);
  EXPECT_TRUE(o.goes_on);
  ++run.hash;
  EXPECT_EQ(read_outcome(folder / "out", run).status, Status::missing);
  EXPECT_EQ(forget_failures(folder / "out", draft.plan), 1u);
  EXPECT_EQ(read_outcome(folder / "out", draft.plan.runs[0]).status, Status::missing);
  folder.write("out/runs/" + run.id + "/outcome.json", "{ half a fi");
  EXPECT_EQ(read_outcome(folder / "out", draft.plan.runs[0]).status, Status::missing);
}

TEST(CampaignJson, NumbersThatDoNotFitAreRefused) {
  const json numbers = parse_json(
      R"({"beyond": 40296744073709551614, "less": -1, "half": 0.5, "large": 5e9, "whole": 3.0})", "plan.json");
  for (const char* key : {"beyond", "less", "half"})
    EXPECT_THROW(need<std::uint64_t>(numbers, key, "plan.json"), InputError) << key;
  EXPECT_THROW(need<int>(numbers, "large", "plan.json"), InputError);
  EXPECT_EQ(need<int>(numbers, "whole", "plan.json"), 3);
  EXPECT_EQ(need<double>(numbers, "half", "plan.json"), 0.5);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
