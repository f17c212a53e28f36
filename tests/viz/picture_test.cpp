// Pictures and charts: drawn without a display, of the right size, and showing what they should.
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>

#include <cmath>
#include <set>

#include "io/vtk/series.h"
#include "solver/base/error.h"
#include "solver/step/principal_stress.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "viz/annotation.h"
#include "viz/arrows.h"
#include "viz/chart_picture.h"
#include "viz/colouring.h"
#include "viz/display.h"
#include "viz/overlay.h"
#include "viz/page/palette.h"
#include "viz/render.h"
#include "viz/scene.h"
#include "viz/sensor_picture.h"
#include "viz/view.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

struct Picture {
  int width = 0, height = 0;
  std::vector<std::array<unsigned char, 3>> pixels;
  std::size_t colours() const { return std::set(pixels.begin(), pixels.end()).size(); }
  std::size_t differing(const Picture& other) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) n += pixels[i] != other.pixels[i];
    return n;
  }
  /// Share of pixels near a colour.
  double share(const Colour& colour, double within = 0.08) const {
    std::size_t n = 0;
    for (const auto& p : pixels)
      n += std::abs(p[0] / 255.0 - colour[0]) < within && std::abs(p[1] / 255.0 - colour[1]) < within &&
           std::abs(p[2] / 255.0 - colour[2]) < within;
    return double(n) / double(pixels.size());
  }
};

Picture read_png(const std::string& path) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Picture picture{image->GetDimensions()[0], image->GetDimensions()[1], {}};
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i) {
    const double* c = image->GetPointData()->GetScalars()->GetTuple(i);
    picture.pixels.push_back(
        {static_cast<unsigned char>(c[0]), static_cast<unsigned char>(c[1]), static_cast<unsigned char>(c[2])});
  }
  return picture;
}

RenderOptions small(const std::string& view = "front") {
  RenderOptions options;
  options.width = 480;
  options.height = 300;
  options.view = view;
  return options;
}

/// A test without a display of its own, whatever the machine has.
class NoDisplay : public testing::Test {
 protected:
  void SetUp() override { ::unsetenv("DISPLAY"); }
  Folder folder;
};

TEST_F(NoDisplay, ServerComesAndGoes) {
  pid_t server = 0;
  {
    const Display display;
    ASSERT_TRUE(display.own_server());
    server = display.server();
    EXPECT_EQ(::kill(server, 0), 0);
    EXPECT_TRUE(display_is_usable());
    const Display second;  // uses the first one's
    EXPECT_FALSE(second.own_server());
  }
  EXPECT_EQ(::kill(server, 0), -1);
  EXPECT_EQ(::getenv("DISPLAY"), nullptr);
}

TEST_F(NoDisplay, ADisplayThatDoesNotAnswerIsReplacedAndPutBack) {
  ::setenv("DISPLAY", ":64999", 1);
  EXPECT_FALSE(display_is_usable());
  {
    const Display display;
    EXPECT_TRUE(display.own_server());
  }
  EXPECT_STREQ(::getenv("DISPLAY"), ":64999");
  ::unsetenv("DISPLAY");
}

TEST_F(NoDisplay, ServerEndsWithAProcessThatIsKilled) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const Display display;
    const pid_t server = display.server();
    if (::write(ends[1], &server, sizeof server) != sizeof server) ::_exit(1);
    ::pause();
    ::_exit(0);
  }
  pid_t server = 0;
  ASSERT_EQ(::read(ends[0], &server, sizeof server), ssize_t(sizeof server));
  EXPECT_EQ(::kill(server, 0), 0);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  // Whoever adopts it may be slow to collect it: a zombie counts as ended.
  const auto ended = [&] {
    const std::string status = test::bytes_of(fmt::format("/proc/{}/stat", server));
    return status.empty() || status.find(") Z ") != std::string::npos;
  };
  for (int i = 0; i < 500 && !ended(); ++i) ::usleep(10000);
  EXPECT_TRUE(ended());
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(NoDisplay, MissingXvfbIsSaid) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  const std::string message = message_of<InputError>([] { const Display display; });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("Install the package xvfb"), std::string::npos) << message;
}

