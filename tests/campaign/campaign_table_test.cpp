// The table: every run has a row, every number of its summary a column.
#include <gtest/gtest.h>

#include <cmath>

#include "io/hdf5/h5.h"
#include "tests/campaign/campaign_folder.h"
#include "tools/campaign/outcome.h"
#include "tools/campaign/write_table.h"

namespace voussoir::campaign {
namespace VOUSSOIR_FILE {

using test::CampaignFolder;

const std::string summary = R"({"demand": {"places": {"keystone 0": {"axis": "x", "largest": 0.25, "residual": -0.1}},
  "keystone_x": {"largest_mean": 0.25, "residual_mean": 0.1}},
  "sensors": {"top, left": {"largest": 0.5, "residual": 0.125}},
  "damage": {"arch": {"broken_share": 0.75, "largest_opening": 0.001, "largest_slip": 0.002}}})";

/// Two runs of a record whose name asks for quotes: one done, one failed.
struct Campaign {
  CampaignFolder folder;
  Plan plan;
  Campaign() {
    const Draft draft = make_draft(read_settings(
        folder.campaign("scales = [1.0, 2.0, 4.0]",
                        "[[record]]\nname = \"L'Aquila, \\\"AQK\\\"\\nNS\"\nevent = \"2009\"\n"
                        "pulse = { kind = \"sine\", axis = \"x\", amplitude = 2.0, frequency = 5.0 }\n")));
    plan = draft.plan;
    write_draft(draft, folder / "out");
    folder.write("out/runs/" + plan.runs[0].id + "/summary.json", summary);
    write_outcome(folder / "out", plan.runs[0], {Status::done, "", 12.5, true, false});
    folder.write("out/runs/" + plan.runs[1].id + "/summary.json", summary);  // of a run that failed: not to be trusted
    write_outcome(folder / "out", plan.runs[1], {Status::failed, "block 3, it \"fell\"", 1.0, true, false});
  }
};

TEST(CampaignTable, HasARowForEveryRun) {
  Campaign c;
  const CampaignTable table = gather(c.plan, c.folder / "out");
  const auto value = [&](const std::string& name, std::size_t row) { return table.column(name).values.at(row); };
  EXPECT_EQ(value("edp.keystone_x", 0), 0.25);
  EXPECT_EQ(value("edp.keystone_x.residual", 0), 0.1);
  EXPECT_EQ(value("edp.place.keystone 0", 0), 0.25);
  EXPECT_EQ(value("edp.sensor.top, left.residual", 0), 0.125);
  EXPECT_EQ(value("damage.arch.broken_share", 0), 0.75);
  EXPECT_EQ(table.runs[0].seconds, 12.5);
  EXPECT_TRUE(std::isnan(value("edp.keystone_x", 1)));
  EXPECT_TRUE(std::isnan(table.runs[2].seconds));
  EXPECT_NEAR(value("im.pga", 2), 8.0, 1e-2);
  EXPECT_NEAR(value("im.arias", 1), 4.0 * value("im.arias", 0), 1e-12);
}

TEST(CampaignTable, QuotesWhatRfc4180Quotes) {
  Campaign c;
  const std::string csv = table_text(gather(c.plan, c.folder / "out"));
  EXPECT_TRUE(
      csv.starts_with("run,case,record,event,scale,sample,status,reason,seconds,im.pga,im.pgv,im.arias,im.cav,"
                      "im.d595,im.pga_x,im.pga_y,im.pga_z,im.sa_0.10,"))
      << csv;
  EXPECT_NE(csv.find("x1,column,\"L'Aquila, \"\"AQK\"\" NS\",2009,1,,done,,12.5,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",failed,\"block 3, it \"\"fell\"\"\",1,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",missing,not begun,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",\"edp.sensor.top, left\","), std::string::npos) << csv;
}

TEST(CampaignTable, TheHdf5FileHoldsTheSame) {
  Campaign c;
  write_table(c.plan, c.folder / "out");
  const CampaignTable table = gather(c.plan, c.folder / "out");
  EXPECT_EQ(test::bytes_of(c.folder / "out/table.csv"), table_text(table));
  const h5::File file = h5::File::open(c.folder / "out/table.h5");
  EXPECT_EQ(h5::check_format(file, "voussoir-campaign-table", 1), 1);
  std::vector<std::string> order = fixed_columns();
  for (const NumberColumn& column : table.columns) order.push_back(column.name);
  EXPECT_EQ(file.texts("/", "columns"), order);
  EXPECT_EQ(file.read_texts("columns/record")[0], table.runs[0].record);
  EXPECT_EQ(file.read_texts("columns/status")[1], "failed");
  EXPECT_EQ(file.read<double>("columns/seconds")[0], 12.5);
  EXPECT_EQ(file.unit("columns/im.pgv"), "m/s");
  for (const NumberColumn& column : table.columns) {
    const std::vector<double> read = file.read<double>("columns/" + column.name);
    ASSERT_EQ(read.size(), column.values.size());
    EXPECT_EQ(file.unit("columns/" + column.name), unit_of(c.plan, column.name));
    for (std::size_t i = 0; i < read.size(); ++i)
      EXPECT_TRUE(read[i] == column.values[i] || (std::isnan(read[i]) && std::isnan(column.values[i]))) << column.name;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::campaign
