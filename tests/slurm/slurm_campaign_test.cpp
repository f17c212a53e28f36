// Campaigns on a real Slurm, of one node and our own.
#include <gtest/gtest.h>

#include "tests/slurm/cluster.h"
#include "tests/whole/campaigns.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

class SlurmCampaign : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string program = Cluster::missing(); !program.empty())
      GTEST_SKIP() << "no " << program << " here: install slurm-wlm and munge to test campaigns on Slurm";
    cluster = std::make_unique<Cluster>();
    ASSERT_EQ(cluster->trouble(), "");
  }
  Outcome campaign(std::vector<std::string> words) {
    words.insert(words.begin(), "campaign");
    return voussoir(words, {.folder = folder.path(), .environment = cluster->environment()});
  }
  Folder folder;
  std::unique_ptr<Cluster> cluster;
};

/// Names full of traps for shells, and for Slurm, which has its own meaning of %.
TEST_F(SlurmCampaign, BothEnginesGiveTheSameTable) {
  write_campaign(folder, "campaign.toml", "[engine]\nkind = \"slurm\"\nruns_at_once = 2\ntime_limit = 60.0\n");
  const std::string out = "-out 'of' \"$(touch pwned)\" `touch pwned` %j\n\\ line";
  const Outcome slurm = campaign({"campaign.toml", "--output=" + out});
  expect_error(slurm, 1, {"12 runs submitted to Slurm as job", "8 of 12 runs done", "4 failed", "failed: broken__"});
  expect_whole_campaign(folder / out);
  expect_error(campaign({"campaign.toml", "-o", "here", "--engine", "local"}), 1, {"8 of 12 runs done"});
  EXPECT_EQ(table_but_seconds(folder / out), table_but_seconds(folder / "here"));
  EXPECT_FALSE(exists(folder / "pwned"));
  EXPECT_FALSE(exists(folder / (out + "/pwned")));
  const std::string script = bytes_of(folder / (out + "/slurm/job.sh"));
  EXPECT_EQ(script.find("pwned"), std::string::npos) << "a name is in the script: " << script;
}

TEST_F(SlurmCampaign, LeftAloneItGoesOnAndIsGathered) {
  write_long_campaign(folder, 3);
  const Outcome left = campaign({"long.toml", "--engine", "slurm", "--no-wait"});
  ASSERT_EQ(left.status, 0) << left.err;
  const Outcome gathered = campaign({"long", "--engine", "slurm"});
  ASSERT_EQ(gathered.status, 0) << gathered.err;
  EXPECT_EQ(gathered.err.find("submitted"), std::string::npos) << "runs that are there were given to Slurm again";
  EXPECT_FALSE(exists(folder / "long/slurm/batch_002.json"));
  ASSERT_EQ(campaign({"long.toml", "-o", "here", "--engine", "local"}).status, 0);
  EXPECT_EQ(table_but_seconds(folder / "long"), table_but_seconds(folder / "here"));
}

TEST_F(SlurmCampaign, WhatSlurmRefusesIsSaid) {
  write_long_campaign(folder, 1, "[engine]\nkind = \"slurm\"\npartition = \"nowhere\"\n");
  expect_error(campaign({"long.toml"}), 1, {"sbatch refuses the runs", "artition", "--engine local"});
  EXPECT_EQ(campaign({"long.toml", "--engine", "local"}).status, 0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
