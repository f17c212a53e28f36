// What a campaign file may say, and how what it may not is refused: place, value, remedy.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/campaign/campaign_folder.h"
#include "tools/campaign/plan.h"
#include "tools/campaign/sharing.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

using test::CampaignFolder;
using test::one_record;

struct Bad {
  std::string lines, tables;
  std::vector<std::string> pieces;
};

class CampaignError : public testing::TestWithParam<Bad> {};

TEST_P(CampaignError, SaysPlaceAndRemedy) {
  CampaignFolder folder;
  folder.write("two.toml", test::column_case +
                               "[[stage]]\nkind = \"motion\"\nduration = 1.0\npulse = { kind = \"sine\", "
                               "axis = \"x\", amplitude = 1.0, frequency = 5.0 }\n");
  folder.write("empty.json", "{\"records\": []}");
  folder.write("broken.json", "{\"records\": [");
  folder.write("nameless.json", "{\"records\": [{\"files\": [\"x.txt\"]}]}");
  folder.write("lost.json", "{\"records\": [{\"name\": \"a\", \"files\": [\"nowhere.txt\"]}]}");
  folder.write("units.json", "{\"records\": [{\"name\": \"a\", \"files\": [\"x.txt\"], \"units\": \"gal\"}]}");
  folder.write("types.json", "{\"records\": [{\"name\": \"a\", \"files\": \"x.txt\"}]}");
  std::filesystem::create_directory(folder / "nothing");
  const std::string file = folder.campaign(GetParam().lines, GetParam().tables);
  const std::string said = test::message_of<InputError>([&] { make_draft(read_settings(file)); });
  for (const std::string& piece : GetParam().pieces)
    EXPECT_NE(said.find(piece), std::string::npos) << "'" << piece << "' is not in: " << said;
}

const std::string ratio = "samples = 2\n[[campaign.sample]]\nkey = \"damping.ratio\"\n";

