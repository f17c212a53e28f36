// Vehicles as text: what their keys mean, the vehicles that come with the program, and messages for wrong input.
#include "io/traffic/vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/traffic/vehicle_json.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const std::string road =
    "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"road\"\ntrack = 2.0\nwheel = [0.3, 0.4]\n";  // lines 1 to 6
const std::string rail = "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"rail\"\n";              // lines 1 to 4
const std::string track = "[track]\nsleeper = [2.6, 0.25]\nspacing = 0.6\nshares = [0.25, 0.5, 0.25]\n";  // four lines
const std::string axle = "[[axle]]\nx = 0\nload = 1e5\n";                                                 // three lines

Vehicle shipped_one(const std::string& name) {
  const std::string file = std::string(VOUSSOIR_SOURCE_DIR) + "/cases/vehicles/" + name + ".toml";
  return read_vehicle(file);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const std::string& file : test::names_in(std::string(VOUSSOIR_SOURCE_DIR) + "/cases/vehicles"))
    names.push_back(file.substr(0, file.find_last_of('.')));
  return names;
}

double force(const Vehicle& v) {
  double sum = 0.0;
  for (const LoadPatch& patch : v.patches) sum += patch.force;
  return sum;
}

double weight_in_tonnes(const std::string& name) {
  return axle_weight(shipped_one(name)) / (1e3 * standard_gravity);
}

TEST(Vehicle, WheelsOfAnAxle) {
  const Vehicle v =
      parse_vehicle(road + axle + "repeat = 2\nspacing = 1.5\n[[axle]]\nx = 4\ntonnes = 3\ntrack = [0, 2.5, 1]\n",
                    "folder/lorry.toml");
  EXPECT_EQ(v.name, "lorry");
  ASSERT_EQ(v.axles.size(), 3u);
  EXPECT_EQ(v.axles[1].x, 1.5);
  EXPECT_DOUBLE_EQ(v.axles[2].load, 3e3 * standard_gravity);
  ASSERT_EQ(v.patches.size(), 7u);
  EXPECT_EQ(v.patches[0].y, 1.0);
  EXPECT_EQ(v.patches[0].length, 0.3);
  EXPECT_EQ(v.patches[0].width, 0.4);
  EXPECT_EQ(v.patches[0].force, 5e4);
  EXPECT_EQ(v.patches[4].y, 2.5);
  EXPECT_EQ(v.patches[4].axle, 2u);
  EXPECT_NEAR(force(v), axle_weight(v), 1e-9);
  EXPECT_EQ(vehicle_length(v), 4.0);
  EXPECT_DOUBLE_EQ(vehicle_width(v), 2.7 + 1.2);
}

TEST(Vehicle, AnAxleOfATrainIsSharedOutOverSleepers) {
  const Vehicle v = parse_vehicle(rail + track + axle + "[[uniform]]\nfrom = 3\nper_metre = 52e3\n", "train.toml");
  ASSERT_EQ(v.patches.size(), 3u);
  EXPECT_EQ(v.patches[0].x, -0.6);
  EXPECT_EQ(v.patches[0].force, 25e3);
  EXPECT_EQ(v.patches[1].force, 50e3);
  EXPECT_EQ(v.patches[2].x, 0.6);
  EXPECT_EQ(v.patches[2].width, 2.6);
  EXPECT_EQ(v.patches[2].length, 0.25);
  ASSERT_EQ(v.strips.size(), 1u);
  EXPECT_EQ(v.strips[0].width, 2.6);
  EXPECT_DOUBLE_EQ(v.strips[0].pressure, 2e4);
  EXPECT_TRUE(std::isinf(v.strips[0].to));
}

TEST(Vehicle, RepeatedAxlesMayStandBetweenOthers) {
  const Vehicle v = parse_vehicle(
      road + axle + "repeat = 2\nspacing = 10\n[[axle]]\nx = 2\nload = 5e4\nrepeat = 2\nspacing = 10\n", "c.toml");
  ASSERT_EQ(v.axles.size(), 4u);
  EXPECT_EQ(v.axles[1].x, 2.0);
  EXPECT_EQ(v.axles[2].x, 10.0);
  EXPECT_EQ(v.axles[3].load, 5e4);
}

