// The table of a campaign, and what its errors say.
#include "tools/campaign/table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const std::string heading = "run,case,record,event,scale,sample,status,reason,seconds,im.pga,edp.spandrel_y\n";

std::string error_of(const std::string& text) {
  try {
    parse_table(text, "DIR/table.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Of a table with the good heading and these rows.
void expect_error(const std::string& rows, const std::string& message) {
  const std::string error = error_of(heading + rows);
  EXPECT_EQ(error.substr(0, message.size()), message);
}

TEST(CampaignTable, IsRead) {
  const CampaignTable t = parse_table(heading +
                                          "a,cs1,r1,e1,2,s1,done,,12.5,1.25,0.004\n"
                                          "b,cs1,r2,,0.5,,collapsed,\"fell, \"\"whole\"\"\",,3,\n"
                                          "c,cs2,r1,,,,missing,,,,\n",
                                      "table.csv");
  ASSERT_EQ(t.runs.size(), 3u);
  EXPECT_EQ(t.runs[0].event, "e1");
  EXPECT_EQ(t.runs[0].scale, 2.0);
  EXPECT_EQ(t.runs[0].seconds, 12.5);
  EXPECT_EQ(t.runs[1].reason, "fell, \"whole\"");
  EXPECT_EQ(t.runs[1].status, RunStatus::collapsed);
  EXPECT_EQ(t.runs[1].row, 3);
  EXPECT_TRUE(std::isnan(t.runs[2].scale));
  EXPECT_EQ(t.column("im.pga").values[0], 1.25);
  EXPECT_TRUE(std::isnan(t.column("edp.spandrel_y").values[1]));
  EXPECT_EQ(t.cases(), (std::vector<std::string>{"cs1", "cs2"}));
  EXPECT_EQ(t.names("edp."), (std::vector<std::string>{"edp.spandrel_y"}));
  EXPECT_EQ(t.find("im.pgv"), nullptr);
}

TEST(CampaignTable, ColumnsInAnyOrderAndSemicolons) {
  const CampaignTable t = parse_table("edp.x;status;record;case;run\n0.5;done;r1;c;a\n", "table.csv");
  EXPECT_EQ(t.column("edp.x").values[0], 0.5);
  EXPECT_EQ(t.runs[0].record, "r1");
}

TEST(CampaignTable, QuotedCellsMayHoldLineBreaks) {
  const CampaignTable t = parse_table(heading +
                                          "a,c,r1,,,,failed,\"no equilibrium:\r\nsee the log\",,1,\n"
                                          "b,c,r2,,,,done,,,2,0.1\n",
                                      "table.csv");
  ASSERT_EQ(t.runs.size(), 2u);
  EXPECT_EQ(t.runs[0].reason, "no equilibrium:\r\nsee the log");
  EXPECT_EQ(t.runs[1].row, 4);  // lines of the file
  expect_error("a,c,r1,,,,failed,\"no end,,1,\n\n", "DIR/table.csv:2: a quoted cell does not end");
}

TEST(CampaignTable, IsWrittenAsItWas) {
  CampaignTable t;
  t.columns = {{std::string("im.pga"), {0.1 + 0.2, std::nan("")}},
               {std::string("edp.place.spandrel y-, 1"), {1e-300, 3.0}}};
  t.runs.resize(2);
  t.runs[0].run = "#1", t.runs[0].case_name = "c;\"d\"", t.runs[0].record = " r", t.runs[0].reason = "two\nlines";
  t.runs[0].status = RunStatus::failed;
  t.runs[1].run = "é", t.runs[1].case_name = "", t.runs[1].scale = 1.0 / 3.0, t.runs[1].seconds = std::nan("");
  const CampaignTable back = parse_table(table_text(t), "back.csv");
  ASSERT_EQ(back.runs.size(), 2u);
  EXPECT_EQ(back.runs[0].run, "#1");
  EXPECT_EQ(back.runs[0].case_name, "c;\"d\"");
  EXPECT_EQ(back.runs[0].record, " r");
  EXPECT_EQ(back.runs[0].reason, "two lines");
  EXPECT_EQ(back.runs[0].status, RunStatus::failed);
  EXPECT_EQ(back.runs[1].scale, 1.0 / 3.0);
  EXPECT_TRUE(std::isnan(back.runs[1].seconds));
  EXPECT_EQ(back.column("im.pga").values[0], 0.1 + 0.2);
  EXPECT_TRUE(std::isnan(back.column("im.pga").values[1]));
  EXPECT_EQ(back.column("edp.place.spandrel y-, 1").values[0], 1e-300);
  EXPECT_EQ(table_text(back), table_text(t));
}

TEST(CampaignTable, SaysWhatIsWrong) {
  EXPECT_EQ(error_of("").substr(0, 37), "DIR/table.csv:1: the file is empty. I");
  EXPECT_EQ(error_of(heading), "DIR/table.csv:1: there are no runs below the heading. Run the campaign first.");
  EXPECT_EQ(error_of("run,case,record\na,b,c\n"),
            "DIR/table.csv:1: the column 'status' is missing. A table of a campaign has the columns run, case, record "
            "and status.");
  EXPECT_EQ(error_of("run,case,record,staus\na,b,c,done\n").substr(0, 66),
            "DIR/table.csv:1: unknown column 'staus': did you mean 'status'?; c");
  EXPECT_EQ(error_of("run,case,record,status,im.\na,b,c,done,1\n").substr(0, 37),
            "DIR/table.csv:1: unknown column 'im.'");
  EXPECT_EQ(error_of("run,case,record,status,im.a,im.a\na,b,c,done,1,1\n").substr(0, 49),
            "DIR/table.csv:1: two columns have the name 'im.a'");
  expect_error("a,c,r,,,,done,,,x,1\n", "DIR/table.csv:2: 'x' in column 'im.pga' is not a number");
  expect_error("a,c,r,,,,done,,,inf,1\n", "DIR/table.csv:2: 'inf' in column 'im.pga' is not a finite number");
  expect_error("a,c,r,,two,,done,,,1,1\n", "DIR/table.csv:2: 'two' in column 'scale' is not a number");
  expect_error("a,c,r,,,,done,,,1,1\nb,c,r,,,,done,,,1\n", "DIR/table.csv:3: the row has 10 cells, the heading has 11");
  expect_error("a,c,r,,,,done,,,1,1,2\n", "DIR/table.csv:2: the row has 12 cells, the heading has 11");
  expect_error("a,c,r,,,,finished,,,1,1\n", "DIR/table.csv:2: 'finished' in column 'status': expected one of: done, ");
  expect_error(",c,r,,,,done,,,1,1\n", "DIR/table.csv:2: the cell in column 'run' is empty");
  expect_error("a,c,r,,,,done,,,1,1\na,c,r,,,,done,,,1,1\n", "DIR/table.csv:3: run 'a' occurs twice");
}

TEST(CampaignTable, AnUnknownColumnIsNamedWithItsNeighbour) {
  const CampaignTable t = parse_table(heading + "a,c,r,,,,done,,,1,1\n", "table.csv");
  try {
    t.column("edp.spandrel");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("table.csv: there is no column 'edp.spandrel': did you mean 'edp.spandrel_y'"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
