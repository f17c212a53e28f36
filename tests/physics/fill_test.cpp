// Tetrahedra of the fill against closed forms: uniform strain, rotations, energy and momentum.
#include <gtest/gtest.h>

#include <random>

#include "solver/base/constants.h"
#include "solver/step/damping.h"
#include "tools/ladder/fill_rig.h"

namespace voussoir::ladder {
namespace VOUSSOIR_FILE {

/// 2 × 3 × 2 m, its inner nodes moved about so that no two tetrahedra are alike.
FillMesh uneven_mesh() {
  FillMesh mesh = box_mesh({0, 0, 0}, {2, 3, 2}, 3, 4, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> by(-0.12, 0.12);
  for (Vec3& x : mesh.nodes) {
    const Vec3 far(2, 3, 2);
    for (int c = 0; c < 3; ++c)
      if (x[c] > 1e-9 && x[c] < far[c] - 1e-9) x[c] += by(random);
  }
  return mesh;
}

Material soil() {
  Material m = elastic_fill(1500.0, 266.6667e6, 160e6);
  m.cohesion = 20e3, m.tensile_strength = 0.0, m.friction_angle = radians(40.0), m.dilation_angle = radians(10.0);
  return m;
}

void shake_up(FillRig& rig, double size, int seed) {
  std::mt19937 random{unsigned(seed)};
  std::normal_distribution<double> normal(0.0, size);
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    rig.set_displacement(i, {normal(random), normal(random), normal(random)});
}

Vec3 place(const FillRig& rig, std::size_t i) {
  return rig.fill.nodes[i] + rig.displacement(i);
}

/// Largest sum of all forces and moments, over the largest force.
double unbalanced(const FillRig& rig) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double most = 0.0;
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
    const Vec3 f = rig.force(i);
    force += f, moment += place(rig, i).cross(f);
    most = std::max(most, f.norm());
  }
  return std::max(force.norm(), moment.norm()) / most;
}

TEST(FillElement, UniformStrainIsExact) {
  for (const bool averaged : {true, false}) {
    FillRig rig(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6));
    rig.pass.averaged = averaged;
    Mat3 g;
    g << 1, 2, -3, 0.5, -2, 1, 4, -1, 1.5;
    g *= 1e-9;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) rig.set_displacement(i, g * rig.fill.nodes[i]);
    rig.stresses();
    const Mat3 strain = 0.5 * (g + g.transpose());
    const Mat3 stress = 2 * 160e6 * strain + (266e6 - 2.0 / 3.0 * 160e6) * strain.trace() * Mat3::Identity();
    const double scale = stress.norm();
    // Under a velocity field A x the forces do the work −V σ : A; inside there is no force.
    Mat3 field;
    field << 3, -1, 2, 5, 1, -4, 2, 6, -2;
    double work = 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) work += rig.force(i).dot(field * rig.fill.nodes[i]);
    EXPECT_NEAR(work, -12.0 * stress.cwiseProduct(field).sum(), 1e-6 * 12.0 * scale);
    double inside = 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
      const Vec3 x = rig.fill.nodes[i], to = Vec3(2, 3, 2) - x;
      if (x.minCoeff() > 1e-9 && to.minCoeff() > 1e-9) inside = std::max(inside, rig.force(i).norm());
    }
    EXPECT_LT(inside, 1e-6 * scale);
    const double energy = 0.5 * strain.cwiseProduct(stress).sum() * 12.0;
    EXPECT_NEAR(rig.elastic_energy(), energy, 1e-6 * energy);
  }
}

TEST(FillElement, ForceIsTheDerivativeOfEnergy) {
  for (const bool averaged : {true, false}) {
    FillRig rig(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6));
    rig.pass.averaged = averaged;
    shake_up(rig, 0.003, 1);
    rig.stresses();
    std::vector<Vec3> forces;
    double most = 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
      forces.push_back(rig.force(i));
      most = std::max(most, forces.back().norm());
    }
    const double h = 1e-6;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); i += 7)
      for (int c = 0; c < 3; ++c) {
        const Vec3 u = rig.displacement(i);
        double energy[2];
        for (const int up : {0, 1}) {
          rig.set_displacement(i, u + (up ? h : -h) * Vec3::Unit(c));
          rig.stresses();
          energy[up] = rig.elastic_energy();
        }
        rig.set_displacement(i, u);
        // The stress is the energy's derivative but for a share of the elastic strain (here a per cent) to the third.
        EXPECT_NEAR(forces[i][c], -(energy[1] - energy[0]) / (2 * h), 3e-5 * most);
      }
  }
}