TEST_F(NoDisplay, PicturesOfAllViewsAndColours) {
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = test::damaged(assembly);
  const Display display;
  std::vector<Picture> pictures;
  for (const std::string view : {"front", "side", "plan", "oblique"}) {
    render_picture(assembly, snapshot, small(view), folder / view + ".png");
    pictures.push_back(read_png(folder / view + ".png"));
  }
  for (const std::string colour : {"slip", "displacement", "component", "stone"}) {
    RenderOptions options = small();
    options.colour = colour;
    render_picture(assembly, snapshot, options, folder / colour + ".png");
    pictures.push_back(read_png(folder / colour + ".png"));
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ(pictures[i].width, 480);
    EXPECT_EQ(pictures[i].height, 300);
    EXPECT_GT(pictures[i].colours(), 100u) << i;
    EXPECT_GT(pictures[i].share({1, 1, 1}, 0.01), 0.2) << i;  // white paper
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(pictures[i].differing(pictures[j]), 500u) << i << " " << j;
  }
}

TEST_F(NoDisplay, TheSamePictureTwiceHasTheSamePixels) {
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = test::damaged(assembly);
  render_picture(assembly, snapshot, small("oblique"), folder / "a.png");
  render_picture(assembly, snapshot, small("oblique"), folder / "b.png");
  EXPECT_EQ(test::bytes_of(folder / "a.png"), test::bytes_of(folder / "b.png"));
}

TEST_F(NoDisplay, OptionsChangeThePicture) {
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = test::damaged(assembly);
  const Display display;
  render_picture(assembly, snapshot, small(), folder / "plain.png");
  const Picture plain = read_png(folder / "plain.png");
  const auto changed = [&](auto change) {
    RenderOptions options = small();
    change(options);
    render_picture(assembly, snapshot, options, folder / "changed.png");
    return read_png(folder / "changed.png");
  };
  EXPECT_GT(plain.differing(changed([](auto& o) { o.hide = {"spandrel"}; })), 3000u);
  EXPECT_GT(plain.differing(changed([](auto& o) { o.amplification = 6; })), 1000u);
  EXPECT_GT(plain.differing(changed([](auto& o) { o.range = 100; })), 1000u);
  EXPECT_GT(plain.differing(changed([](auto& o) { o.title = "A title"; })), 50u);
  const Picture whole = changed([](auto& o) { o.cracks = false; });
  EXPECT_GT(plain.share(kCrack), 2e-3);
  EXPECT_EQ(whole.share(kCrack, 0.05), 0.0);
  EXPECT_GT(changed([](auto& o) {
              o.undeformed = true, o.amplification = 8;
            }).differing(changed([](auto& o) { o.amplification = 8; })),
            100u);
  // Height 0: an arch and a wall 12 m × 4.2 m need less height than 480 × 300.
  const Picture fitted = changed([](auto& o) { o.height = 0; });
  EXPECT_EQ(fitted.width, 480);
  EXPECT_LT(fitted.height, 290);
  EXPECT_GT(fitted.height, 150);
}

TEST_F(NoDisplay, PictureFromStoredFrameEqualsPictureFromState) {
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = test::damaged(assembly);
  VtkSeries series(folder.path());
  series.write(assembly, snapshot);
  const Display display;
  render_picture(assembly, snapshot, small(), folder / "state.png");
  EXPECT_EQ(series.joints().file_at(12.25), "");
  render_picture(
      PictureFiles{series.blocks().file_at(12.5), series.joints().file_at(12.5), series.fill().file_at(12.5)}, small(),
      folder / "frame.png");
  EXPECT_EQ(test::bytes_of(folder / "state.png"), test::bytes_of(folder / "frame.png"));
}

/// An assembly and a state under gravity have no time.
TEST_F(NoDisplay, TheTimeIsSaidOnceSomeHasPassed) {
  const Assembly assembly = test::arch_and_wall();
  Snapshot snapshot = test::damaged(assembly);
  const Display display;
  const double s = letter_size(small().width);
  const auto ink = [&](double time) {  // where the time stands: above the line of the deformations
    snapshot.time = time;
    render_picture(assembly, snapshot, small(), folder / "time.png");
    const Picture picture = read_png(folder / "time.png");
    std::size_t dark = 0;
    for (int y = int(3.0 * s); y < int(3.8 * s); ++y)
      for (int x = int(0.72 * picture.width); x < picture.width; ++x)
        dark += picture.pixels[std::size_t(y * picture.width + x)][1] < 128;
    return dark;
  };
  EXPECT_EQ(ink(0.0), 0u);
  EXPECT_GT(ink(0.5), 20u);
}

