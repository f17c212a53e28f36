// What a contact search looks at, and where the contacts it finds live.
#include "solver/contact/search.h"

#include <map>

#include "solver/contact/contact_slots.h"
#include "solver/contact/pairs.h"
#include "solver/step/look.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Cubes of 0.5 m in a row on a slab, `gap` m apart, none joined to another.
std::unique_ptr<Bench> row_of_cubes(int count, double gap) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  const double length = count * (0.5 + gap);
  add_box(assembly, {-1, -1, -0.5}, {length + 1, 1.5, 0}, true);
  for (int i = 0; i < count; ++i) {
    const double x = i * (0.5 + gap);
    add_box(assembly, {x, 0, 0}, {x + 0.5, 0.5, 0.5});
  }
  auto bench = std::make_unique<Bench>(joined(std::move(assembly), 1e9, 4e8, dry_law(0.5)));
  bench->begin(1e-5);
  return bench;
}

void move_all(Bench& bench, int count, const Vec3& by, const Eigen::Quaterniond& turn) {
  const Vec3 about(0.3, 0.2, 0.1);
  for (int i = 1; i <= count; ++i) {
    const Vec3 arm = bench.assembly.blocks[std::size_t(i)].centroid - about;
    bench.place(i, by + turn * arm - arm, turn);
  }
}

/// A search that follows from a move of many skins, but of all alike, examines nobody: not even after a turn.
TEST(Search, AsksNothingOfWhatMovesTogether) {
  constexpr int count = 5;
  const auto made = row_of_cubes(count, 0.05);
  Bench& bench = *made;
  const double skin_width = skin(bench.model);
  ASSERT_LT(skin_width, 0.05);
  EXPECT_GT(update_contacts(bench.model, bench.state, {}, false).examined, 0) << "the first search knows nothing";
  EXPECT_EQ(update_contacts(bench.model, bench.state, {}, false).examined, 0);
  // The slab is no neighbour any more once they hang above it.
  move_all(bench, count, {0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, false);
  for (int i = 1; i <= 10; ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.02 * i, Vec3(1, 2, 3).normalized()));  // boxes stay alike
    move_all(bench, count, {0.0, 0.0, 3.0 + 0.02 * i}, turn);
    EXPECT_EQ(update_contacts(bench.model, bench.state, {}, false).examined, 0) << i;
  }
  // One of them leaves the row: its pairs alone.
  bench.pose(3)[1] += 2.0 * skin_width;
  const ContactUpdate update = update_contacts(bench.model, bench.state, {}, false);
  EXPECT_EQ(update.examined, 2);
  EXPECT_EQ(update.made, 0);
}

/// Nothing slips through: however it comes, there is a contact before the cells overlap.
TEST(Search, FindsWhatComesFromAfarBeforeItTouches) {
  const auto made = row_of_cubes(2, 0.5);
  Bench& bench = *made;
  const double least = search_share * skin(bench.model);  // the farthest a body goes before a search
  for (const Vec3& way : std::vector<Vec3>{Vec3(-1, 0, 0), Vec3(-1, 0.3, 0.2), Vec3(-1, 0, -0.02)}) {
    bench.state = initial_state(bench.model);
    update_contacts(bench.model, bench.state, {}, false);
    Vec3 at(0, 0, 0.2);
    const Vec3 step = 0.99 * least * way.normalized();
    bool found = false;
    for (int i = 0; i < 300 && !found; ++i) {
      bench.place(2, at += step, Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vec3::UnitY())));
      bench.place(1, {0, 0, 0.2}, Eigen::Quaterniond::Identity());
      const ContactUpdate update = update_contacts(bench.model, bench.state, {}, false);
      for (const Patch& p : bench.state.contacts)
        found |= p.point_count > 0 && std::min(p.a, p.b) != bench.body(0) && std::max(p.a, p.b) != bench.body(0);
      if (!found) {
        EXPECT_EQ(bench.overlap(1, 2), 0.0) << i << ", " << update.examined << " examined";
      }
      if (bench.overlap(1, 2) > 0.0) break;
    }
    EXPECT_TRUE(found);
  }
}

/// What the proof rests on: after any search, and be it for a patch to be clipped, all stand near their noted places.
TEST(Search, NotesWhoHasMovedWhateverItWasCalledFor) {
  const auto made = row_of_cubes(3, 0.2);
  Bench& bench = *made;
  update_contacts(bench.model, bench.state, {}, false);
  const double moved = 0.5 * (moved_share + search_share) * skin(bench.model);  // not far enough to call a search
  bench.place(2, {0, moved, 0.5}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, false);
  bench.place(2, {0, 2.0 * moved, 0.5}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, true);
  const auto body = std::size_t(bench.body(2));
  EXPECT_LT(moved_since(bench.model, bench.state, bench.state.searched, body, bench.state.base_displacement()),
            moved_share * skin(bench.model));
}