void expect_same_end(double a, double b) {
  EXPECT_TRUE(a == b || std::abs(a - b) < 1e-12) << a << " " << b;
}

void expect_same(const Vehicle& a, const Vehicle& b) {
  ASSERT_EQ(a.axles.size(), b.axles.size());
  for (std::size_t i = 0; i < a.axles.size(); ++i) {
    EXPECT_NEAR(a.axles[i].x, b.axles[i].x, 1e-12);
    EXPECT_EQ(a.axles[i].load, b.axles[i].load);
  }
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_NEAR(a.patches[i].x, b.patches[i].x, 1e-12);
    EXPECT_EQ(a.patches[i].y, b.patches[i].y);
    EXPECT_EQ(a.patches[i].force, b.patches[i].force);
    EXPECT_EQ(a.patches[i].axle, b.patches[i].axle);
  }
  ASSERT_EQ(a.strips.size(), b.strips.size());
  for (std::size_t i = 0; i < a.strips.size(); ++i) {
    expect_same_end(a.strips[i].from, b.strips[i].from);
    expect_same_end(a.strips[i].to, b.strips[i].to);
    EXPECT_EQ(a.strips[i].pressure, b.strips[i].pressure);
  }
  ASSERT_EQ(a.variants.size(), b.variants.size());
  for (std::size_t i = 0; i < a.variants.size(); ++i) EXPECT_EQ(a.variants[i].shares, b.variants[i].shares);
}

TEST(Vehicle, TurnedIsMirroredAlong) {
  const Vehicle v = shipped_one("italy-44t"), back = turned(v);
  ASSERT_EQ(back.axles.size(), 5u);
  EXPECT_EQ(back.axles[0].load, v.axles[4].load);
  EXPECT_NEAR(back.axles[0].x, 0.0, 1e-12);
  EXPECT_NEAR(back.axles[3].x, v.axles[4].x - 3.6, 1e-12);
  EXPECT_EQ(back.axles[3].load, v.axles[1].load);
  for (const LoadPatch& patch : back.patches) EXPECT_NEAR(patch.x, back.axles[patch.axle].x, 1e-12);
  // What stands before the axles stands behind them then.
  const Vehicle train =
      parse_vehicle(rail + track + axle + "[[uniform]]\nfrom = 3\nto = 5\nper_metre = 1e3\n", "t.toml");
  EXPECT_EQ(turned(train).strips[0].from, -5.0);
  EXPECT_EQ(turned(train).strips[0].to, -3.0);
}

TEST(Vehicle, VariantsAndFactorsAreChosenByName) {
  const Vehicle v = shipped_one("cs454-normal-double-1.3");
  const Vehicle front = variant_named(v, "lift-off front");
  EXPECT_DOUBLE_EQ(front.axles[0].load, 1.5 * v.axles[0].load);
  EXPECT_DOUBLE_EQ(front.axles[1].load, 0.5 * v.axles[1].load);
  EXPECT_DOUBLE_EQ(force(front), force(v));
  EXPECT_TRUE(front.variants.empty());
  EXPECT_NE(
      test::message_of<InputError>([&] { variant_named(v, "lift-of front"); }).find("did you mean 'lift-off front'"),
      std::string::npos);

  const DynamicFactor& impact = factor_named(v, "impact");
  EXPECT_TRUE(impact.critical_axle_only);
  const double value = dynamic_factor(impact, 5.0, 0.5);
  EXPECT_EQ(value, 1.8);
  const Vehicle hit = amplified(v, value, 1);
  EXPECT_EQ(hit.axles[0].load, v.axles[0].load);
  EXPECT_DOUBLE_EQ(hit.axles[1].load, 1.8 * v.axles[1].load);
  EXPECT_DOUBLE_EQ(force(hit), 1.4 * force(v));
  EXPECT_NE(test::message_of<InputError>([&] { amplified(v, value, 2); }), "");
  EXPECT_NE(test::message_of<InputError>([&] { factor_named(v, "impct"); }).find("did you mean 'impact'"),
            std::string::npos);
  EXPECT_NE(
      test::message_of<InputError>([&] { factor_named(shipped_one("italy-44t"), "impact"); }).find("has no dynamic"),
      std::string::npos);
}