TEST(FillElement, NothingInARigidTurn) {
  FillRig rig(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6));
  for (const double degrees : {0.01, 90.0, 170.0}) {
    const Mat3 turn = Eigen::AngleAxisd(radians(degrees), Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      rig.set_displacement(i, turn * rig.fill.nodes[i] - rig.fill.nodes[i] + Vec3(1, -2, 3));
    rig.stresses();
    double most = 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) most = std::max(most, rig.force(i).norm());
    EXPECT_LT(most, 1e-9 * 400e6) << degrees;
  }
}

TEST(FillElement, FlowsTheSameWhenTurned) {
  const Mat3 turn = Eigen::AngleAxisd(radians(70.0), Vec3(3, -2, 1).normalized()).toRotationMatrix();
  FillRig rig(uneven_mesh(), soil()), turned(uneven_mesh(), soil());
  for (const int seed : {1, 2, 3}) {
    shake_up(rig, 0.02, seed);
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      turned.set_displacement(i, turn * place(rig, i) - rig.fill.nodes[i]);
    EXPECT_GT(rig.stresses().yielding, 0);
    turned.stresses();
    double most = 0.0, apart = 0.0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
      most = std::max(most, rig.force(i).norm());
      apart = std::max(apart, (turn * rig.force(i) - turned.force(i)).norm());
    }
    EXPECT_LT(apart, 1e-8 * most);
  }
}

/// Forces of two rigs, in newtons, as far apart as they are.
double apart(const FillRig& a, const FillRig& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.fill.nodes.size(); ++i) most = std::max(most, (a.force(i) - b.force(i)).norm());
  return most;
}

/// In single precision strain is known to some 1e-7 of the displacement gradient: of a body that turns by 120 degrees
/// that makes a stress of so much of the moduli, of one that is strained by parts of a thousand far less.
TEST(FillElement, SinglePrecisionKnowsStrainToItsRounding) {
  DampingSettings maxwell;
  maxwell.kind = DampingSettings::Kind::maxwell;
  const Branches branches = damping_at_work(maxwell, 1e-4, 1e4).branches;
  const double area = 0.5, moduli = 2.0 * 160e6;  // m2, of the largest tetrahedra; Pa
  for (const double size : {1e-4, 1e-3, 1e-2, 3e-2}) {
    FillRig whole(uneven_mesh(), soil()), half(uneven_mesh(), soil());
    half.pass.single = true;
    whole.set_branches(branches), half.set_branches(branches);
    for (const int seed : {1, 2, 3}) {
      shake_up(whole, size, seed), shake_up(half, size, seed);
      whole.stresses(), half.stresses();
      EXPECT_LT(apart(whole, half), 6e-6 * size / 0.5 * moduli * area + 1e-3) << size;
    }
  }
  FillRig turned(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6)), still(uneven_mesh(), soil());
  turned.pass.single = true;
  const Mat3 turn = Eigen::AngleAxisd(radians(120.0), Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (std::size_t i = 0; i < turned.fill.nodes.size(); ++i)
    turned.set_displacement(i, turn * turned.fill.nodes[i] - turned.fill.nodes[i]);
  turned.stresses(), still.stresses();
  EXPECT_LT(apart(turned, still), 2e-6 * moduli * area);
}

TEST(FillElement, KeepsMomentum) {
  FillRig rig(uneven_mesh(), soil());
  DampingSettings maxwell;
  maxwell.kind = DampingSettings::Kind::maxwell;
  rig.set_branches(damping_at_work(maxwell, 1e-4, 1e4).branches);
  ASSERT_EQ(rig.pass.branches.count, 3);
  for (const int seed : {1, 2, 3}) {
    shake_up(rig, 0.02, seed);
    EXPECT_GT(rig.stresses().yielding, 0);
    EXPECT_LT(unbalanced(rig), 1e-11);
  }
}

