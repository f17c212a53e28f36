// What is read off the fill for files and pictures: stresses against closed forms, and in the mesh's order.
#include <gtest/gtest.h>

#include "solver/fill/tet_stress.h"
#include "solver/step/make_snapshot.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::ladder {
namespace VOUSSOIR_FILE {

constexpr double bulk = 266e6, shear = 160e6;  // Pa

Mat3 tensor(const std::array<double, 6>& s) {
  Mat3 t;
  t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

void strain_uniformly(FillRig& rig, const Mat3& deformation) {
  for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
    rig.set_displacement(i, deformation * rig.fill.nodes[i] - rig.fill.nodes[i]);
}

/// Of a cube pressed to a logarithmic strain between smooth walls.
Mat3 pressed(double strain) {
  return Vec3(1.0, 1.0, std::exp(-strain)).asDiagonal();
}

/// As in the rung fill-oedometer: κ = μ = 200 MPa, c = 1 MPa, φ = ψ = 10°.
Material flowing() {
  Material m = elastic_fill(1500.0, 200e6, 200e6);
  m.cohesion = 1e6, m.tensile_strength = 1e9;
  m.friction_angle = m.dilation_angle = 10.0 * M_PI / 180.0;
  return m;
}

/// A fixed stone with a box of fill on it.
Assembly heap(const Material& soil) {
  Assembly assembly = stone();
  add_block(assembly, make_box({0, 0, -1}, {2, 2, 0}), true);
  return filled(std::move(assembly), box_mesh({0, 0, 0}, {2, 2, 1}, 2, 2, 2), soil, 4e9, 1.6e9, dry_law(0.7));
}

/// Hooke's law in small strains, and the same turned where a turn of any size goes before.
TEST(FillStress, OfUniformStrainIsHookes) {
  FillRig rig(box_mesh({0, 0, 0}, {2, 3, 2}, 3, 4, 3), elastic_fill(1500.0, bulk, shear));
  Mat3 g;
  g << 1, 2, -3, 0.5, -2, 1, 4, -1, 1.5;
  g *= 1e-7;
  const Mat3 strain = 0.5 * (g + g.transpose());
  const Mat3 stress = 2 * shear * strain + (bulk - 2.0 / 3.0 * shear) * strain.trace() * Mat3::Identity();
  for (const double angle : {0.0, 1.2}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    strain_uniformly(rig, turn * (Mat3::Identity() + g));
    const Mat3 expected = turn * stress * turn.transpose();
    const auto found = cauchy_stress(rig.fill, rig.memory);
    ASSERT_EQ(found.size(), rig.fill.lane_of_tet.size());
    for (const auto& s : found) EXPECT_LT((tensor(s) - expected).norm(), 1e-5 * stress.norm());
  }
}

/// The closed form of the oedometer (rung fill-oedometer), on Cauchy stress: Kirchhoff stress over the volume ratio.
TEST(FillStress, OfFlowIsThatOfTheOedometer) {
  FillRig rig(box_mesh({0, 0, 0}, {1, 1, 1}, 2, 2, 2), flowing());
  constexpr int steps = 400;
  const double strain = 0.02, ratio = std::exp(-strain);
  for (int i = 1; i <= steps; ++i) {
    strain_uniformly(rig, pressed(strain * i / steps));
    if (i < steps) rig.stresses();  // the last bit has not yet flowed in the memory: it does in what is read off
  }
  const Array<double> plastic = rig.memory.plastic, pose = rig.memory.pose;
  const Array<std::uint8_t> yield = rig.memory.yield;
  for (const auto& s : cauchy_stress(rig.fill, rig.memory)) {
    EXPECT_NEAR(s[2] * ratio, -7.0262e6, 2e-3 * 7.0262e6);
    EXPECT_NEAR(s[0] * ratio, -3.2689e6, 2e-3 * 3.2689e6);
    EXPECT_NEAR(s[1] * ratio, -3.2689e6, 2e-3 * 3.2689e6);
    for (int c = 3; c < 6; ++c) EXPECT_NEAR(s[std::size_t(c)], 0.0, 1.0);
  }
  EXPECT_EQ(rig.memory.plastic, plastic);
  EXPECT_EQ(rig.memory.pose, pose);
  EXPECT_EQ(rig.memory.yield, yield);
}

TEST(FillSnapshot, HasTheOrderOfTheMesh) {
  const Assembly assembly = heap(elastic_fill(1500.0, bulk, shear));
  Bench bench(assembly);
  const FillModel& fill = bench.model.fill;
  EXPECT_NE(fill.mesh_node, [&] {
    auto same = fill.mesh_node;
    std::sort(same.begin(), same.end());
    return same;
  }()) << "the model has the mesh's own order: nothing is tested";
  const std::int32_t moved = 20;  // of the mesh
  const auto node = std::size_t(fill.node_of[moved]);
  move_node(bench.state, node, {1e-4, 2e-4, -1e-4});
  for (std::size_t c = 0; c < 3; ++c) bench.state.fill.motion[node_width * node + c] = double(c + 1);
  const std::size_t tet = 7;
  const auto slot = std::size_t(fill.lane_of_tet[tet]);
  const auto plastic = [&](int row) -> double& {
    return bench.state.fill.plastic[plastic_index(slot / lane_count, row) + slot % lane_count];
  };
  plastic(row_shear) = 0.25, plastic(row_volume) = 3e-9;
  bench.state.fill.yield[slot] = has_yielded_in_tension;

  const FillSnapshot s = make_snapshot(bench.model, bench.state).fill;
  ASSERT_EQ(s.displacement.size(), assembly.fill.nodes.size());
  ASSERT_EQ(s.tets.size(), assembly.fill.tets.size());
  for (std::size_t i = 0; i < s.displacement.size(); ++i) {
    EXPECT_EQ(s.displacement[i], std::int32_t(i) == moved ? Vec3(1e-4, 2e-4, -1e-4) : Vec3(0, 0, 0)) << i;
    EXPECT_EQ(s.velocity[i], std::int32_t(i) == moved ? Vec3(1, 2, 3) : Vec3(0, 0, 0)) << i;
  }
  int touched = 0;
  for (std::size_t i = 0; i < s.tets.size(); ++i) {
    const auto& corners = assembly.fill.tets[i];
    const bool touches = std::count(corners.begin(), corners.end(), moved) > 0;
    touched += touches;
    const Mat3 stress = tensor(s.tets[i].stress);
    const double deviator = (stress - stress.trace() / 3.0 * Mat3::Identity()).norm();
    EXPECT_EQ(deviator > 1e3, touches) << i << ": " << deviator;
    EXPECT_EQ(s.tets[i].plastic_shear, i == tet ? 0.25 : 0.0) << i;
    EXPECT_NEAR(s.tets[i].plastic_volume, i == tet ? 3e-9 : 0.0, 1e-24) << i;
    EXPECT_EQ(s.tets[i].yield, i == tet ? has_yielded_in_tension : 0) << i;
  }
  EXPECT_GT(touched, 0);
}

TEST(FillSnapshot, ReadingItChangesNothing) {
  Material soil = elastic_fill(1500.0, bulk, shear);
  soil.cohesion = 1e3, soil.tensile_strength = 0.0, soil.friction_angle = 0.6;
  Bench bench(heap(soil));
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i)
    move_node(bench.state, i, 1e-3 * Vec3(std::sin(double(i)), std::cos(3.0 * double(i)), 0.0));
  const std::uint64_t before = hash_arrays(bench.state.arrays());
  const Snapshot snapshot = make_snapshot(bench.model, bench.state);
  EXPECT_EQ(hash_arrays(bench.state.arrays()), before);
  // What is read off is on or inside the yield surface, though the state was never stepped.
  const FillLaw& law = bench.model.fill.laws[0];
  for (const TetSnapshot& tet : snapshot.fill.tets) {
    const Vec3 s = tensor(tet.stress).selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_LT(law.major * s[2] - law.minor * s[0] - law.strength, 1e-2 * std::abs(s[0]) + 10.0);
    EXPECT_LT(s[2], 10.0 + 1e-3 * std::abs(s[0]));
  }
}

TEST(FillSnapshot, WithoutAFillThereIsNone) {
  Assembly assembly = stone();
  add_block(assembly, make_box({0, 0, -1}, {2, 2, 0}), true);
  add_block(assembly, make_box({0, 0, 0}, {1, 1, 1}));
  Bench bench(joined(std::move(assembly), 4e9, 1.6e9, dry_law(0.7)));
  EXPECT_TRUE(make_snapshot(bench.model, bench.state).fill.empty());
}

/// Soil that has run away counts among what has fallen, by its mass.
TEST(FallenShare, CountsTheFill) {
  const Assembly assembly = heap(flowing());
  const Model model = build_model(assembly, {});
  State state = initial_state(model);
  EXPECT_EQ(fallen_share(model, state, 1.0), 0.0);
  double whole = 0.0;
  for (const double mass : model.fill.mass) whole += mass;
  state.fill.pose[node_width * 3] = 1.5;  // m
  state.fill.pose[node_width * 4 + 2] = std::numeric_limits<double>::quiet_NaN();
  state.fill.pose[node_width * 5 + 1] = 0.5;
  EXPECT_NEAR(fallen_share(model, state, 1.0), (model.fill.mass[3] + model.fill.mass[4]) / whole, 1e-12);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::ladder
