// Colours of stones and fill, and the scales and axes that explain them.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/step/principal_stress.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "viz/colouring.h"
#include "viz/overlay.h"
#include "viz/page/drawing.h"
#include "viz/render.h"
#include "viz/scene.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Stones and fill of one displacement have one colour.
TEST(Colours, OfDisplacementsAreSharedByStonesAndFill) {
  const Assembly assembly = test::heap_on_cube();
  Snapshot snapshot = rest_snapshot(assembly);
  for (Vec3& u : snapshot.fill.displacement) u = {0.02, 0, 0};
  const auto stones = deformed_faces(block_grid(assembly, snapshot), Hidden({}), 1.0);
  const auto fill = deformed_faces(fill_grid(assembly, snapshot), Hidden({}), 1.0);
  EXPECT_EQ(colour_faces(stones, nullptr, "displacement", 0.0).top, 1.0);
  EXPECT_EQ(colour_faces(stones, fill, "displacement", 0.0).top, 20.0);
  const auto red = [](vtkPolyData* faces) { return faces->GetPointData()->GetScalars()->GetComponent(0, 0) / 255.0; };
  EXPECT_NEAR(red(stones), scale_colour(0.0)[0], 0.01);
  EXPECT_NEAR(red(fill), scale_colour(1.0)[0], 0.01);
  EXPECT_EQ(colour_faces(stones, fill, "mode", 0.0).top, 1.0);
  EXPECT_NEAR(red(fill), scale_colour(1.0)[0], 0.01);
}

TEST(Colours, OfTheStressInAFillAreItsLargestCompression) {
  const Assembly assembly = test::heap_on_cube();
  const Snapshot snapshot = test::heap_flowing(assembly);
  const auto stones = deformed_faces(block_grid(assembly, snapshot), Hidden({}), 1.0);
  const auto fill = deformed_faces(fill_grid(assembly, snapshot), Hidden({}), 1.0);
  const Colouring colouring = colour_faces(stones, fill, "stress", 0.0);
  EXPECT_NE(colouring.title.find("kPa"), std::string::npos);
  EXPECT_EQ(colouring.top, 8.0) << "6.03 kPa";
  const double red = fill->GetCellData()->GetScalars()->GetComponent(0, 0) / 255.0;
  EXPECT_NEAR(red, scale_colour(largest_compression(snapshot.fill.tets[0].stress) / 8e3)[0], 0.005);
  EXPECT_EQ(colour_faces(stones, fill, "stress", 4.0).top, 4.0);
  EXPECT_TRUE(colour_faces(stones, fill, "stress", 4.0).exceeded);
}

TEST(Colours, OfAFillNeedOne) {
  const Assembly assembly = test::heap_on_cube();
  const auto stones = deformed_faces(block_grid(assembly, rest_snapshot(assembly)), Hidden({}), 1.0);
  for (const char* by : {"plastic", "yield", "stress"})
    EXPECT_NE(
        test::message_of<InputError>([&] { colour_faces(stones, nullptr, by, 0.0); }).find("needs a deformable fill"),
        std::string::npos);
  EXPECT_EQ(usually_hidden("opening"), std::vector<std::string>{"backfill"});
  EXPECT_TRUE(usually_hidden("yield").empty());
  EXPECT_TRUE(usually_hidden("stress").empty());
}

TEST(Colours, ScaleDarkensSteadily) {
  double last = 1e9;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = scale_colour(i / 100.0);
    const double lightness = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_LT(lightness, last) << i;
    last = lightness;
  }
  for (int c = 0; c < 3; ++c) EXPECT_EQ(scale_colour(0.0)[c], kStone[c]);
}

TEST(Colours, TopOfTheScaleIsRoundAndAFallenStoneDoesNotSetIt) {
  const Assembly assembly = test::arch_and_wall(120);
  Snapshot snapshot = rest_snapshot(assembly);
  const auto scale = [&](double range) {
    return colour_faces(deformed_faces(block_grid(assembly, snapshot), Hidden({}), 1.0), nullptr, "opening", range);
  };
  EXPECT_EQ(scale(0).top, 1.0);  // nothing opened
  for (auto& patch : snapshot.patches) patch.largest_opening = 3.1e-3;
  EXPECT_EQ(scale(0).top, 4.0);
  EXPECT_FALSE(scale(0).exceeded);
  EXPECT_EQ(scale(2.0).top, 2.0);
  EXPECT_TRUE(scale(2.0).exceeded);
  snapshot.patches[30].largest_opening = 4.0;
  EXPECT_EQ(scale(0).top, 4.0);
  EXPECT_TRUE(scale(0).exceeded);
}

TEST(ChartAxis, TicksAreRound) {
  const ChartAxis linear{ChartAxis::Kind::linear, -30.0, 30.0, 0.0, 600.0};
  EXPECT_EQ(linear.ticks(90.0), (std::vector<double>{-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0}));
  EXPECT_EQ(linear.at(0.0), 300.0);
  const ChartAxis log{ChartAxis::Kind::logarithmic, 0.01, 10.0, 0.0, 300.0};
  EXPECT_NEAR(log.at(0.1), 100.0, 1e-9);
  const std::vector<double> ticks = log.ticks(90.0);
  EXPECT_EQ(std::ranges::count(ticks, 0.01) + std::ranges::count(ticks, 0.1) + std::ranges::count(ticks, 1.0), 3);
  const ChartAxis constant = axis_around({5.0, 5.0}, 0.0, 100.0);
  EXPECT_LT(constant.low, 5.0);
  EXPECT_GT(constant.high, 5.0);
  EXPECT_EQ(tick_text(1e-17), "0");
  EXPECT_EQ(nice_below(0.7), 0.5);
}

TEST(NiceAbove, UsesTwoThirdsOfTheScaleAtLeast) {
  EXPECT_EQ(nice_above(261.0), 300.0);
  EXPECT_EQ(nice_above(0.04), 0.04);
  for (double value = 1e-3; value < 1e4; value *= 1.013) {
    EXPECT_GE(nice_above(value), value * (1 - 1e-9));
    EXPECT_LE(nice_above(value), 1.5 * value * (1 + 1e-9)) << value;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