/// Each axis has its colour; an arrow at the reader is a ring, and names do not lie on one another.
TEST_F(NoDisplay, SensorsAreArrowsWithNames) {
  const Assembly cubes = test::two_cubes();
  const auto drawn = [&](const std::vector<Sensor>& sensors) {
    const std::string png = folder / "sensors.png";
    RenderOptions options = small();
    options.width = 900, options.height = 700;
    draw_sensors(cubes, sensors, options, png);
    return read_png(png);
  };
  const Vec3 corner(0.5, 0.0, 1.5);
  const Picture bare = drawn({}), along = drawn({{"A01x", corner, Vec3::UnitX(), 1}}),
                upright = drawn({{"A01z", corner, Vec3::UnitZ(), 1}}),
                across = drawn({{"A01y", corner, Vec3::UnitY(), 1}});
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    const Colour colour = arrow_colour(axis);
    EXPECT_LT(bare.share(colour, 0.03), 2e-5);
    EXPECT_GT((axis.x() > 0.0 ? along : axis.y() > 0.0 ? across : upright).share(colour, 0.03), 2e-4);
    EXPECT_EQ(arrow_colour(-axis), colour);
  }
  EXPECT_EQ(arrow_colour(Vec3(0.6, 0.0, 0.8)), kInk);
  const Picture once = drawn({{"A01x", corner, Vec3::UnitX(), 1}}),
                twice = drawn({{"A01x", corner, Vec3::UnitX(), 1}, {"B07x", corner, Vec3::UnitX(), 1}});
  EXPECT_EQ(once.differing(along), 0u);
  EXPECT_GT(once.differing(twice), 100u) << "the second name stands beside the first";
}

TEST_F(NoDisplay, WrongOptionsAreNamed) {
  const Assembly assembly = test::two_cubes();
  const Snapshot snapshot = rest_snapshot(assembly);
  const auto message = [&](auto change) {
    RenderOptions options = small();
    change(options);
    return message_of<InputError>([&] { render_picture(assembly, snapshot, options, folder / "no.png"); });
  };
  EXPECT_NE(message([](auto& o) { o.view = "back"; }).find("front, side, plan or oblique"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.colour = "red"; }).find("opening, slip"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.hide = {"roof"}; }).find("'roof'"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.hide = {"base", "wall"}; }).find("nothing is left"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.cut = "q"; }).find("the cut is 'q'"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.cut = "y=5"; }).find("extends from 0.000 to 1.000 m"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.width = 20; }).find("too small"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "no.png"));
}

TEST_F(NoDisplay, TheFillIsHiddenUntilAskedFor) {
  const Assembly assembly = test::heap_on_cube();
  const Snapshot snapshot = test::heap_flowing(assembly);
  const Display display;
  const auto drawn = [&](auto change) {
    RenderOptions options = small();
    options.amplification = 1.0;
    change(options);
    render_picture(assembly, snapshot, options, folder / "picture.png");
    return read_png(folder / "picture.png");
  };
  const Colour soil = component_colour(Component::backfill);
  EXPECT_EQ(drawn([](auto&) {}).share(soil, 0.03), 0.0);
  EXPECT_GT(drawn([](auto& o) { o.hide = {}; }).share(soil, 0.03), 0.02);
  EXPECT_GT(drawn([](auto& o) { o.hide = {}, o.colour = "component"; }).share(soil, 0.03), 0.02);
  // What yields is seen in its own colour, and in the legend.
  const auto yield = [&](const char* view, const char* cut) {
    return drawn([&](auto& o) { o.hide = {}, o.colour = "yield", o.view = view, o.cut = cut; });
  };
  // A level section is square to the lamps, so that colours are what they mean.
  const Picture plan = yield("plan", "z=0.25"), front = yield("front", "");
  EXPECT_GT(plan.share(kYieldsInShear), 0.01);
  EXPECT_GT(plan.share(kYieldsInTension), 0.01);
  EXPECT_GT(plan.share(kYielded), 0.01);
  EXPECT_LT(front.share(kYieldsInShear), 2e-3);  // behind; in the legend only
  EXPECT_GT(plan.share(kYieldsInShear), 5 * front.share(kYieldsInShear));
  EXPECT_GT(yield("front", "y").share(kYieldsInTension), 0.01);
  // A scale in per cent.
  const Picture plastic = drawn([](auto& o) { o.hide = {}, o.colour = "plastic", o.view = "plan", o.cut = "z=0.25"; });
  EXPECT_GT(plastic.share(scale_colour(1.0)), 0.01);  // 3 % of 3 %
  EXPECT_GT(plastic.differing(drawn(
                [](auto& o) { o.hide = {}, o.colour = "plastic", o.view = "plan", o.cut = "z=0.25", o.range = 5; })),
            500u);
}

