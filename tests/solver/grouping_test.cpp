// Patches that change places change nothing else.
#include "solver/contact/grouping.h"

#include <map>

#include "solver/base/error.h"
#include "solver/contact/search.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A wall with some bond, shaken until stones slide, rock and meet others.
std::unique_ptr<Bench> shaken_wall() {
  Assembly assembly = generated("wall", {{"length_blocks", 12}, {"courses", 12}});
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = DampingSettings::Kind::maxwell;
  JointLaw law = weak_bond();
  law.tension = law.cohesion = 2e4;
  set_law(assembly, law);
  auto bench = std::make_unique<Bench>(std::move(assembly), settings);
  bench->begin();
  GroundMotion motion;
  motion.dt = 0.05;
  for (int i = 0; i < 40; ++i) motion.acceleration.emplace_back(i % 3 ? 12.0 : -14.0, i % 4 ? 8.0 : -9.0, 0.0);
  bench->stepper.motion = &motion;
  EXPECT_TRUE(bench->run(4000));
  bench->stepper.motion = nullptr;
  return bench;
}

struct Copy {
  Model model;
  State state;
  Stepper stepper;
  explicit Copy(const Bench& bench) : model(bench.model), state(bench.state), stepper(bench.stepper) {
    stepper.model = &model, stepper.state = &state;
  }
  std::array<double, 6> wrench(std::size_t patch) const {
    std::array<double, 6> w;
    std::copy_n(&stepper.wrenches[wrench_width * patch], 6, w.begin());
    return w;
  }
  /// Of the assembly's joints, in its order.
  std::vector<std::array<double, 6>> joints() const {
    std::vector<std::array<double, 6>> all;
    for (const JointPlace& p : model.joint_places) all.push_back(wrench(std::size_t(p.now)));
    return all;
  }
  std::multimap<CellPair, std::array<double, 6>> contacts() const {
    std::multimap<CellPair, std::array<double, 6>> all;
    for (std::size_t i = 0; i < state.contacts.size(); ++i)
      if (state.has_contact(i)) all.emplace(cells_of(state.contacts[i]), wrench(model.joints.size() + i));
    return all;
  }
};

TEST(Grouping, LeavesEveryPatchAsItWas) {
  const auto bench = shaken_wall();
  Copy before(*bench), after(*bench);
  ASSERT_GT(before.state.contact_count(), 20);
  group_patches(after.model, after.state, 2);
  ASSERT_NE(after.model.joint_of_patch, before.model.joint_of_patch) << "nothing to group: too tame a test";
  bool contacts_moved = false;
  for (std::size_t i = 0; i < before.state.contacts.size(); ++i)
    contacts_moved |= before.state.has_contact(i) != after.state.has_contact(i) ||
                      cells_of(before.state.contacts[i]) != cells_of(after.state.contacts[i]);
  EXPECT_TRUE(contacts_moved);
  for (Copy* copy : {&before, &after}) {
    copy->stepper.prepare();
    for (int pass = 0; pass < 2; ++pass) {  // the second reads what the first has kept
      copy->state.pose[pose_width * 40] += 1e-5;
      copy->stepper.patches_only();
    }
  }
  EXPECT_EQ(before.joints(), after.joints());
  EXPECT_EQ(before.contacts(), after.contacts());
  for (std::size_t j = 0; j < before.model.joint_places.size(); ++j) {
    const auto a = std::size_t(before.model.joint_places[j].now), b = std::size_t(after.model.joint_places[j].now);
    EXPECT_EQ(before.state.joint.mode[a], after.state.joint.mode[b]);
    const BatchPlace was = place_of(before.model.joints[a]), is = place_of(after.model.joints[b]);
    EXPECT_EQ(before.state.joint.largest[largest_index(was, 0)], after.state.joint.largest[largest_index(is, 0)]);
    EXPECT_EQ(before.state.joint.energy[energy_index(was, 2)], after.state.joint.energy[energy_index(is, 2)]);
  }
}

TEST(Grouping, FillsBatchesWithPatchesOfOneKind) {
  const auto bench = shaken_wall();
  Copy copy(*bench);
  const auto point_batches = [&] {
    std::map<std::int32_t, int> batches;
    for (std::size_t i = 0; i < copy.model.joints.size(); ++i) {
      const std::uint8_t mode = copy.state.joint.mode[i];
      if ((mode & mode_points) && !(mode & mode_gone)) ++batches[copy.model.joints[i].batch];
    }
    return batches.size();
  };
  const std::size_t before = point_batches();
  group_patches(copy.model, copy.state, 1);
  EXPECT_LT(point_batches(), before);
}

TEST(Grouping, AStateBringsItsOrder) {
  const auto bench = shaken_wall();
  Copy grouped(*bench), read(*bench);
  group_patches(grouped.model, grouped.state, 1);
  read.state = grouped.state;
  take_joint_order(read.model, read.state);
  EXPECT_EQ(read.model.joint_of_patch, grouped.model.joint_of_patch);
  for (Copy* copy : {&grouped, &read}) copy->stepper.prepare(), copy->stepper.patches_only();
  EXPECT_EQ(read.joints(), grouped.joints());
  EXPECT_EQ(hash_arrays(read.state.arrays()), hash_arrays(grouped.state.arrays()));
}

TEST(Grouping, AnOrderOfAnotherAssemblyIsRefused) {
  const auto bench = shaken_wall();
  Copy copy(*bench);
  for (const std::int32_t wrong : {-1, copy.state.joint_order[1], std::int32_t(copy.model.joints.size())}) {
    copy.state.joint_order = bench->state.joint_order;
    copy.state.joint_order[0] = wrong;
    EXPECT_THROW(take_joint_order(copy.model, copy.state), InputError) << wrong;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