TEST(Vehicle, DynamicFactorsOfTheEurocode) {
  const Vehicle v = shipped_one("lm71");
  const DynamicFactor& careful = factor_named(v, "carefully maintained");
  const DynamicFactor& standard = factor_named(v, "standard");
  // A span of 20 m has a determinant length of 10 m: 1.44 / (3.1623 - 0.2) + 0.82.
  EXPECT_NEAR(dynamic_factor(careful, 20.0, 0.0), 1.3061, 1e-4);
  EXPECT_NEAR(dynamic_factor(careful, 20.0, 1.0), 1.3061, 1e-4);
  EXPECT_NEAR(dynamic_factor(careful, 20.0, 2.5), 1.1561, 1e-4);
  EXPECT_EQ(dynamic_factor(careful, 20.0, 9.0), 1.0);
  EXPECT_EQ(dynamic_factor(careful, 2.0, 0.0), 1.67);
  EXPECT_EQ(dynamic_factor(careful, 0.01, 0.0), 1.67);
  EXPECT_EQ(dynamic_factor(careful, 400.0, 0.0), 1.0);
  // A report on a railway bridge has 1.1079 for a determinant length of 35 m.
  EXPECT_NEAR(dynamic_factor(standard, 70.0, 0.0), 1.1079, 5e-5);
  EXPECT_EQ(dynamic_factor(standard, 2.0, 0.0), 2.0);
  EXPECT_NE(test::message_of<InputError>([&] { dynamic_factor(careful, 0.0, 0.0); }).find("the span is 0 m"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] { dynamic_factor(careful, 5.0, -1.0); }).find("the cover is -1 m"),
            std::string::npos);
  const Vehicle more = amplified(v, 1.2);
  EXPECT_DOUBLE_EQ(axle_weight(more), 1.2e6);
  EXPECT_DOUBLE_EQ(force(more), 1.2e6);
  EXPECT_DOUBLE_EQ(more.strips[0].pressure * 2.6, 96e3);
}

TEST(VehicleLibrary, EveryOneIsReadAndConsistent) {
  const std::vector<std::string> names = all_names();
  EXPECT_GE(names.size(), 33u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Vehicle v = shipped_one(name);
    EXPECT_EQ(v.name, name);
    EXPECT_NE(v.title, "");
    EXPECT_NE(v.source, "");
    EXPECT_NEAR(force(v), axle_weight(v), 1e-9 * axle_weight(v));
    EXPECT_GT(vehicle_width(v), 0.0);
    expect_same(turned(turned(v)), v);
    for (const VehicleVariant& variant : v.variants)
      EXPECT_NEAR(axle_weight(variant_named(v, variant.name)), axle_weight(v), 1e-9 * axle_weight(v));
    EXPECT_EQ(vehicle_json(v)["name"], name);
  }
}

TEST(VehicleLibrary, EurocodeTotals) {
  const Vehicle lm71 = shipped_one("lm71");
  EXPECT_DOUBLE_EQ(axle_weight(lm71), 4 * 250e3);
  EXPECT_DOUBLE_EQ(vehicle_length(lm71), 4.8);
  ASSERT_EQ(lm71.strips.size(), 2u);
  for (const LoadStrip& strip : lm71.strips) EXPECT_DOUBLE_EQ(strip.pressure * strip.width, 80e3);
  EXPECT_DOUBLE_EQ(lm71.strips[0].to, lm71.axles.front().x - 0.8);
  EXPECT_DOUBLE_EQ(lm71.strips[1].from, lm71.axles.back().x + 0.8);

  for (const auto& [name, load, gap] : {std::tuple("sw-0", 133e3, 5.3), {"sw-2", 150e3, 7.0}}) {
    const Vehicle sw = shipped_one(name);
    ASSERT_EQ(sw.strips.size(), 2u);
    EXPECT_DOUBLE_EQ(sw.strips[0].pressure * sw.strips[0].width, load);
    EXPECT_NEAR(sw.strips[1].from - sw.strips[0].to, gap, 1e-12);
    EXPECT_NEAR(sw.strips[1].to - sw.strips[1].from, sw.strips[0].to - sw.strips[0].from, 1e-12);
  }
  for (const auto& [name, tandem, pressure] : {std::tuple("lm1-lane-1", 600e3, 9e3),
                                               {"lm1-lane-2", 400e3, 2.5e3},
                                               {"lm1-lane-3", 200e3, 2.5e3},
                                               {"lm1-rest", 0.0, 2.5e3}}) {
    const Vehicle lane = shipped_one(name);
    EXPECT_DOUBLE_EQ(axle_weight(lane), tandem) << name;
    EXPECT_EQ(lane.strips[0].pressure, pressure) << name;
    EXPECT_TRUE(std::isinf(lane.strips[0].from) && std::isinf(lane.strips[0].to)) << name;
  }
}

