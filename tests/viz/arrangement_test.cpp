// The general arrangement drawing: what it measures, what it says, and that no text lies on another.
#include "viz/arrangement/arrangement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/generator.h"
#include "io/case/case.h"
#include "solver/base/constants.h"
#include "tests/viz/noted_drawing.h"
#include "viz/arrangement/hidden_lines.h"
#include "viz/arrangement/measure.h"
#include "viz/arrangement/paper.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::expect_readable;
using test::Noted;

constexpr const char* kTwoSpans = R"(
[bridge]
generator = "bridge"
width = 6.0
fill_over_crown = 0.4
backing_height = 1.2
block_scale = 2.0
[[bridge.span]]
shape = "segmental"
clear_span = 9.0
rise = 2.2
ring_thickness = 0.34
rings = 2
[[bridge.span]]
shape = "segmental"
clear_span = 6.0
rise = 1.6
ring_thickness = 0.34
springing_thickness = 0.5
springing_right = 0.3
[[bridge.pier]]
thickness = 1.6
height = 3.5
batter_x = 0.03
[bridge.abutment.left]
length = 3.0
height = 2.5
[bridge.abutment.right]
length = 4.0
height = 4.0
)";

Assembly built(const std::string& text) {
  return make_assembly(parse_case(text, "drawn.toml", CaseUse::geometry));
}

Block box_at(const Vec3& low, const Vec3& high) {
  Block block;
  block.cells = {make_box(low, high)};
  return block;
}

/// Moves every point.
template <class Move>
Assembly moved(Assembly assembly, Move&& move) {
  for (Block& block : assembly.blocks)
    for (Polyhedron& cell : block.cells)
      for (Vec3& x : cell.vertices) x = move(x);
  assembly.joints.clear();  // they stay behind
  return assembly;
}

TEST(Arrangement, MeasuresWhatTheKeysSay) {
  const Measures m = measure(built(kTwoSpans));
  ASSERT_EQ(m.spans.size(), 2u);
  EXPECT_NEAR(m.spans[0].clear(), 9.0, 1e-9);
  EXPECT_NEAR(m.spans[0].rise, 2.2, 1e-9);
  EXPECT_NEAR(m.spans[0].crown_thickness, 0.34, 1e-9);
  EXPECT_NEAR(m.spans[0].left_thickness, 0.34, 1e-9);
  EXPECT_NEAR(m.spans[0].deck - m.spans[0].extrados, 0.4, 1e-9);
  EXPECT_NEAR(m.spans[1].clear(), 6.0, 1e-9);
  EXPECT_NEAR(m.spans[1].rise, 1.6, 0.02);  // flat faces, and no joint at the crown of an inclined vault
  EXPECT_NEAR(m.spans[1].right_thickness, 0.5, 1e-9);
  EXPECT_NEAR(m.spans[1].right.y() - m.spans[1].left.y(), 0.3, 1e-9);
  EXPECT_EQ(m.spans[0].intrados.front(), m.spans[0].left);
  ASSERT_EQ(m.supports.size(), 3u);
  EXPECT_NEAR(m.supports[0].thickness(), 3.0, 1e-9);
  EXPECT_NEAR(m.supports[0].height(), 2.5, 1e-9);
  EXPECT_NEAR(m.supports[1].thickness(), 1.6, 1e-9);
  EXPECT_NEAR(m.supports[1].height(), 3.5, 1e-9);
  EXPECT_NEAR(m.supports[1].base_x1 - m.supports[1].base_x0, 1.6 + 2.0 * 0.03 * 3.5, 1e-9);
  EXPECT_NEAR(m.supports[2].height(), 4.3, 1e-9);
  EXPECT_NEAR(m.moving.high.x() - m.moving.low.x(), 23.6, 1e-9);
  EXPECT_NEAR(m.skew, 0.0, 1e-9);
}

