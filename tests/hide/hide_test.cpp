// What voussoir hide puts into measurements, and that each draws random numbers of its own.
#include "tools/hide/hide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/generator.h"
#include "io/case/case.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "solver/effects/parts.h"
#include "tests/folder.h"
#include "tools/hide/bridge.h"
#include "tools/hide/instruments.h"
#include "tools/hide/parapet_gaps.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

const std::string small = "[bridge]\ngenerator = \"cs2\"\nblock_scale = 4.0\n";
const std::string walled = "[bridge]\ngenerator = \"cs1\"\nblock_scale = 5.0\n";

/// A bridge as its case draws it, but for what a test asks for.
HideRequest exact(const std::string& case_file) {
  HideRequest request;
  request.case_file = case_file;
  request.noise = request.scatter = request.materials = request.defects = 0.0;
  request.mesh = 1.0;
  request.modes = 3;
  return request;
}

EffectSetting fault(const std::string& where, const std::string& parameter, double value) {
  EffectSetting setting = {"sensor_fault", where, {{parameter, value}}};
  complete(setting);
  return setting;
}

/// How many joints have another stiffness, and that all of those have this share of it.
int changed_joints(const Assembly& before, const Assembly& after, double share) {
  EXPECT_EQ(before.joints.size(), after.joints.size());
  int changed = 0;
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    if (after.joints[i].kn == before.joints[i].kn) continue;
    EXPECT_NEAR(after.joints[i].kn, share * before.joints[i].kn, 1e-12 * before.joints[i].kn);
    ++changed;
  }
  return changed;
}

TEST(Hide, WhatOneDrawsChangesNoOther) {
  const Folder folder;
  HideRequest request;
  request.case_file = folder.write("c.toml", small);
  request.modes = 3;
  const HiddenBridge few = hide(request);
  request.sensors = "rich";
  const HiddenBridge many = hide(request);
  request.noise_said = 0.5;
  const HiddenBridge understated = hide(request);
  ASSERT_EQ(few.measured.modes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const MeasuredMode &a = few.measured.modes[i], &b = many.measured.modes[i], &c = understated.measured.modes[i];
    EXPECT_EQ(a.period, b.period);
    EXPECT_EQ(a.damping, b.damping);
    EXPECT_EQ(b.period, c.period);
    EXPECT_EQ(b.period_std, 2.0 * c.period_std);
    EXPECT_EQ(b.damping_std, 2.0 * c.damping_std);
    for (std::size_t s = 0; s < b.shape.size(); ++s) {
      EXPECT_EQ(b.shape[s].value, c.shape[s].value);
      EXPECT_EQ(b.shape[s].std, 2.0 * c.shape[s].std);
    }
  }
  request.seed = 2;
  EXPECT_NE(hide(request).measured.modes[0].period, many.measured.modes[0].period);
}

TEST(Hide, TheTruthMayHaveOtherKeys) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", small));
  const Case c = read_case(request.case_file, CaseUse::geometry);
  request.truth = {{"fill_bond", "running"}, {"width", "7.4"}};
  const Assembly other = hidden_bridge(c, request);
  Case drawn = c;
  drawn.generator_input.choices["fill_bond"] = "running";
  drawn.generator_input.values["width"] = 7.4;
  EXPECT_EQ(other.blocks.size(), make_assembly(drawn).blocks.size());
  EXPECT_NE(other.blocks.size(), make_assembly(c).blocks.size());
  const auto refused = [&](const std::string& key, const std::string& word) {
    request.truth = {{key, word}};
    return message_of<InputError>([&] { hidden_bridge(c, request); });
  };
  EXPECT_NE(refused("backfil", "none").find("'backfill'"), std::string::npos);
  EXPECT_NE(refused("backfill", "sand").find("rigid, deformable, none"), std::string::npos);
  EXPECT_NE(refused("width", "wide").find("must be a number"), std::string::npos);
  EXPECT_NE(refused("width", "700").find("it must be from 1 to 40"), std::string::npos);
  EXPECT_NE(refused("block_scale", "2").find("--mesh"), std::string::npos);
}

TEST(Hide, ParapetGapsOpenJointsOfTheParapetsOnly) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", walled));
  const Assembly before = hidden_bridge(read_case(request.case_file, CaseUse::geometry), request);
  request.parapet_gaps = 3;
  Assembly after = before;
  EXPECT_EQ(open_parapets(after, request).size(), 3u);
  const int changed = changed_joints(before, after, 1e-3);
  EXPECT_GE(changed, 2);  // two gaps may meet
  EXPECT_LE(changed, 12);
  const BlockSet parapets = component(before, Component::parapet);
  for (std::size_t i = 0; i < before.joints.size(); ++i)
    if (after.joints[i].kn != before.joints[i].kn) {
      EXPECT_TRUE(parapets[std::size_t(before.joints[i].a)] && parapets[std::size_t(before.joints[i].b)]);
    }
  const std::string bare = folder.write("bare.toml", small);
  request.case_file = bare;
  Assembly without = hidden_bridge(read_case(bare, CaseUse::geometry), request);
  EXPECT_NE(message_of<InputError>([&] { open_parapets(without, request); }).find("no parapet"), std::string::npos);
}