/// What has fallen below everything is left alone: it calls no searches, keeps no contact, and holds up nobody.
TEST(Search, LooksForNothingAroundWhatHasFallenOut) {
  const auto made = row_of_cubes(2, 0.005);  // so near that they have a contact
  Bench& bench = *made;
  bench.model.up = Vec3::UnitZ(), bench.model.bottom = -0.5;
  bench.place(1, {0, 0, -1.05}, Eigen::Quaterniond::Identity());
  bench.place(2, {0, 0, -1.05}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, false);
  EXPECT_EQ(bench.state.contact_count(), 1);  // they have not wholly passed it
  const auto body = std::size_t(bench.body(1));
  EXPECT_FALSE(bench.state.lost(body));
  bench.place(1, {0, 0, -1.5}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, false);
  EXPECT_TRUE(bench.state.lost(body));
  EXPECT_EQ(bench.state.contact_count(), 0);
  bench.place(1, {0, 0, -50.0}, Eigen::Quaterniond::Identity());
  EXPECT_EQ(moved_since(bench.model, bench.state, bench.state.searched, body, Vec3::Zero()), 0.0);
  bench.place(2, {0, 0, -50.0}, Eigen::Quaterniond::Identity());
  EXPECT_EQ(update_contacts(bench.model, bench.state, {}, false).made, 0);
}

/// Whoever falls for a hundred seconds is faster than 1000 m/s: no reason to end a run, unless there is still something
/// for it to hit.
TEST(Search, LetsWhatHasFallenOutFallAsFastAsItLikes) {
  for (const double local : {0.0, 0.1}) {  // eight side by side, one by one
    const auto made = row_of_cubes(1, 0.5);
    Bench& bench = *made;
    bench.model.up = Vec3::UnitZ(), bench.model.bottom = -0.5;
    bench.stepper.damping.local = local;
    const auto falling = [&](double speed) {
      bench.push(1, {0, 0, -speed}, Vec3::Zero());
      update_contacts(bench.model, bench.state, {});
      bench.stepper.prepare();
      return bench.stepper.advance(bench.state.step() + 1, 1, nullptr, nullptr).outcome;
    };
    bench.place(1, {0, 0, 5.0}, Eigen::Quaterniond::Identity());
    EXPECT_EQ(falling(2000.0), StepOutcome::runaway);
    bench.place(1, {0, 0, -2.0}, Eigen::Quaterniond::Identity());
    EXPECT_NE(falling(2000.0), StepOutcome::runaway);
    EXPECT_TRUE(bench.state.lost(std::size_t(bench.body(1))));
    EXPECT_EQ(falling(HUGE_VAL), StepOutcome::runaway);
  }
}

NewContact between(std::int32_t a, std::int32_t b, std::size_t points) {
  NewContact c;
  c.patch.a = a, c.patch.b = b, c.patch.kn = c.patch.ks = 1e9, c.patch.area = 0.1;
  for (std::size_t i = 0; i < points; ++i) c.points.push_back({0.1 * double(i), 0.0, 0.1 / double(points)});
  c.corners = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  c.memory.assign(4 * points, 0.0);
  return c;
}

TEST(ContactSlots, AreReusedAndNeverMoved) {
  const auto made = row_of_cubes(3, 0.3);
  State& state = made->state;
  std::vector<std::size_t> taken;
  {
    ContactSlots slots(made->model, state, {});
    for (int i = 0; i < 11; ++i) taken.push_back(slots.add(between(1, 2, 9)));
    EXPECT_EQ(slots.add(between(1, 3, 1)), 16u) << "a batch of its own: it has one point";
  }
  for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i], i);
  EXPECT_EQ(state.contacts.size(), 24u);
  EXPECT_EQ(state.contact_count(), 12);
  state.contact.energy[energy_index(place_of_slot(4), 0)] = 7.0;
  {
    ContactSlots slots(made->model, state, {});
    slots.remove(9), slots.remove(4);
    EXPECT_EQ(slots.add(between(2, 3, 7)), 4u) << "the lowest that is free";
  }
  EXPECT_EQ(state.retired_energy()[0], 7.0);
  EXPECT_EQ(state.contact.energy[energy_index(place_of_slot(4), 0)], 0.0);
  EXPECT_FALSE(state.has_contact(9));
  ContactSlots again(made->model, state, {});  // knows from the state alone what is free
  EXPECT_EQ(again.add(between(1, 2, 9)), 9u);
  EXPECT_EQ(again.add(between(1, 2, 9)), 11u);
  // Seven points in nine rows: the two that are missing weigh nothing.
  const Patch& p = state.contacts[4];
  double weight = 0.0;
  for (int i = 0; i < 9; ++i) weight += patch_point(p, state.contact_points, i).weight;
  EXPECT_NEAR(weight, 0.1, 1e-15);
}

