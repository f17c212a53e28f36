// The page of a campaign: its demands, whatever they are, and what was drawn for its samples.
#include "tools/campaign/campaign_page.h"

#include <gtest/gtest.h>

#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::bytes_of;
using test::Folder;

std::string page_of(const Folder& folder, const std::string& table) {
  folder.write("table.csv", table);
  write_campaign_page(folder.path());
  return bytes_of(folder / "report.html");
}

bool has(const std::string& page, const std::string& words) {
  return page.find(words) != std::string::npos;
}

TEST(CampaignPage, ShowsTheOnlyDemandAndTheSamples) {
  const Folder folder;
  const std::string page =
      page_of(folder,
              "run,case,record,event,scale,sample,status,material.masonry.friction_angle,im.pga,edp.sensor.top,"
              "edp.sensor.top.residual\n"
              "a,wall,short,e,0.5,1,done,27.105784263338414,3,0.0123,0.0045\n"
              "b,wall,short,e,0.5,2,done,30.75,3,0.0456,0.0078\n");
  EXPECT_TRUE(has(page, "edp.sensor.top, largest relative displacement, mm")) << "the chart";
  EXPECT_TRUE(test::exists(folder / "images/demand_1.svg"));
  EXPECT_TRUE(has(page, "wall, short × 0.5, sample 2: 45.6 mm at 0.306 g"));
  EXPECT_TRUE(has(page, ">masonry.friction_angle</th>")) << page;
  EXPECT_TRUE(has(page, ">edp.sensor.top, mm</th>"));
  EXPECT_TRUE(has(page, "<td class=\"number\">27.11</td>"));
  EXPECT_TRUE(has(page, "<td class=\"number\">12.3</td><td class=\"number\">4.5</td>"));
  EXPECT_FALSE(has(page, "keystones")) << "a column without a value";
}

TEST(CampaignPage, OfABridgeShowsTheMeans) {
  const Folder folder;
  const std::string page = page_of(folder,
                                   "run,case,record,event,scale,sample,status,im.pga,edp.keystone_x,edp.sensor.top\n"
                                   "a,bridge,short,e,1,,done,3,0.0123,0.5\n");
  EXPECT_TRUE(has(page, "Keystones, longitudinal"));
  EXPECT_TRUE(has(page, ">keystones x, mm</th>"));
  EXPECT_FALSE(has(page, "edp.sensor.top"));
  EXPECT_FALSE(has(page, ">sample</th>"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