TEST(Hide, LoosensWhatLiesInABox) {
  const Assembly before = find_generator("cs2").build([] {
    GeneratorInput input = default_input(find_generator("cs2"));
    input.values["block_scale"] = 4.0;
    return input;
  }());
  Assembly after = before;
  loosen(after, parse_loosening("x=..20 part=arch 0 factor=0.25"));
  const BlockSet arch = masonry_part(before, "arch 0");
  EXPECT_GT(changed_joints(before, after, 0.25), 4);
  for (std::size_t i = 0; i < before.joints.size(); ++i) {
    const Joint& j = before.joints[i];
    const bool in = arch[std::size_t(j.a)] && arch[std::size_t(j.b)] && polygon_centroid(j.polygon).x() <= 20.0;
    EXPECT_EQ(after.joints[i].kn, (in ? 0.25 : 1.0) * j.kn);
  }
  Assembly heavy = before;
  loosen(heavy, parse_loosening("x=10..20 z=15.. density=1.5"));
  double more = 0.0, expected = 0.0;
  for (std::size_t i = 0; i < before.blocks.size(); ++i) {
    const Block& b = before.blocks[i];
    more += heavy.blocks[i].mass - b.mass;
    const bool in = b.centroid.x() >= 10.0 && b.centroid.x() <= 20.0 && b.centroid.z() >= 15.0;
    if (!b.fixed && in) expected += 0.5 * b.mass;
  }
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(more, expected, 1e-9 * expected);

  const auto refused = [&](const std::string& text) {
    return message_of<InputError>([&] {
      Assembly copy = before;
      loosen(copy, parse_loosening(text));
    });
  };
  EXPECT_NE(refused("x=12 factor=0.5").find("12..14"), std::string::npos);
  EXPECT_NE(refused("x=3..1 factor=0.5").find("smaller value first"), std::string::npos);
  EXPECT_NE(refused("x=1..3").find("changes nothing"), std::string::npos);
  EXPECT_NE(refused("facto=0.5").find("'factor'"), std::string::npos);
  EXPECT_NE(refused("part=arch 7 factor=0.5").find("arch 0"), std::string::npos);
  EXPECT_NE(refused("x=900.. factor=0.5").find("no part of the bridge"), std::string::npos);
  EXPECT_NE(refused("factor=-1").find("0.0001 to 1000"), std::string::npos);
  EXPECT_NE(refused("here factor=0.5").find("'here' is not of the form key=value"), std::string::npos);
}

TEST(Hide, PlansOfSensors) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", walled));
  const Assembly bridge = hidden_bridge(read_case(request.case_file, CaseUse::geometry), request);
  const auto plan = [&](const std::string& word, std::uint64_t seed) {
    request.sensors = word;
    request.seed = seed;
    return instruments(bridge, request);
  };
  const auto names = [](const std::vector<MeasuredSensor>& sensors) {
    std::vector<std::string> all;
    for (const MeasuredSensor& s : sensors) all.push_back(s.id);
    return all;
  };
  const std::vector<std::string> rich = names(plan("rich", 1));
  for (const int n : {5, 13, 38, 40})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const std::vector<MeasuredSensor> sensors = plan(std::to_string(n), seed);
      ASSERT_EQ(int(sensors.size()), n);
      EXPECT_EQ(names(sensors), names(plan(std::to_string(n), seed)));
      Vec3 axes = Vec3::Zero();
      for (const MeasuredSensor& s : sensors) axes += s.direction;
      EXPECT_GT(axes.minCoeff(), 0.0) << n;
      if (n > 38) continue;
      for (const std::string& id : names(sensors)) EXPECT_NE(std::find(rich.begin(), rich.end(), id), rich.end());
    }
  EXPECT_NE(names(plan("13", 1)), names(plan("13", 2)));
  const auto refused = [&](const std::string& word) { return message_of<InputError>([&] { plan(word, 1); }); };
  EXPECT_NE(refused("4").find("5 to 40"), std::string::npos);
  EXPECT_NE(refused("7.5").find("whole"), std::string::npos);
  EXPECT_NE(refused("many").find("sparse, rich"), std::string::npos);

  const std::string table = folder.write("plan.csv", "id,x,y,z,direction\na,10,-3.55,16,y\nb,10,-3.55,16,0.6;0;0.8\n");
  EXPECT_EQ(names(plan(table, 1)), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(plan(table, 1)[1].direction, Vec3(0.6, 0.0, 0.8));
  EXPECT_NE(refused(folder / "none.csv").find("no such file"), std::string::npos);
  folder.write("plan.csv", "id,x,y,z,direction\na,10,-3.55,16,up\n");
  EXPECT_NE(refused(table).find("plan.csv:2"), std::string::npos);
  folder.write("plan.csv", "id,x,y,z,direction,unit\na,10,-3.55,16,y,mm/s\n");
  EXPECT_NE(refused(table).find("plan.csv:2"), std::string::npos);
  folder.write("plan.csv", "id,x,y,z,direction\na,10,-3.55,16,y\nfar,10,-30,16,y\n");
  request.sensors = table;
  const std::string far = message_of<InputError>([&] { hide(request); });
  EXPECT_NE(far.find("plan.csv:3"), std::string::npos) << far;
  EXPECT_NE(far.find("'far'"), std::string::npos) << far;
}