TEST(VehicleLibrary, Tonnes) {
  for (const auto& [name, tonnes] :
       std::initializer_list<std::pair<const char*, double>>{{"cs454-normal-single", 11.5},
                                                             {"cs454-normal-double-1.0", 16.0},
                                                             {"cs454-normal-double-1.3", 19.0},
                                                             {"cs454-normal-double-1.8", 20.0},
                                                             {"cs454-normal-triple-1.0", 21.0},
                                                             {"cs454-normal-triple-1.3", 24.0},
                                                             {"cs454-33t-single", 11.5},
                                                             {"cs454-33t-double", 19.0},
                                                             {"cs454-26t-single", 11.5},
                                                             {"cs454-26t-double", 19.0},
                                                             {"cs454-18t-single", 11.5},
                                                             {"cs454-13t-single", 9.0},
                                                             {"cs454-10t-single", 7.0},
                                                             {"cs454-7.5t-single", 5.5},
                                                             {"cs454-3t-single", 2.0},
                                                             {"cs454-fire-1-single", 10.0},
                                                             {"cs454-fire-2-single", 5.0},
                                                             {"italy-44t", 44.0},
                                                             {"italy-26t", 26.0},
                                                             {"italy-7.5t", 7.5},
                                                             {"italy-3.5t", 3.5},
                                                             {"example-convoy", 450.0}})
    EXPECT_NEAR(weight_in_tonnes(name), tonnes, 1e-9) << name;
  EXPECT_DOUBLE_EQ(axle_weight(shipped_one("fire-engine-1-3.5")), 165e3);
  EXPECT_DOUBLE_EQ(axle_weight(shipped_one("fire-engine-2")), 82e3);
}