TEST(Arrangement, SaysTheDimensions) {
  const Assembly assembly = built(kTwoSpans);
  const Arrangement arrangement(assembly, {"two-spans", "generator bridge"});
  Noted drawn;
  arrangement.draw(drawn);
  for (const char* text :
       {"9.00", "6.00", "1.60", "3.00", "4.00", "23.60", "rise 2.20", "ring 0.34", "fill 0.40", "3.50", "2.50", "4.30",
        "5.30", "0.35", "1.20", "two-spans", "General arrangement; generator bridge"})
    EXPECT_TRUE(drawn.says(text)) << text << " is missing among\n" << drawn.all();
  EXPECT_GT(drawn.areas_drawn, 100u);
  EXPECT_EQ(drawn.all().find("skew"), std::string::npos);
  EXPECT_EQ(drawn.all().find("%"), std::string::npos);
  EXPECT_NE(arrangement.svg().find("rise 2.20"), std::string::npos);
}

TEST(Arrangement, MeasuresSkewAndSlope) {
  const double lean = std::tan(radians(20.0));
  const Assembly skewed =
      moved(built(kTwoSpans), [&](const Vec3& x) { return Vec3(x.x() + lean * x.y(), x.y(), x.z()); });
  EXPECT_NEAR(measure(skewed).skew, radians(20.0), 1e-6);
  EXPECT_NEAR(measure(skewed).spans[0].clear(), 9.0, 1e-6);
  Noted drawn;
  Arrangement(skewed, {"skewed", "a test"}).draw(drawn);
  EXPECT_TRUE(drawn.says("skew 20°")) << drawn.all();
  const Assembly sloping =
      moved(built(kTwoSpans), [](const Vec3& x) { return Vec3(x.x(), x.y(), x.z() + 0.03 * x.x()); });
  Noted slope;
  Arrangement(sloping, {"sloping", "a test"}).draw(slope);
  EXPECT_TRUE(slope.says("3 %")) << slope.all();
}

TEST(Arrangement, NoTextLiesOnAnother) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"two spans", kTwoSpans},
      {"cs1", "[bridge]\ngenerator = \"cs1\"\nblock_scale = 3.0\n"},
      {"cs2", "[bridge]\ngenerator = \"cs2\"\nblock_scale = 3.0\nabutments = \"restrained\"\n"},
      {"arch", "[bridge]\ngenerator = \"arch\"\n"},
      {"buttresses", "[bridge]\ngenerator = \"arch\"\nbuttress_height = 6.0\nbuttress_width = 3.0\n"},
      {"wall", "[bridge]\ngenerator = \"wall\"\n"},
      {"column", "[bridge]\ngenerator = \"column\"\nblocks = 40\n"},
      {"one span",
       "[bridge]\ngenerator = \"bridge\"\nblock_scale = 2.0\nparapet_height = 0.0\n"
       "[[bridge.span]]\nclear_span = 2.0\n"},
      {"viaduct",
       "[bridge]\ngenerator = \"bridge\"\nblock_scale = 6.0\n"
       "[[bridge.span]]\nrepeat = 20\nclear_span = 9.0\n[[bridge.pier]]\nheight = 12.0\n"}};
  for (const auto& [name, text] : cases) {
    const Assembly assembly = built(text);
    const Arrangement arrangement(assembly, {name, "generator"});
    Noted drawn;
    arrangement.draw(drawn);
    EXPECT_GE(drawn.words.size(), 12u) << name;
    EXPECT_EQ(drawn.all().find("…"), std::string::npos) << drawn.all();
    expect_readable(arrangement, drawn, name);
  }
}