// Where plastic flow changes volume the nodes' means follow it in the next pass.
TEST(FillElement, StressesTwiceAreTheSameAtConstantVolume) {
  Material clay = soil();
  clay.friction_angle = clay.dilation_angle = 0.0, clay.tensile_strength = 1e30;
  FillRig rig(uneven_mesh(), clay);
  shake_up(rig, 0.002, 1);
  rig.stresses();
  std::vector<Vec3> first;
  double most = 0.0;
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
    first.push_back(rig.force(i));
    most = std::max(most, first.back().norm());
  }
  const double dissipated = rig.memory.lost[0];
  rig.stresses();
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) EXPECT_LT((rig.force(i) - first[i]).norm(), 1e-6 * most);
  EXPECT_NEAR(rig.memory.lost[0], dissipated, 1e-6 * dissipated);
}

struct Ledger {
  double kinetic = 0.0, elastic = 0.0, lost = 0.0, largest = 0.0;
  double total() const { return kinetic + elastic + lost; }
};

double kinetic_energy(const FillRig& rig) {
  double sum = 0.0;
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
    const NodeUpdate next = rig.pass.update(i);
    for (int c = 0; c < 3; ++c)
      sum += 0.5 * rig.fill.inertial[i] * rig.memory.motion[node_width * i + std::size_t(c)] * next.velocity[c];
  }
  return sum;
}

/// A box that starts with these speeds is stepped, with a share `safe` of the step that is safe; the largest change of
/// its energy over the largest term.
double worst_balance(FillRig& rig, double speed, int steps, Ledger& end, double safe = 0.3) {
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
    const Vec3 x = rig.fill.nodes[i] - Vec3(1, 1.5, 1);
    rig.set_velocity(i, speed * Vec3(-x.x(), 0.5 * x.z(), 0.3 * x.y() * x.x()));
  }
  rig.pass.dt = rig.safe_step(safe);
  double first = 0.0, worst = 0.0, largest = 0.0;
  for (int s = 0; s < steps; ++s) {
    Ledger now;
    rig.stresses();
    now.kinetic = kinetic_energy(rig);
    now.elastic = rig.elastic_energy();
    double springs = 0.0;
    for (const FillEnergy& e : rig.energies) springs += e.branches;
    now.elastic += springs;
    for (std::size_t t = 0; t < rig.fill.tiles.size(); ++t)
      now.lost += rig.memory.lost[4 * t] + rig.memory.lost[4 * t + 1];
    now.lost -= springs;  // of the work done on branches, what their springs hold is not lost
    if (s == 0) first = now.total();
    largest = std::max({largest, now.kinetic, now.elastic, now.lost});
    worst = std::max(worst, std::abs(now.total() - first));
    end = now;
    for (std::size_t t = 0; t < rig.fill.tiles.size(); ++t) rig.pass.nodes(t);
  }
  return worst / largest;
}

TEST(FillElement, KeepsItsEnergy) {
  for (const bool single : {false, true}) {
    FillRig rig(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6));
    rig.pass.single = single;
    Ledger end;
    EXPECT_LT(worst_balance(rig, 2.0, 2000, end), 1e-3) << single;
    EXPECT_EQ(end.lost, 0.0) << single;
  }
}

TEST(FillElement, LosesWhatPlasticFlowTakes) {
  Material steady = soil();
  steady.friction_angle = steady.dilation_angle = 0.0, steady.tensile_strength = 1e30;
  for (const bool single : {false, true}) {
    FillRig rig(uneven_mesh(), steady);
    rig.pass.single = single;
    Ledger end;
    EXPECT_LT(worst_balance(rig, 2.0, 2000, end), 1e-2) << single;
    EXPECT_GT(end.lost, 0.3 * end.total()) << single;
  }
}

/// Nodes' means follow what has dilated or torn some steps behind: of a box that bursts more is lost than the stress
/// after each step takes, but less and less with shorter steps (docs/theory/fill.md).
TEST(FillElement, LosesWhatDilationAndTearingTake) {
  double worst[2];
  for (int i = 0; i < 2; ++i) {
    const int finer = i ? 4 : 1;
    FillRig rig(uneven_mesh(), soil());
    Ledger end;
    worst[i] = worst_balance(rig, 2.0, 2000 * finer, end, 0.3 / finer);
    EXPECT_GT(end.lost, 0.3 * end.total());
  }
  EXPECT_LT(worst[0], 0.045);
  EXPECT_LT(worst[1], 0.5 * worst[0]);
}

