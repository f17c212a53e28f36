#include "solver/step/loads.h"

#include <algorithm>
#include <cmath>

#include "geometry/road.h"
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

void LoadsAtWork::add(std::vector<PointLoad> more, std::size_t bodies) {
  points.insert(points.end(), more.begin(), more.end());
  if (points.empty()) return;
  std::stable_sort(points.begin(), points.end(),
                   [](const PointLoad& a, const PointLoad& b) { return a.body < b.body; });
  first.assign(bodies + 1, 0);
  for (const PointLoad& p : points) ++first[std::size_t(p.body) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
}

Loads with_moving(Loads loads, const std::vector<MovingLoad>& moving, double time) {
  for (const MovingLoad& load : moving) {
    RoadLoad now = load.start;
    now.area.x0 += load.speed * time, now.area.x1 += load.speed * time;
    loads.road.push_back(now);
  }
  return loads;
}

std::int64_t parts_of_way(const std::vector<MovingLoad>& moving, double duration) {
  constexpr double part = 0.1;  // m: less than a wheel is long
  double way = 0.0;
  for (const MovingLoad& load : moving) way = std::max(way, std::abs(load.speed) * duration);
  return std::max<std::int64_t>(1, std::int64_t(std::ceil(way / part - 1e-9)));
}

namespace {

/// Adds a share of some loads to others.
void add_share(const Loads& loads, double share, Loads& sum) {
  sum.acceleration += share * loads.acceleration;
  for (ForceLoad load : loads.forces) {
    load.force *= share;
    sum.forces.push_back(load);
  }
  for (RoadLoad load : loads.road) {
    load.pressure *= share;
    sum.road.push_back(load);
  }
}

/// Where the path of a quasi-static stage ends.
Loads at_end_of_path(const Loads& before, const StageSettings& stage) {
  const double share = stage.quasi_static.path.back();
  if (share == 1.0) return *stage.loads;
  Loads sum;
  add_share(before, 1.0 - share, sum);
  add_share(*stage.loads, share, sum);
  return sum;
}

}  // namespace

Loads loads_after(const std::vector<StageSettings>& stages, std::size_t stage) {
  for (std::size_t i = std::min(stage + 1, stages.size()); i-- > 0;) {
    const auto before = [&] { return i > 0 ? loads_after(stages, i - 1) : Loads{}; };
    if (!stages[i].moving.empty()) return with_moving(before(), stages[i].moving, stages[i].duration);
    if (!stages[i].loads || stages[i].kind == StageSettings::Kind::collapse) continue;
    return stages[i].kind == StageSettings::Kind::quasi_static ? at_end_of_path(before(), stages[i]) : *stages[i].loads;
  }
  return {};
}

namespace {

void add_points(const Assembly& assembly, const Model& model, const ForceLoad& load, bool end,
                std::vector<PointLoad>& points) {
  const std::vector<std::int64_t>& blocks = group_of(assembly, load.group, "a load acts on", false);
  if (load.at && blocks.size() > 1)
    throw InputError(
        "a load acts at a point of the group '{}', which has {} blocks. Name a group of one block, or leave out 'at' "
        "to distribute the force by mass.",
        load.group, blocks.size());
  double mass = 0.0;
  for (std::int64_t block : blocks) mass += assembly.blocks[block].mass;
  for (std::int64_t block : blocks) {
    const Block& b = assembly.blocks[block];
    if (model.bodies[std::size_t(model.body_of_block[std::size_t(block)])].still())
      throw InputError(
          "a load acts on the group '{}', but its block {} is fixed. Only free and guided blocks can be loaded.",
          load.group, block);
    PointLoad point;
    point.body = model.body_of_block[block];
    if (load.at) point.arm = *load.at - b.centroid;
    (end ? point.to : point.from) = b.mass / mass * load.force;
    points.push_back(point);
  }
}

constexpr double part_of_gaps = 0.02;  // of a rectangle: open joints in a drawn deck

/// The part of a rectangle between the ends of the road.
RoadArea on_the_way(const RoadArea& area, const RoadArea& road) {
  return {std::max(area.x0, road.x0), std::min(area.x1, road.x1), area.y0, area.y1};
}

/// Forces for a unit pressure are those of the whole rectangle, even if joints are open.
double evened(const RoadShare& share, const RoadArea& wanted, const RoadLoad& load, const RoadArea& road) {
  const double whole = wanted.area();
  if (std::abs(share.area - whole) > part_of_gaps * whole)
    throw InputError(
        "{} stands on x = {:.3f} to {:.3f} m, y = {:.3f} to {:.3f} m, but {:.3g} m2 of this area is not road. The road "
        "lies within y = {:.3f} to {:.3f} m, between the parapets or other parts on it. Move the vehicle sideways, or "
        "choose a narrower vehicle.",
        load.of, wanted.x0, wanted.x1, wanted.y0, wanted.y1, whole - share.area, road.y0, road.y1);
  return whole / share.area;
}

}  // namespace

const Road& LoadPlaces::road() const {
  if (!road_) road_ = std::make_shared<const Road>(*assembly_);
  return *road_;
}

void LoadPlaces::add_road(const RoadLoad& load, bool end, LoadsAtWork& work) const {
  const RoadArea wanted = on_the_way(load.area, road().extent());
  constexpr double nothing = 1e-9;  // m
  if (wanted.x1 - wanted.x0 < nothing) return;
  const RoadShare share = road().under(wanted);
  const double pressure = load.pressure * evened(share, wanted, load, road().extent());
  for (const RoadShare::OfBlock& of : share.blocks) {
    PointLoad point;
    point.body = model_->body_of_block[of.block];
    point.arm = of.centre - assembly_->blocks[std::size_t(of.block)].centroid;
    (end ? point.to : point.from) = Vec3(0.0, 0.0, -pressure * of.area);
    work.points.push_back(point);
  }
  if (share.nodes.empty()) return;
  Array<double>& nodes = end ? work.nodes_to : work.nodes_from;
  for (Array<double>* both : {&work.nodes_from, &work.nodes_to})
    both->resize(node_width * model_->fill.nodes.size(), 0.0);
  for (const RoadShare::OfNode& of : share.nodes)
    nodes[node_width * std::size_t(model_->fill.node_of[std::size_t(of.node)]) + 2] -= pressure * of.area;
}

LoadsAtWork LoadPlaces::at_work(const Loads& from, const Loads& to) const {
  LoadsAtWork work;
  work.acceleration_from = from.acceleration;
  work.acceleration_to = to.acceleration;
  for (const ForceLoad& load : from.forces) add_points(*assembly_, *model_, load, false, work.points);
  for (const ForceLoad& load : to.forces) add_points(*assembly_, *model_, load, true, work.points);
  for (const RoadLoad& load : from.road) add_road(load, false, work);
  for (const RoadLoad& load : to.road) add_road(load, true, work);
  work.add({}, model_->bodies.size());
  return work;
}

Loads loads_at(const Loads& base, const StageSettings& stage, const Vec3& gravity, double multiplier) {
  Loads sum = base;
  if (stage.collapse.tilt)
    sum.acceleration += Eigen::AngleAxisd(std::atan(multiplier), stage.collapse.tilt->normalized()) * gravity - gravity;
  if (stage.loads) add_share(*stage.loads, multiplier, sum);
  return sum;
}

}  // namespace voussoir