/// Steps at which a search is called for, while blocks fly and turn about over a shaken base, in advances of so many
/// steps. Places are looked at less often than that, but nobody has come farther than the distance by then.
std::vector<std::int64_t> searched_steps(std::int64_t at_once) {
  constexpr int count = 20;
  const auto made = row_of_cubes(count, 0.5);
  Bench& bench = *made;
  bench.stepper.dt = 1e-4;
  GroundMotion motion;
  motion.dt = 0.01;
  for (int i = 0; i < 30; ++i) motion.acceleration.emplace_back(9.0 * std::sin(i), 5.0 * std::cos(i), 2.0);
  bench.stepper.motion = &motion;
  std::mt19937 random(5);
  for (int i = 1; i <= count; ++i) {
    bench.place(i, {0.0, 0.0, 1.0}, Eigen::Quaterniond::Identity());
    bench.push(i, random_vector(0.3, random), random_vector(1.0, random));
  }
  update_contacts(bench.model, bench.state, {});
  bench.stepper.prepare();
  std::vector<std::int64_t> steps;
  while (bench.state.step() < 2000) {
    const std::int64_t target = std::min<std::int64_t>(2000, bench.state.step() + at_once);
    if (bench.stepper.advance(target, 1, nullptr, nullptr).outcome != StepOutcome::contacts) continue;
    steps.push_back(bench.state.step());
    double farthest = 0.0;
    for (std::size_t i = 0; i < bench.model.bodies.size(); ++i)
      farthest = std::max(
          farthest, moved_since(bench.model, bench.state, bench.state.searched, i, bench.state.base_displacement()));
    EXPECT_LE(farthest, 1.03 * bench.stepper.search_distance) << "step " << steps.back();
    if (!may_clip_at(steps.back())) {
      EXPECT_GE(farthest, 0.7 * bench.stepper.search_distance) << "step " << steps.back();
    }
    update_contacts(bench.model, bench.state, {});
    bench.stepper.prepare();
  }
  return steps;
}

TEST(Search, BeginsWhenABodyHasComeFarEnough) {
  const std::vector<std::int64_t> steps = searched_steps(2000);
  EXPECT_GT(steps.size(), 10u);
  EXPECT_LT(steps.size(), 1000u);
  EXPECT_EQ(searched_steps(1), steps);
  EXPECT_EQ(searched_steps(7), steps);
}

/// Slow bodies: the next look comes where a round ends anyway; fast ones may not wait for that.
TEST(Search, LooksWhereARoundEnds) {
  BodyReport slow;
  slow.farthest = 1e-6, slow.fastest = 1e-7;
  EXPECT_EQ(look(slow, 32, 1e-3, 1e-4).next, 48);
  EXPECT_EQ(look(slow, 33, 1e-3, 1e-4).next, 48);
  EXPECT_EQ(look(slow, 39, 1e-3, 1e-4).next, 48);
  BodyReport fast = slow;
  fast.farthest = 0.9e-3, fast.fastest = 1e-5;  // 2 × 4 steps of it are left, and a little to fall
  EXPECT_EQ(look(fast, 33, 1e-3, 1e-4).next, 37);
  EXPECT_EQ(look(fast, 38, 1e-3, 1e-4).next, 40);
}