/// Nodes that shake against one another tear elements open that their nodes' means hold in tension, whatever they have
/// themselves. That must take energy and never give any: what it gave once made such shaking grow
/// (docs/theory/fill.md).
TEST(FillElement, TearingGivesNothingBack) {
  Material m = elastic_fill(1500.0, 266e6, 160e6);
  m.cohesion = 20e3, m.tensile_strength = 0.0, m.friction_angle = 40.0 * M_PI / 180.0;
  FillRig rig(box_mesh({0, 0, 0}, {2, 2, 2}, 4, 4, 4), m);
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) {
    const Vec3& x = rig.fill.nodes[i];
    const double turn = std::lround(2.0 * (x.x() + x.y() + x.z())) % 2 ? 1.0 : -1.0;
    rig.set_velocity(i, {0.02 * x.x(), 0.02 * x.y(), 0.05 * turn});
  }
  rig.pass.dt = rig.safe_step(0.3);
  double lost = 0.0;
  std::int64_t torn = 0;
  for (int s = 0; s < 500; ++s) {
    torn += rig.stresses().yielding;
    double now = 0.0;
    for (std::size_t t = 0; t < rig.fill.tiles.size(); ++t) now += rig.memory.lost[4 * t];
    EXPECT_GE(now, lost - 1e-9) << "step " << s;
    EXPECT_GE(rig.elastic_energy(), 0.0) << "step " << s;
    lost = now;
    for (std::size_t t = 0; t < rig.fill.tiles.size(); ++t) rig.pass.nodes(t);
  }
  EXPECT_GT(torn, 1000);
}

TEST(FillElement, LosesWhatBranchesTake) {
  FillRig rig(uneven_mesh(), elastic_fill(1500.0, 266e6, 160e6));
  DampingSettings maxwell;
  maxwell.kind = DampingSettings::Kind::maxwell;
  maxwell.band[0] = 10.0, maxwell.band[1] = 200.0;
  rig.set_branches(damping_at_work(maxwell, rig.safe_step(0.3), 1e4).branches);
  Ledger end;
  EXPECT_LT(worst_balance(rig, 2.0, 2000, end), 5e-3);
  EXPECT_GT(end.lost, 0.05 * end.total());
}

/// The corner of a fill breaks away and flies off, and its tetrahedra follow it to many times their length. Nothing
/// pulls it, so that its kinetic energy never grows, and the box it leaves stays at rest.
TEST(FillElement, WhatFliesOffIsNotPulledAlong) {
  Material m = elastic_fill(1600.0, 100e6, 42e6);
  m.cohesion = 20e3, m.tensile_strength = 0.0, m.friction_angle = 40.0 * M_PI / 180.0;
  for (const auto& [damped, single] : {std::pair(false, false), {true, false}, {false, true}, {true, true}}) {
    FillRig rig(box_mesh({0, 0, 0}, {1, 1, 1}, 3, 3, 3), m);
    rig.pass.single = single;
    std::size_t corner = 0;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      if ((rig.fill.nodes[i] - Vec3(1, 1, 1)).norm() < 1e-9) corner = i;
    rig.set_velocity(corner, {8, 3, 5});
    rig.pass.dt = rig.safe_step(0.8);
    if (damped) {
      DampingSettings maxwell;
      maxwell.kind = DampingSettings::Kind::maxwell;
      maxwell.ratio = 0.02, maxwell.band[0] = 0.5, maxwell.band[1] = 12.0;
      rig.set_branches(damping_at_work(maxwell, rig.pass.dt, 1e4).branches);
    }
    double first = 0.0, most = 0.0;
    for (double time = 0.0; time < 2.0; time += rig.pass.dt) {
      rig.stresses();
      const double kinetic = kinetic_energy(rig);
      if (time == 0.0) first = kinetic;
      most = std::max(most, kinetic);
      for (std::size_t t = 0; t < rig.fill.tiles.size(); ++t) rig.pass.nodes(t);
    }
    EXPECT_LE(most, 1.0001 * first) << (damped ? "with branches" : "without branches") << single;
    EXPECT_GT(rig.memory.pose[node_width * corner], 3.0);
  }
}

TEST(FillElement, ATetrahedronThatLosesItsVolumeIsNamed) {
  FillMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, 1, 1, 1);
  FillRig rig(mesh, soil());
  EXPECT_EQ(rig.stresses().inverted, -1);
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    if (rig.fill.nodes[i].z() > 0.5) rig.set_displacement(i, {0, 0, -1.2});
  EXPECT_GE(rig.stresses().inverted, 0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::ladder