INSTANTIATE_TEST_SUITE_P(
    Messages, CampaignError,
    testing::Values(
        Bad{std::string("scalse = [1.0]"), one_record, {"campaign.toml:3", "'scalse'", "did you mean 'scales'?"}},
        Bad{std::string("scales = [0.0]"), one_record, {"campaign.toml:3", "'scales'", "must be above 0"}},
        Bad{std::string("scales = [1.0, 1.0]"), one_record, {"campaign.toml:3", "contains 1 twice"}},
        Bad{std::string("scales = []"), one_record, {"'scales'", "is empty"}},
        Bad{std::string("duration = \"short\""), one_record, {"\"short\"", "significant"}},
        Bad{std::string("periods = [0.333]"), one_record, {"'periods'", "hundredths"}},
        Bad{std::string(""), std::string(""), {"needs 'records'", "selection.json"}},
        Bad{std::string("records = \"nowhere\""),
            std::string(""),
            {"campaign.toml:3", "file or folder does not exist"}},
        Bad{std::string("records = \"nothing\""), std::string(""), {"nothing", "no record"}},
        Bad{std::string("records = \"empty.json\""), std::string(""), {"empty.json", "empty"}},
        Bad{std::string("records = \"broken.json\""),
            std::string(""),
            {"broken.json", "not valid JSON", "motion select"}},
        Bad{std::string("records = \"nameless.json\""), std::string(""), {"record number 1", "no 'name'"}},
        Bad{std::string("records = \"lost.json\""), std::string(""), {"nowhere.txt"}},
        Bad{std::string("records = \"units.json\""), std::string(""), {"gal", "m/s2, g or cm/s2"}},
        Bad{std::string("records = \"types.json\""),
            std::string(""),
            {"record number 1", "'files'", "a list of texts"}},
        Bad{std::string("records = \"empty.json\""), one_record, {"[[record]]", "Remove one"}},
        Bad{std::string("units = \"g\""), one_record, {"'units'", "Give it in each [[record]]"}},
        Bad{std::string(""), one_record + one_record, {"two records with the name \"pulse\""}},
        Bad{std::string(""), std::string("[[record]]\nname = \"r\"\nscale = 2.0\n"), {"'scale'", "'factor'"}},
        Bad{std::string(""), std::string("[[record]]\nname = \"r\"\nrecord = \"no.txt\"\n"), {"no such file"}},
        Bad{std::string("scales = [1e5]"), one_record, {"\"pulse\"", "peak of 2e+05 m/s2"}},
        Bad{std::string("samples = 3"), one_record, {"'samples'", "[[campaign.sample]]"}},
        Bad{ratio + "distribution = \"gauss\"\ncov = 0.1", one_record, {"\"gauss\"", "lognormal, normal, uniform"}},
        Bad{ratio + "distribution = \"normal\"", one_record, {"needs 'cov'"}},
        Bad{ratio + "distribution = \"normal\"\ndeviation = 1e3", one_record, {"sample", "'low'", "damping"}},
        Bad{ratio + "distribution = \"uniform\"\nlow = 2.0\nhigh = 1.0", one_record, {"must be below 'high'"}},
        Bad{std::string("samples = 1\n[[campaign.sample]]\nkey = \"materials.masonry.densty\"\ndistribution = "
                        "\"normal\"\ncov = 0.1"),
            one_record,
            {"'materials.masonry.densty'", "did you mean 'materials.masonry.density'?"}},
        Bad{std::string(
                "samples = 1\n[[campaign.sample]]\nkey = \"stage.2.duration\"\ndistribution = \"normal\"\ncov = "
                "0.1"),
            one_record,
            {"stages cannot be sampled"}},
        Bad{std::string(
                "samples = 1\n[[campaign.sample]]\nkey = \"damping.branches\"\ndistribution = \"normal\"\ncov = "
                "0.1"),
            one_record,
            {"whole number"}},
        Bad{std::string("[campaign.set]\n\"materials.masonry.densty\" = 2000.0"),
            one_record,
            {"[campaign.set]", "'materials.masonry.densty'", "did you mean 'materials.masonry.density'?"}},
        Bad{std::string("[campaign.set]\n\"stage.2.duration\" = 2.0"), one_record, {"stages cannot be set"}},
        Bad{std::string("[campaign.set]\n\"damping.branches\" = 2.0"), one_record, {"[campaign.set]", "whole number"}},
        Bad{std::string("[campaign.set]\n\"damping.ratio\" = -1.0"),
            one_record,
            {"the changes by the campaign", "ratio"}},
        Bad{ratio + "distribution = \"normal\"\ncov = 0.1\n[campaign.set]\n\"damping.ratio\" = 0.03",
            one_record,
            {"campaign.toml", "'damping.ratio'", "is also sampled"}},
        Bad{std::string("block_scale = 2.0"), one_record, {"unknown key 'block_scale'", "the changes by the campaign"}},
        Bad{std::string(""), one_record + "[engine]\nkind = \"pbs\"\n", {"\"pbs\"", "local, slurm"}},
        Bad{std::string(""), one_record + "[engine]\noptions = [\"-p x\"]\n", {"one word for sbatch"}},
        Bad{std::string(""),
            one_record + "[[limit_state]]\nname = \"a\"\ndemand = \"keystone\"\nthreshold = 1.0\n",
            {"\"keystone\"", "edp.keystone_x"}},
        Bad{std::string(""),
            one_record + "[[limit_state]]\nname = \"a\"\ndemand = \"edp.x\"\nthreshold = 1.0\ncase = \"colum\"\n",
            {"\"colum\"", "did you mean 'column'?"}}),
    [](const testing::TestParamInfo<Bad>& bad) { return fmt::format("Line{}", bad.index + 1); });