TEST_F(NoDisplay, ChartsShowTheirLines) {
  ChartCurve wave{.name = "wave"};
  for (int i = 0; i < 50000; ++i) {
    wave.x.push_back(2e-4 * i);
    wave.y.push_back(std::sin(3.0 * wave.x.back()));
  }
  wave.y[25000] = std::nan("");
  LineChart chart{.title = "Two lines", .x_label = "time (s)", .y_label = "displacement (mm)"};
  chart.width = 600.0, chart.height = 400.0;
  chart.curves = {wave, {.name = "flat", .x = {0.0, 10.0}, .y = {0.5, 0.5}}};
  number_curves(chart);
  write_picture(chart, folder / "chart.png", 900);
  const Picture picture = read_png(folder / "chart.png");
  EXPECT_EQ(picture.width, 900);
  EXPECT_EQ(picture.height, std::lround(1.5 * height_of(chart)));
  EXPECT_GT(picture.share(line_colour(0), 0.15), 2e-3);
  EXPECT_GT(picture.share(line_colour(1), 0.15), 5e-4);
  EXPECT_EQ(picture.share(line_colour(3), 0.05), 0.0);
}

/// A band, dashes, dots and every marker, each in a colour of its own: what a page shows, a picture shows too.
TEST_F(NoDisplay, ChartsShowAllThatPagesShow) {
  LineChart chart{.title = "All", .x_label = "x (-)", .y_label = "y (-)"};
  chart.width = 600.0, chart.height = 400.0;
  // A band that is not convex: filled from corner to corner it would cover the marker below it.
  chart.bands = {{.name = "band", .x = {0, 5, 10}, .low = {1, 8, 1}, .high = {2, 9, 2}, .colour = "#d6e6f2"}};
  chart.curves = {{.name = "dashed", .x = {0, 10}, .y = {10, 10}, .colour = "#0072b2", .dashes = "6 3"},
                  {.name = "dotted", .x = {2, 8}, .y = {0, 0}, .colour = "#e69f00", .dots = true}};
  const char* colours[] = {"#009e73", "#d55e00", "#cc79a7", "#000000"};
  for (int m = 0; m < 4; ++m)
    chart.dots.push_back({.x = {5.0}, .y = {2.0 + m}, .colour = colours[m], .marker = Marker(m)});
  write_picture(chart, folder / "all.png", 1200);
  const Picture picture = read_png(folder / "all.png");
  for (const char* code : {"#d6e6f2", "#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7"}) {
    const auto part = [&](int at) {
      return std::stoi(std::string(code).substr(std::size_t(at), 2), nullptr, 16) / 255.0;
    };
    EXPECT_GT(picture.share({part(1), part(3), part(5)}, 0.02), 1e-5) << code;
  }
  // The band is a stripe of height 1 over a plot of height 10.
  EXPECT_LT(picture.share({0xd6 / 255.0, 0xe6 / 255.0, 0xf2 / 255.0}, 0.01), 0.12);
}

