// The contact patch test: fill between stones whose faces match neither one another nor the triangles of the fill,
// under pressure. A constant pressure must be transmitted exactly.
#include "tools/ladder/fill_models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double pressure = 1e4, kn = 4e9, ks = 1.6e9, youngs = 400e6;  // Pa, Pa/m

/// A fixed stone below, three above; Poisson's ratio zero, so that nothing spreads sideways. `turn` is the placement of
/// the whole.
Assembly sandwich(const Eigen::Quaterniond& turn) {
  Assembly assembly = stone();
  const auto add = [&](const Vec3& low, const Vec3& high, bool fixed) {
    Polyhedron box = make_box(low, high);
    turn_all(box.vertices, turn);
    add_block(assembly, box, fixed);
  };
  add({0, 0, -1}, {2, 2, 0}, true);
  add({0, 0, 1}, {1.3, 2, 1.5}, false);
  add({1.3, 0, 1}, {2, 0.7, 1.5}, false);
  add({1.3, 0.7, 1}, {2, 2, 1.5}, false);
  FillMesh mesh = box_mesh({0, 0, 0}, {2, 2, 1}, 3, 4, 2);
  for (Vec3& x : mesh.nodes)
    if (x.minCoeff() > 0.1 && (Vec3(2, 2, 1) - x).minCoeff() > 0.1)
      x += 0.08 * Vec3(std::sin(9 * x.y()), std::cos(5 * x.x()), std::sin(7 * x.x()));
  turn_all(mesh.nodes, turn);
  return filled(std::move(assembly), std::move(mesh), elastic_fill(1500.0, youngs / 3.0, youngs / 2.0), kn, ks,
                dry_law(0.7));
}

/// The residual forces in equilibrium under the pressure, divided by the pressure: on nodes, and on stones with their
/// moments.
double worst_remainder(const Eigen::Quaterniond& turn) {
  Bench bench(sandwich(turn));
  State& state = bench.state;
  const Vec3 up = turn * Vec3::UnitZ();
  // θ and e are measures of finite strain: the stretch that gives this stress, per area of the reference placement, is
  // found to all digits.
  double strain = -pressure / youngs;
  for (int i = 0; i < 50; ++i) {
    const double j = 1.0 + strain, log = std::log(j);
    const double theta = 0.5 * (j - 1.0 / j),
                 kirchhoff = youngs / 3.0 * theta * 0.5 * (j + 1.0 / j) + youngs / 1.5 * log;
    const double stress = kirchhoff / j;
    strain -= (stress + pressure) / youngs;
  }
  const double gap = -pressure / kn;
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i)
    move_node(state, i, (gap + strain * up.dot(bench.model.fill.nodes[i])) * up);
  for (std::int64_t block = 1; block <= 3; ++block)
    bench.place(block, (2.0 * gap + strain) * up, Eigen::Quaterniond::Identity());
  bench.stepper.patches_only();
  const FillPass fill = bench.stepper.fill_pass();
  double worst = 0.0;
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i) {
    const Quad f = fill.update(i).force;
    worst = std::max(worst, Vec3(f[0], f[1], f[2]).norm());
  }
  const BodyPass bodies = bench.stepper.body_pass();
  const double areas[3] = {2.6, 0.49, 0.91};
  for (std::int64_t block = 1; block <= 3; ++block) {
    const BodyUpdate u = bodies.update(std::size_t(bench.body(block)));
    const Vec3 push = Vec3(u.force.x, u.force.y, u.force.z) - pressure * areas[block - 1] * up;
    worst = std::max({worst, push.norm(), Vec3(u.moment.x, u.moment.y, u.moment.z).norm()});
  }
  return worst / pressure;
}

std::vector<Finding> climb_fill_patch(int) {
  const Eigen::Quaterniond askew = Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized();
  return {nothing("residual forces / pressure", worst_remainder(Eigen::Quaterniond::Identity()), 1e-9, "m2", "uniform"),
          nothing("the same, rotated", worst_remainder(askew), 1e-9, "m2", "uniform")};
}

}  // namespace

Rung fill_patch() {
  return {.name = "fill-patch", .help = "constant pressure between stones and tetrahedra", .climb = climb_fill_patch};
}

}  // namespace voussoir::ladder
