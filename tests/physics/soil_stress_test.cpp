// Stresses of a deformable fill as snapshots have them, against closed forms.
#include "solver/step/make_snapshot.h"
#include "solver/step/principal_stress.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(PrincipalStress, OfKnownTensors) {
  EXPECT_NEAR(largest_compression({-1e3, -2e3, -6e3, 0, 0, 0}), 6e3, 1e-9);
  EXPECT_NEAR(largest_compression({0, 0, 0, 500, 0, 0}), 500.0, 1e-9) << "pure shear";
  EXPECT_NEAR(largest_compression({0, 0, 0, 0, 500, 0}), 500.0, 1e-9);
  EXPECT_NEAR(largest_compression({0, 0, 0, 0, 0, 500}), 500.0, 1e-9);
  EXPECT_NEAR(largest_compression({7, 8, 9, 0, 0, 0}), -7.0, 1e-9) << "all of them pull";
}

/// Soil in a smooth stiff box bears what lies above: σ1 = γ z upright. Of a layer of cells the mean is that of its
/// middle, and no tetrahedron is off by more than half a layer.
TEST(PrincipalStress, OfSoilInABoxIsTheWeightAbove) {
  constexpr double height = 4.0, g = 9.81, density = 1800.0, youngs = 5e7, poisson = 0.25;
  constexpr int layers = 8;
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {2, 2, 0}, true);
  add_box(assembly, {-1, 0, 0}, {0, 1, height}, true);
  add_box(assembly, {1, 0, 0}, {2, 1, height}, true);
  add_box(assembly, {-1, -1, 0}, {2, 0, height}, true);
  add_box(assembly, {-1, 1, 0}, {2, 2, height}, true);
  const Material soil = elastic_fill(density, youngs / (3.0 - 6.0 * poisson), youngs / (2.0 + 2.0 * poisson));
  Bench bench(
      filled(std::move(assembly), box_mesh({0, 0, 0}, {1, 1, height}, 2, 2, layers), soil, 1e12, 1.0, elastic_law()),
      undamped({0, 0, -g}));
  ASSERT_TRUE(bench.balance(1e-8).converged);
  const Snapshot snapshot = make_snapshot(bench.model, bench.state);
  const FillMesh& mesh = bench.assembly.fill;
  std::array<double, layers> sum = {}, volume = {};
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    double z = 0.0;
    for (const std::int32_t node : mesh.tets[i]) z += 0.25 * mesh.nodes[std::size_t(node)].z();
    const auto layer = std::size_t(z / (height / layers));
    const double stress = largest_compression(snapshot.fill.tets[i].stress);
    const double middle = density * g * (height - (double(layer) + 0.5) * height / layers);
    EXPECT_NEAR(stress, middle, density * g * 0.5 * height / layers) << i;
    sum[layer] += stress, volume[layer] += 1.0;  // all tetrahedra are of one size
  }
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const double middle = density * g * (height - (double(layer) + 0.5) * height / layers);
    EXPECT_NEAR(sum[layer] / volume[layer], middle, 0.01 * density * g * height) << layer;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