TEST(CampaignFile, CasesAreChecked) {
  CampaignFolder folder;
  const auto refused = [&](const std::string& cases) {
    const std::string file = folder.write("c.toml", "[campaign]\ncases = " + cases + "\n" + one_record);
    return test::message_of<InputError>([&] { make_draft(read_settings(file)); });
  };
  EXPECT_NE(refused("[\"none.toml\"]").find("c.toml:2"), std::string::npos);
  EXPECT_NE(refused("[]").find("at least one case"), std::string::npos);
  EXPECT_NE(refused("[\"column.toml\", \"column.toml\"]").find("two cases have the name"), std::string::npos);
  folder.write("still.toml", "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"gravity\"\n");
  EXPECT_NE(refused("[\"still.toml\"]").find("has 0 motion stages"), std::string::npos);
  folder.write("bad.toml", "[bridge]\ngenerator = \"colum\"\n");
  EXPECT_NE(refused("[\"bad.toml\"]").find("bad.toml:2"), std::string::npos);
  EXPECT_NE(
      test::message_of<InputError>([&] { read_settings(folder / "column.toml"); }).find("is a case, not a campaign"),
      std::string::npos);
}

TEST(CampaignFile, SelectionsAndFolders) {
  CampaignFolder folder;
  for (const char* name : {"set/AQK_EW.txt", "set/AQK_NS.txt"}) folder.write(name, "0.1\n0.2\n-0.1\n0.0\n");
  folder.write("set/notes.md", "nothing");
  folder.write("s/selection.json",
               "{\"records\": [{\"name\": \"A, \\\"B\\\"\", \"event\": \"E\", \"factor\": 1.5, "
               "\"files\": [\"../set/AQK_EW.txt\", \"\", \"../set/AQK_NS.txt\"], \"units\": \"g\", "
               "\"dt\": 0.01, \"more\": 1}]}");
  const Settings selected = read_settings(folder.campaign("records = \"s/selection.json\"", ""));
  ASSERT_EQ(selected.records.size(), 1u);
  EXPECT_EQ(selected.records[0].name, "A, \"B\"");
  EXPECT_EQ(selected.records[0].source.scale, 1.5);
  EXPECT_EQ(selected.records[0].source.units, "g");
  EXPECT_TRUE(selected.records[0].source.files[1].empty());
  const Settings both = read_settings(folder.campaign("records = [\"s/selection.json\", \"set\"]\nunits = \"g\"", ""));
  ASSERT_EQ(both.records.size(), 2u);
  EXPECT_EQ(both.records[0].name, "A, \"B\"");
  EXPECT_EQ(both.records[1].name, "AQK");
  const Settings found = read_settings(folder.campaign("records = \"set\"\nunits = \"cm/s2\"\ndt = 0.02", ""));
  ASSERT_EQ(found.records.size(), 1u);
  EXPECT_EQ(found.records[0].name, "AQK");
  EXPECT_EQ(found.records[0].source.units, "cm/s2");
  EXPECT_EQ(found.records[0].source.dt, 0.02);
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_NE(found.left_out[0].find("notes.md"), std::string::npos);
}

TEST(CampaignFile, CoresAreSharedSensibly) {
  const auto shared = [](int at_once, int threads, int cores, std::size_t runs) {
    EngineSettings e;
    e.runs_at_once = at_once, e.threads = threads;
    const Sharing s = share_cores(e, cores, runs);
    EXPECT_LE(s.runs * s.threads, cores);
    return std::pair{s.runs, s.threads};
  };
  EXPECT_EQ(shared(0, 0, 8, 100), (std::pair{8, 1}));
  EXPECT_EQ(shared(0, 0, 8, 2), (std::pair{2, 4}));
  EXPECT_EQ(shared(2, 0, 8, 100), (std::pair{2, 4}));
  EXPECT_EQ(shared(0, 4, 8, 100), (std::pair{2, 4}));
  EXPECT_EQ(shared(16, 4, 8, 100), (std::pair{2, 4})) << "a file from a larger machine";
  EXPECT_EQ(shared(0, 64, 8, 100), (std::pair{1, 8}));
  EXPECT_EQ(shared(0, 0, 1, 0), (std::pair{1, 1}));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