TEST(Arrangement, TextsAreWrappedAtWords) {
  const std::string text = "Dimensions in m, measured from the blocks. Spans along the middle.";
  const double room = DrawingSheet::width_of("Dimensions in m, measured");
  std::string joined;
  for (const std::string& line : DrawingSheet::wrapped(text, room)) {
    EXPECT_LE(DrawingSheet::width_of(line), room) << line;
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(DrawingSheet::wrapped(text, room).size(), 3u);
  EXPECT_EQ(DrawingSheet::wrapped("unbreakable", 1.0), std::vector<std::string>{"unbreakable"});
}

TEST(Arrangement, StonesApartFromOneAnother) {
  Assembly assembly;
  assembly.materials = {{"stone", 2000.0, 4e9, 1.6e9, 0.0, 0.0, 0.5}};
  assembly.blocks = {box_at({0, 0, 0}, {1, 1, 1}), box_at({3, 0, 0}, {4, 1, 2})};
  finish_blocks(assembly);
  const Arrangement arrangement(assembly, {"apart", "a test"});  // nothing is cut in the middle
  Noted drawn;
  arrangement.draw(drawn);
  EXPECT_TRUE(drawn.says("4.00")) << drawn.all();
  EXPECT_TRUE(drawn.says("2.00")) << drawn.all();
  expect_readable(arrangement, drawn, "apart");
}

TEST(Arrangement, LengthsAreWrittenToTheCentimetre) {
  EXPECT_EQ(length_text(9.0), "9.00");
  EXPECT_EQ(length_text(12.3456), "12.35");
  EXPECT_EQ(length_text(0.34), "0.34");
  EXPECT_EQ(length_text(0.165), "0.165");
}

double length_of(const std::vector<FlatLine>& lines) {
  double sum = 0.0;
  for (const auto& [a, b] : lines) sum += (b - a).norm();
  return sum;
}

/// A unit cube whose lower half stands behind another, which lies apart from it.
TEST(Arrangement, HidesWhatIsBehind) {
  Assembly assembly;
  assembly.blocks = {box_at({0, 0, 0}, {1, 1, 1}), box_at({-1, -3, -1}, {2, -2, 0.5})};
  const FlatView view = flat_view(assembly, seen_from_front());
  ASSERT_EQ(view.faces.size(), 2u);
  const InFront front(view);
  EXPECT_EQ(front.at({0.5, 0.25, 0.0}), 1);
  EXPECT_EQ(front.at({0.5, 0.75, 0.0}), 0);
  EXPECT_EQ(front.at({5.0, 5.0, 0.0}), -1);
  EXPECT_EQ(painting_order(view, front, {0, 1}), (std::vector<std::size_t>{0, 1}));
  const auto lines = visible_lines(view, front, 0.05);
  EXPECT_NEAR(length_of(lines[std::size_t(LineKind::outline)]), 2.0 * (3.0 + 1.5) + 1.0 + 2.0 * 0.5, 0.02);
  EXPECT_EQ(length_of(lines[std::size_t(LineKind::joint)]), 0.0);
}

TEST(Arrangement, CutsAndShowsWhatLiesBeyond) {
  Assembly assembly;
  assembly.blocks = {box_at({0, 0, 0}, {2, 1, 1}), box_at({3, 0, 0}, {4, 1, 2})};
  const FlatView section = flat_view(assembly, seen_from_left(), ViewCut{1.0});
  ASSERT_EQ(section.faces.size(), 2u);  // the cut, and the end face of the other
  EXPECT_TRUE(section.faces.back().cut);
  EXPECT_NEAR(polygon_area(section.faces.back().corners), 1.0, 1e-12);
  EXPECT_EQ(flat_view(assembly, seen_from_left(), ViewCut{1.0, 2.5}).faces.size(), 1u);
  EXPECT_TRUE(cut_faces(assembly, seen_from_left(), 2.5).empty());
}

TEST(Arrangement, ChoosesSheetAndScale) {
  const ViewSize elevation = {30.0, 8.0, 24.0, 24.0, 17.0, 20.0}, plan = {30.0, 6.0, 6.0, 24.0, 17.0, 6.0};
  const ViewSize section = {6.0, 8.0, 7.0, 17.0, 20.0, 19.0};
  Content content = {{elevation, plan}, {section, section}, {{0.0, 0.0, 100.0, 80.0}}};
  const SheetPlan small = place_on_paper(content);
  EXPECT_STREQ(small.paper.name, "A3");
  EXPECT_LE(small.scale, 150.0);
  EXPECT_LE(small.across_scale, small.scale);
  std::vector<SheetBox> boxes = small.stack;
  boxes.insert(boxes.end(), small.across.begin(), small.across.end());
  boxes.insert(boxes.end(), small.notes.begin(), small.notes.end());
  ASSERT_EQ(boxes.size(), 5u);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].meets(boxes[j])) << i << " and " << j;
  content.stack[0].width = content.stack[1].width = 300.0;
  EXPECT_GT(place_on_paper(content).paper.width, 420.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
