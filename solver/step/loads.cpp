#include "solver/step/loads.h"

#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/step/drive.h"

namespace voussoir {

double eased(double time, double duration) {
  constexpr double turn = 2.0 * pi;
  const double share = std::clamp(time / duration, 0.0, 1.0);
  return share - std::sin(turn * share) / turn;
}

void LoadsAtWork::act(const Model& model, const State& state, std::size_t body, double share, Triple<double>& force,
                      Triple<double>& moment) const {
  Vec3 f = model.bodies[body].mass * ((1.0 - share) * acceleration_from + share * acceleration_to), m = Vec3::Zero();
  if (!first.empty())
    for (std::int32_t i = first[body]; i < first[body + 1]; ++i) {
      const PointLoad& load = points[std::size_t(i)];
      const Vec3 p = (1.0 - share) * load.from + share * load.to;
      f += p;
      m += (rotation_of(state, body) * load.arm).cross(p);
    }
  force = {f.x(), f.y(), f.z()};
  moment = {m.x(), m.y(), m.z()};
}

Loads loads_after(const std::vector<StageSettings>& stages, std::size_t stage) {
  for (std::size_t i = std::min(stage + 1, stages.size()); i-- > 0;)
    if (stages[i].loads && stages[i].kind != StageSettings::Kind::collapse) return *stages[i].loads;
  return {};
}

namespace {

void add_points(const Assembly& assembly, const Model& model, const ForceLoad& load, bool end,
                std::vector<PointLoad>& points) {
  const std::vector<std::int64_t>& blocks = group_of(assembly, load.group, "a load acts on", false);
  if (load.at && blocks.size() > 1)
    throw InputError(
        "a load acts at a point of the group '{}', which has {} blocks: name a group of one block, or "
        "leave out 'at' to share the force by mass",
        load.group, blocks.size());
  double mass = 0.0;
  for (std::int64_t block : blocks) mass += assembly.blocks[block].mass;
  for (std::int64_t block : blocks) {
    const Block& b = assembly.blocks[block];
    if (model.bodies[std::size_t(model.body_of_block[std::size_t(block)])].still())
      throw InputError(
          "a load acts on the group '{}', but its block {} is fixed: only free and guided blocks can be loaded",
          load.group, block);
    PointLoad point;
    point.body = model.body_of_block[block];
    if (load.at) point.arm = *load.at - b.centroid;
    (end ? point.to : point.from) = b.mass / mass * load.force;
    points.push_back(point);
  }
}

}  // namespace

LoadsAtWork loads_at_work(const Assembly& assembly, const Model& model, const Loads& from, const Loads& to) {
  LoadsAtWork work;
  work.acceleration_from = from.acceleration;
  work.acceleration_to = to.acceleration;
  for (const ForceLoad& load : from.forces) add_points(assembly, model, load, false, work.points);
  for (const ForceLoad& load : to.forces) add_points(assembly, model, load, true, work.points);
  if (work.points.empty()) return work;
  std::stable_sort(work.points.begin(), work.points.end(),
                   [](const PointLoad& a, const PointLoad& b) { return a.body < b.body; });
  work.first.assign(model.bodies.size() + 1, 0);
  for (const PointLoad& p : work.points) ++work.first[std::size_t(p.body) + 1];
  for (std::size_t i = 1; i < work.first.size(); ++i) work.first[i] += work.first[i - 1];
  return work;
}

Loads loads_at(const Loads& base, const StageSettings& stage, const Vec3& gravity, double multiplier) {
  Loads sum = base;
  if (stage.collapse.tilt)
    sum.acceleration += Eigen::AngleAxisd(std::atan(multiplier), stage.collapse.tilt->normalized()) * gravity - gravity;
  if (!stage.loads) return sum;
  sum.acceleration += multiplier * stage.loads->acceleration;
  for (ForceLoad load : stage.loads->forces) {
    load.force *= multiplier;
    sum.forces.push_back(load);
  }
  return sum;
}

}  // namespace voussoir