/// The pass says in which tiles a patch has slid too far, and only there is it looked for.
TEST(Search, ClipsWhereThePassHasFoundReason) {
  constexpr int count = 150;
  const auto made = row_of_cubes(count, 0.2);
  Bench& bench = *made;
  const int moved[] = {10, 140};
  for (const int i : moved) bench.place(i, {0, 0.06, 0}, Eigen::Quaterniond::Identity());
  update_contacts(bench.model, bench.state, {}, false);
  bench.stepper.prepare();
  const Advance a = bench.stepper.advance(2 * clip_interval, 1, nullptr, nullptr);
  ASSERT_EQ(a.outcome, StepOutcome::contacts);
  EXPECT_EQ(bench.state.step(), clip_interval);
  ASSERT_EQ(a.past.size(), 2u);
  const auto joint_of = [&](int cube) {
    for (std::size_t i = 0; i < bench.model.joints.size(); ++i)
      if (bench.model.joints[i].a == bench.body(cube) || bench.model.joints[i].b == bench.body(cube)) return i;
    return bench.model.joints.size();
  };
  const auto gone = [&](int cube) { return (bench.state.joint.mode[joint_of(cube)] & mode_gone) != 0; };
  const auto in_tile = [&](int cube, std::int32_t tile) {
    const auto joint = std::int32_t(joint_of(cube));
    return bench.model.tiles[std::size_t(tile)].first_joint <= joint &&
           joint < bench.model.tiles[std::size_t(tile)].end_joint;
  };
  const int first = in_tile(moved[0], a.past[0]) ? 0 : 1;
  EXPECT_TRUE(in_tile(moved[first], a.past[0]) && in_tile(moved[1 - first], a.past[1]));
  EXPECT_EQ(update_contacts(bench.model, bench.state, {}, std::vector{a.past[0]}).clipped, 1);
  EXPECT_TRUE(gone(moved[first]) && !gone(moved[1 - first]));
  EXPECT_EQ(update_contacts(bench.model, bench.state, {}, std::vector{a.past[1]}).clipped, 1);
  EXPECT_TRUE(gone(moved[1 - first]));
}

/// Where a few bodies have gone elsewhere the list becomes that of all bodies listed from nothing, and what other pairs
/// know of each other stays theirs.
TEST(Search, ListsWhatListingAllWould) {
  constexpr int count = 30;
  const auto made = row_of_cubes(count, 0.03);
  Bench& bench = *made;
  State& state = bench.state;
  const std::size_t bodies = bench.model.bodies.size();
  list_pairs(bench.model, state, std::vector<char>(bodies, 1), 1);
  std::mt19937 random(3);
  std::size_t gone = 0, fresh = 0;
  for (int round = 0; round < 150; ++round) {
    std::map<CellPair, float> known;
    for (std::size_t i = 0; i < state.pair_cells.size() / 4; ++i) {
      const std::int32_t* c = &state.pair_cells[4 * i];
      state.pair_seen[searched_width * i + 7] = known[{c[0], c[1], c[2], c[3]}] = 0.001f * float(i + 1);
    }
    std::vector<char> stale(bodies, 0);
    for (int k = 0; k < 1 + round % 3; ++k) {
      const int cube = 1 + int(random() % count);
      bench.place(cube, {0.53 * double(random() % 5) - 1.06, 0.6 * double(random() % 3), 0.51 * double(random() % 3)},
                  Eigen::Quaterniond::Identity());
      stale[std::size_t(bench.body(cube))] = 1;
    }
    list_pairs(bench.model, state, stale, 1 + round % 2);
    State anew = state;
    anew.pair_cells.clear(), anew.pair_seen.clear();
    list_pairs(bench.model, anew, std::vector<char>(bodies, 1), 1);
    ASSERT_EQ(state.pair_cells, anew.pair_cells) << round;
    ASSERT_EQ(state.pair_seen.size(), anew.pair_seen.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < state.pair_cells.size() / 4; ++i) {
      const std::int32_t* c = &state.pair_cells[4 * i];
      const auto at = known.find({c[0], c[1], c[2], c[3]});
      ASSERT_EQ(state.pair_seen[searched_width * i + 7], at == known.end() ? pair_is_new : at->second) << round;
      kept += at != known.end();
    }
    gone += known.size() - kept, fresh += state.pair_cells.size() / 4 - kept;
  }
  EXPECT_GT(gone, 100u);
  EXPECT_GT(fresh, 100u);
}

/// A spring without limits stays the spring it is, however far it turns.
TEST(Search, LeavesElasticJointsWhereTheyAre) {
  Assembly assembly = stone(2000.0, 1e9, 0.5);
  add_box(assembly, {0, 0, -0.5}, {0.5, 0.5, 0}, true);
  add_box(assembly, {0, 0, 0}, {0.5, 0.5, 0.5});
  Bench bench(joined(std::move(assembly), 4e9, 1.6e9, elastic_law()));
  bench.begin(1e-5);
  bench.place(1, {0.2, 0, 0.1}, Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Vec3::UnitX())));
  const ContactUpdate update = update_contacts(bench.model, bench.state, {});
  EXPECT_EQ(update.clipped + update.dropped, 0);
  EXPECT_FALSE(bench.state.joint.mode[0] & mode_gone);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
