#include "tools/bench/phases.h"

#include <unistd.h>

#include <Eigen/Dense>
#include <chrono>
#include <filesystem>

#include "io/hdf5/checkpoint_file.h"
#include "solver/contact/search.h"
#include "solver/linear/dense_solve.h"
#include "solver/step/energy.h"

namespace voussoir {

namespace {

using Clock = std::chrono::steady_clock;

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

Work operator*(double n, const Work& w) {
  return {n * w.bytes, n * w.operations};
}

/// The work of every joint, intact or not: constants, mode and last jump read and written; jump, its change, forces,
/// sums and the check for clipping.
Work joint_work() {
  const double bytes = double(sizeof(JointBatch)) / lane_count + 1.0 + 2.0 * 6.0 * sizeof(float);
  constexpr double jump = 198, change = 6, wrench = 66, sums = 12, clip = 12;
  return {bytes, jump + change + wrench + sums + clip};
}

}  // namespace

Work intact_work(int branches) {
  constexpr double check = 19, resultant = 13;
  Work w = joint_work();
  w.bytes += 2.0 * 6.0 * branches * sizeof(float);
  w.operations += check + resultant + (branches > 0 ? 39.0 + 36.0 * branches : 0.0);
  return w;
}

Work points_work(int branches, double points, bool rectangle) {
  Work w = joint_work();
  // Plastic slip s and t read and written, flags, branches read and written.
  const double bytes = (rectangle ? 0.0 : 24.0) + 32.0 + 1.0 + 2.0 * 3.0 * branches * sizeof(float);
  // For a point that does not yield: jump and change 11, trial 16, tractions and sums 18, opening 1, its place 2.
  // Points that yield are not counted.
  const double operations = 48.0 + (branches > 0 ? 18.0 * branches + 9.0 : 0.0);
  w.bytes += points * bytes + 2.0 * 5.0 * sizeof(double);  // energies, largest opening and slip
  w.operations += 20.0 + points * operations;              // limits of the law, products after the last point
  return w;
}

Work body_work(double sums) {
  const double bytes = double(sizeof(BodyBatch)) / lane_count + 2.0 * sizeof(double) * (pose_width + motion_width) +
                       sizeof(double) * wrench_width * sums + 8.0;
  // Sums, moment and velocities 34, spins 128, rotations 59, norm 13, position 6, speed 6. The search distance is
  // checked only every few time steps.
  return {bytes, 6.0 * sums + 34.0 + 128.0 + 59.0 + 13.0 + 6.0 + 6.0};
}

namespace {

constexpr double gradient_operations = 110.0, volume_operations = 35.0;  // with edges and areas

/// The times of the tiles of the fill over `n` time steps.
void add_fill_phases(const Running& r, const std::vector<TileCost>& costs, double n, std::vector<Phase>& phases) {
  const FillModel& fill = r.model.fill;
  TileCost all;
  for (std::size_t i = r.model.tiles.size(); i < costs.size(); ++i) {
    all.volumes += costs[i].volumes, all.patches += costs[i].patches, all.bodies += costs[i].bodies;
    all.yielding += costs[i].yielding;
  }
  double flowed = 0.0;
  for (std::size_t b = 0; b < fill.batches.size(); ++b)
    for (int lane = 0; lane < lane_count; ++lane)
      if (r.state.fill.yield[lane_count * b + std::size_t(lane)] != 0) {
        flowed += 1.0;
        break;
      }
  flowed /= double(fill.batches.size());
  const double tets = double(fill.lane_of_tet.size()), nodes = double(fill.nodes.size());
  const double sums = double(fill.sums.size()) / nodes;
  phases.push_back({"tetrahedra: means", tets, all.volumes / n, tets * volume_work(flowed)});
  phases.push_back(
      {"tetrahedra: stresses", tets, all.patches / n, tets * stress_work(r.stepper.damping.branches.count, flowed)});
  phases.push_back({"nodes", nodes, all.bodies / n, nodes * node_work(sums)});
  phases.push_back({"tetrahedra that flow", double(all.yielding) / n, 0.0, {}});
}

}  // namespace

Work volume_work(double flowed) {
  const double bytes = double(sizeof(TetBatch)) / lane_count + 1.0 + 8.0 * flowed;
  return {bytes, gradient_operations + volume_operations + 6.0 + flowed};
}

Work stress_work(int branches, double flowed) {
  const double kept = branches > 0 ? 2.0 * sizeof(float) * (strain_rows + 6.0 * branches) : 0.0;
  const double bytes = double(sizeof(TetBatch)) / lane_count + 2.0 + kept + 8.0 * plastic_width * flowed;
  // Cofactor 27, b 42, its deviator 67, mean and pressure 11, yield 20, Kirchhoff 26, Piola 45, nodal forces 66.
  const double elastic = gradient_operations + volume_operations + 304.0;
  // Material strain 79, change 7, work 25, stress 22, its part of Piola 60, and 30 a branch.
  const double viscous = branches > 0 ? 193.0 + 30.0 * branches : 0.0;
  return {bytes, elastic + viscous + 75.0 * flowed};
}

Work node_work(double sums) {
  // Displacement and velocity read and written, searched, mass twice, weight, held; sums of forces and of volumes.
  const double bytes = 4.0 * sizeof(Quad) + 16.0 + 25.0 + sums * (sizeof(Quad) + 8.0 + 8.0);
  return {bytes, 4.0 * sums + 40.0};
}

std::vector<Phase> step_phases(Running& r, std::int64_t steps) {
  std::vector<TileCost> costs;
  const int threads = r.stepper.threads;
  r.stepper.threads = 1;
  r.stepper.costs = &costs;
  const Progressed p = advance_scene(r, steps);
  r.stepper.costs = nullptr;
  r.stepper.threads = threads;
  const auto tiles = Eigen::Index(r.model.tiles.size());
  Eigen::MatrixXd counts(tiles, 4);
  Eigen::VectorXd times(tiles);
  double bodies = 0.0;
  for (Eigen::Index i = 0; i < tiles; ++i) {
    const TileCost& c = costs[std::size_t(i)];
    counts.row(i) << double(c.intact), double(c.points), double(c.contacts), double(c.interface);
    times[i] = c.patches;
    bodies += c.bodies;
  }
  const Eigen::Vector4d each = shortest_least_squares(counts, times);
  const double n = double(p.steps);
  const Eigen::Vector4d all = counts.colwise().sum().transpose() / n;
  const int branches = r.stepper.damping.branches.count;
  double rectangles = 0.0, points = 0.0;
  for (const JointBatch& b : r.model.batches) rectangles += b.rectangles, points += b.points;
  const double batches = double(std::max<std::size_t>(1, r.model.batches.size()));
  const double share = rectangles / batches, mean_points = points / batches;
  const double n_bodies = double(r.model.bodies.size());
  const Work by_points = points_work(branches, mean_points, false),
             of_rectangle = points_work(branches, mean_points, true);
  const Work mixed = {share * of_rectangle.bytes + (1.0 - share) * by_points.bytes, by_points.operations};
  std::vector<Phase> phases = {
      {"intact patches", all[0], each[0] * all[0], all[0] * intact_work(branches)},
      {"point-wise patches", all[1], each[1] * all[1], all[1] * mixed},
      {"contacts", all[2], each[2] * all[2], {}},
      {"patches with the fill", all[3], each[3] * all[3], {}},
      {"gather and integrate", n_bodies, bodies / n, n_bodies * body_work(double(r.model.sums.size()) / n_bodies)},
      {"contact search", double(p.searches) / n, p.search_seconds / n, {}}};
  if (!r.model.fill.empty()) add_fill_phases(r, costs, n, phases);
  return phases;
}

SideCosts side_costs(Running& r) {
  SideCosts costs;
  State copy = r.state;
  for (std::size_t i = 0; i < copy.searched.size(); i += searched_width) copy.searched[i] = 1e18f;
  costs.search = seconds_of([&] { update_contacts(r.model, copy, r.stepper.damping.branches); });
  r.stepper.patches_only();
  Energies e;
  costs.history = seconds_of([&] { e = compute_energies(r.stepper, r.stepper.body_pass()); });
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("voussoir-bench-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  costs.checkpoint = seconds_of([&] { write_checkpoint((folder / "one.h5").string(), {}, r.state.arrays()); });
  std::filesystem::remove_all(folder);
  return costs;
}

double bytes_held(const Running& r) {
  const auto of = [](const auto& list) { return double(list.capacity()) * double(sizeof(list[0])); };
  const Model& m = r.model;
  const State& s = r.state;
  double sum = of(m.bodies) + of(m.joints) + of(m.joint_of_patch) + of(m.points) + of(m.corners) + of(m.batches) +
               of(m.batch_corners) + of(m.sums) + of(m.first_sum) + of(m.matter) + of(m.contact_law);
  for (const auto& cells : m.cells) {
    sum += of(cells);
    for (const Convex& c : cells) sum += of(c.vertices);
  }
  for (const Array<double>* a : {&s.pose, &s.motion, &s.baseline, &s.slip, &s.branch_work}) sum += of(*a);
  sum += of(s.searched) + of(s.listed) + of(s.branch) + of(s.pair_cells) + of(s.pair_seen) + of(m.joint_by_cells);
  sum += of(s.contacts) + of(s.contact_batches) + of(s.contact_points) + of(s.contact_corners) + of(s.contact_slid);
  for (const PatchMemory* memory : {&s.joint, &s.contact})
    sum += of(memory->point) + of(memory->point_rest) + of(memory->broken) + of(memory->point_branch) +
           of(memory->mode) + of(memory->largest) + of(memory->last) + of(memory->energy);
  return sum;
}

}  // namespace voussoir