TEST(VehicleLibrary, AWrongNameIsCorrected) {
  const std::string message = test::message_of<InputError>([] { read_vehicle("lm72"); });
  EXPECT_NE(message.find("'lm72'"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'lm71'"), std::string::npos) << message;
  EXPECT_NE(message.find("lm72.toml"), std::string::npos) << message;
  EXPECT_EQ(read_vehicle("lm71").axles.size(), 4u);
  EXPECT_NE(test::message_of<InputError>([] { read_vehicle("none/of-these.toml"); }).find("none/of-these.toml"),
            std::string::npos);
}

/// A text of a vehicle, and what the message must hold.
struct Wrong {
  const char* name;
  std::string text;
  std::vector<std::string> expected;
};

const std::vector<Wrong> table = {
    {"NoVehicle", axle, {"v.toml:1:", "needs 'vehicle'", "title, source and kind"}},
    {"UnknownKind",
     "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"raod\"\n" + axle,
     {"v.toml:4: 'kind'", "\"raod\"", "did you mean \"road\""}},
    {"NegativeLoad", road + "[[axle]]\nx = 0\nload = -1e5\n", {"v.toml:9: 'load'", "[[axle]] number 1", "above 0"}},
    {"NoLoad", road + "[[axle]]\nx = 0\n", {"v.toml:7:", "needs 'load'", "in N"}},
    {"TwoLoads", road + axle + "tonnes = 10\n", {"v.toml:10: 'tonnes'", "both given"}},
    {"AxlesOutOfOrder",
     road + "[[axle]]\nx = 3\nload = 1\n" + axle,
     {"v.toml:11: 'x' in [[axle]] number 2", "is 0 m", "previous [[axle]] is 3 m", "front backwards"}},
    {"AxleInFront", road + "[[axle]]\nx = -1\nload = 1\n", {"v.toml:8: 'x'", "is -1. It must be from 0"}},
    {"NoWheel",
     "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"road\"\ntrack = 2\n" + axle,
     {"needs 'wheel'", "in m"}},
    {"NoTrack",
     "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"road\"\nwheel = [0.3, 0.3]\n" + axle,
     {"needs 'track'", "list of the wheels' y"}},
    {"RepeatWithoutSpacing", road + axle + "repeat = 2\n", {"needs 'spacing'", "in m"}},
    {"SpacingWithoutRepeat", road + axle + "spacing = 2\n", {"v.toml:10: 'spacing'", "needs 'repeat'"}},
    {"UnknownKey", road + axle + "lode = 2\n", {"v.toml:10:", "'lode'", "[[axle]] number 1"}},
    {"UniformOfNothing",
     road + "[[uniform]]\nfrom = 3\nto = 2\nwidth = 3\npressure = 9e3\n",
     {"v.toml:9: 'to' in [[uniform]] number 1", "is 2 m", "above 'from', 3 m", "It must be above 'from'"}},
    {"UniformWithoutWidth", road + "[[uniform]]\npressure = 9e3\n", {"v.toml:7:", "needs 'width'"}},
    {"UniformWithoutLoad", road + "[[uniform]]\nwidth = 3\n", {"v.toml:7:", "needs 'per_metre'", "N/m"}},
    {"UniformTwice", road + "[[uniform]]\nwidth = 3\npressure = 1\nper_metre = 3\n", {"'per_metre'", "both given"}},
    {"NoLoadAtAll", road, {"v.toml", "no load", "[[axle]] or [[uniform]]"}},
    {"TrackOfARoad", road + axle + track, {"v.toml:10: [track]", "is only for trains", "\"road\""}},
    {"RailWithoutTrack", rail + axle, {"needs 'track'", "sleepers"}},
    {"WheelOfATrain",
     rail + track + axle + "wheel = [0.3, 0.3]\n",
     {"v.toml:12: 'wheel'", "is only for road vehicles"}},
    {"SharesAreEven",
     rail + "[track]\nsleeper = [2.6, 0.25]\nspacing = 0.6\nshares = [0.5, 0.5]\n" + axle,
     {"v.toml:8: 'shares'", "2 numbers", "odd"}},
    {"SharesDoNotAddUp",
     rail + "[track]\nsleeper = [2.6, 0.25]\nspacing = 0.6\nshares = [0.3, 0.5, 0.3]\n" + axle,
     {"v.toml:8: 'shares'", "1.1", "must be 1"}},
    {"GaugeWiderThanSleepers", rail + track + "gauge = 2.7\n" + axle, {"'gauge'", "2.7 m", "less than", "2.6 m"}},
    {"FactorOfNothing", road + axle + "[[factor]]\nname = \"a\"\nclause = \"b\"\n", {"v.toml:10:", "needs 'value'"}},
    {"FactorOfUnknownFormula",
     road + axle + "[[factor]]\nname = \"a\"\nclause = \"b\"\nformula = \"EN 1991-2 standrad\"\n",
     {"v.toml:13: 'formula'", "did you mean \"EN 1991-2 standard\""}},
    {"FactorTwice",
     road + axle +
         "[[factor]]\nname = \"a\"\nclause = \"b\"\nvalue = 1\n[[factor]]\nname = \"a\"\nclause = \"b\"\nvalue = 2\n",
     {"v.toml:15: 'name'", "which another one has"}},
    {"VariantOfOtherAxles",
     road + axle + "[[variant]]\nname = \"a\"\nclause = \"b\"\nshares = [1.5, 0.5]\n",
     {"v.toml:13: 'shares'", "2 numbers. It must have 1."}},
    {"NotToml", "[vehicle\n", {"v.toml:1:", "not valid TOML"}},
};

class VehicleMessages : public testing::TestWithParam<Wrong> {};

TEST_P(VehicleMessages, NameLineKeyAndRemedy) {
  const std::string message = test::message_of<InputError>([&] { parse_vehicle(GetParam().text, "v.toml"); });
  for (const std::string& piece : GetParam().expected)
    EXPECT_NE(message.find(piece), std::string::npos) << "'" << piece << "' is not in: " << message;
}

INSTANTIATE_TEST_SUITE_P(All, VehicleMessages, testing::ValuesIn(table),
                         [](const auto& one) { return one.param.name; });

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