/// A plan is noted on the drawing; the bridge may be longer.
TEST(Hide, SensorsAreWhereTheDrawingHasThem) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", small));
  const std::vector<MeasuredSensor> drawn = hide(request).measured.sensors;
  request.truth = {{"span_0_clear", "16.4"}};
  const HiddenBridge longer = hide(request);
  ASSERT_EQ(longer.measured.sensors.size(), drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(longer.measured.sensors[i].position, drawn[i].position);
}

/// A channel on a wrong axis shows what that axis shows; a dead one shows noise.
TEST(Hide, FaultsOfSensorsShowInShapesAndRecordings) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", small));
  request.sensors = folder.write("plan.csv",
                                 "id,x,y,z,direction\nkx,15,-3.5,21.99,x\nky,15,-3.5,21.99,y\nkz,15,-3.5,21.99,z\n"
                                 "px,30,-3.5,21.99,x\npy,30,-3.5,21.99,y\npz,30,-3.5,21.99,z\n");
  const Measured sound = hide(request).measured;
  request.effects = {fault("channel kx", "turn", 90.0), fault("channel pz", "gain", 0.0)};
  const Measured faulty = hide(request).measured;
  for (std::size_t i = 0; i < sound.modes.size(); ++i) {
    const auto &a = sound.modes[i].shape, &b = faulty.modes[i].shape;
    const double scale = a[1].value / b[1].value;  // the largest component may have been the dead one's
    EXPECT_NEAR(scale * b[0].value, a[1].value, 1e-9);
    EXPECT_NEAR(scale * b[3].value, a[3].value, 1e-9);
    EXPECT_EQ(b[5].value, 0.0);
  }
  request.noise = 0.01;
  request.minutes = 0.5;
  const Recording record = hide(request).measured.records.at(0);
  double least = 1e300;
  for (Eigen::Index c = 0; c < 5; ++c) least = std::min(least, record.values.col(c).norm());
  EXPECT_GT(record.values.col(5).norm(), 0.03 * least);
  EXPECT_LT(record.values.col(5).norm(), 0.07 * least);
}

/// Without a generator there are no keys and no dimensions to be otherwise; all else is.
TEST(Hide, OnAnImportedAssembly) {
  const Folder folder;
  const std::string made = folder.write("c.toml", small);
  const Assembly bridge = make_assembly(read_case(made, CaseUse::geometry));
  write_assembly(folder / "bridge.h5", bridge);
  HideRequest request = exact(folder.write("import.toml", "[bridge]\nassembly = \"bridge.h5\"\n"));
  const Measured imported = hide(request).measured;
  request.case_file = made;
  const Measured generated = hide(request).measured;
  ASSERT_EQ(imported.modes.size(), generated.modes.size());
  for (std::size_t i = 0; i < imported.modes.size(); ++i)
    EXPECT_NEAR(imported.modes[i].period, generated.modes[i].period, 1e-9);
  request.case_file = folder / "import.toml";
  request.scatter = 0.1;
  request.effects = {{"joint_softening", "pier 0", {{"factor", 0.2}}}};
  EXPECT_GT(hide(request).measured.modes[0].period, imported.modes[0].period);
  request.truth = {{"width", "8"}};
  EXPECT_NE(message_of<InputError>([&] { hide(request); }).find("needs a case with a generator"), std::string::npos);
}

TEST(Hide, RefusesDeviationsOfRecordings) {
  const Folder folder;
  HideRequest request = exact(folder.write("c.toml", small));
  request.minutes = 1.0;
  request.noise_said = 0.5;
  EXPECT_NE(message_of<InputError>([&] { hide(request); }).find("--noise-said"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