TEST_F(NoDisplay, ChartsWithoutPointsAreRefused) {
  const auto refusal = [&](LineChart chart) {
    return message_of<InputError>([&] { write_picture(chart, folder / "no.png"); });
  };
  LineChart chart{.title = "t"};
  EXPECT_NE(refusal(chart).find("nothing"), std::string::npos);
  chart.curves = {{.name = "x", .x = {1}, .y = {1, 2}}};
  EXPECT_NE(refusal(chart).find("1 x and 2 y"), std::string::npos);
  chart.curves = {{.name = "x", .x = {1}, .y = {-1}}};
  chart.log_y = true;
  EXPECT_NE(refusal(chart).find("above 0"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "no.png"));
}

TEST(Scene, AmplifiesDisplacementsRelativeToTheBase) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.base_displacement = {9, 9, 9};
  snapshot.displacement = {{9, 9, 9}, {9.01, 9, 9}};
  const auto grid = block_grid(assembly, snapshot);
  const auto faces = deformed_faces(grid, Hidden({}), 5.0);
  ASSERT_EQ(faces->GetNumberOfPolys(), 12);
  double box[6];
  faces->GetBounds(box);
  EXPECT_NEAR(box[0], 0.0, 1e-12);  // the fixed cube stays
  EXPECT_NEAR(box[1], 1.05, 1e-12);
  EXPECT_NEAR(box[5], 2.0, 1e-12);
  EXPECT_EQ(deformed_faces(grid, Hidden({"wall"}), 1.0)->GetNumberOfPolys(), 6);
  EXPECT_EQ(outlines(faces)->GetNumberOfLines(), 24);
}

TEST(Scene, CracksAreJointsThatMovedOrLostTheirBond) {
  const Assembly assembly = test::two_cubes();
  const auto count = [&](auto change, const std::vector<std::string>& hide = {}) {
    Snapshot snapshot = rest_snapshot(assembly);
    change(snapshot.patches[0]);
    return crack_patches(joint_polydata(assembly, snapshot), Hidden(hide), 1.0, {})->GetNumberOfPolys();
  };
  EXPECT_EQ(count([](auto&) {}), 0);
  EXPECT_EQ(count([](auto& p) { p.bonded = 0.0; }), 1);
  EXPECT_EQ(count([](auto& p) { p.bonded = 0.0, p.had_bond = false; }), 0);  // a dry joint has none to lose
  EXPECT_EQ(count([](auto& p) { p.largest_opening = 2e-4; }), 1);
  EXPECT_EQ(count([](auto& p) { p.largest_slip = 2e-4; }), 1);
  EXPECT_EQ(count([](auto& p) { p.largest_slip = 2e-4; }, {"wall"}), 0);
}

TEST(View, FitsTheContentIntoItsFrame) {
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 8; ++k) points->InsertNextPoint(k & 1 ? 30.0 : -2.0, k & 2 ? 4.0 : 0.0, k & 4 ? 11.0 : 0.0);
  const Frame frame{0.05, 0.9, 0.2, 0.95};
  const double aspect = 1.8;
  for (const std::string name : {"front", "side", "plan", "oblique"}) {
    vtkNew<vtkCamera> camera;
    fit_camera(camera, find_view(name), points, frame, aspect);
    camera->SetClippingRange(1.0, 1000.0);
    double low[2] = {9, 9}, high[2] = {-9, -9};
    for (vtkIdType i = 0; i < 8; ++i) {
      double p[4] = {0, 0, 0, 1};
      points->GetPoint(i, p);
      camera->GetCompositeProjectionTransformMatrix(aspect, -1, 1)->MultiplyPoint(p, p);
      for (int c = 0; c < 2; ++c) {
        const double share = 0.5 * (p[c] / p[3] + 1.0);
        low[c] = std::min(low[c], share), high[c] = std::max(high[c], share);
      }
    }
    // Centred, inside, and touching the frame one way.
    EXPECT_NEAR(0.5 * (low[0] + high[0]), 0.475, 1e-3) << name;
    EXPECT_NEAR(0.5 * (low[1] + high[1]), 0.575, 1e-3) << name;
    const double fill_x = (high[0] - low[0]) / 0.85, fill_y = (high[1] - low[1]) / 0.75;
    EXPECT_NEAR(std::max(fill_x, fill_y), 1.0, 1e-3) << name;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
