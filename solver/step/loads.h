// Loads of a stage in addition to gravity: an acceleration of all free blocks and of the fill, forces on groups of
// blocks, pressures on the road, and loads that move along it.
#pragma once
#include <memory>

#include "geometry/assembly.h"
#include "solver/model/settings.h"
#include "solver/model/state.h"

namespace voussoir {

class Road;

/// A force of constant direction on a point that moves with its body.
struct PointLoad {
  std::int32_t body = 0;
  Vec3 arm = Vec3::Zero();                      // m, from the centroid, reference axes
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // N
};

/// Loads in addition to gravity. Each load changes from one value to another as `share` goes from 0 to 1.
struct LoadsAtWork {
  Vec3 acceleration_from = Vec3::Zero(), acceleration_to = Vec3::Zero();  // m/s2, on free bodies and the fill
  std::vector<PointLoad> points;                                          // by body
  Array<std::int32_t> first;           // point load of each body, and one past the end; empty: no point loads
  Array<double> nodes_from, nodes_to;  // N, node_width per node of the fill; empty: none

  bool accelerates() const { return !acceleration_from.isZero(0.0) || !acceleration_to.isZero(0.0); }
  bool none() const { return first.empty() && nodes_to.empty() && !accelerates(); }
  /// Force (N) and moment about the centroid (N m) on one body in its present placement, world axes.
  void act(const Model& model, const State& state, std::size_t body, double share, Triple<double>& force,
           Triple<double>& moment) const;
  /// Adds forces on points of some of the model's bodies.
  void add(std::vector<PointLoad> more, std::size_t bodies);
};

/// Share of a path from rest to rest: the cycloid τ − sin 2πτ / 2π with τ = time / duration, limited to 0 to 1.
double eased(double time, double duration);

/// `loads` together with the moving loads at `time` (s) after the beginning of their stage.
Loads with_moving(Loads loads, const std::vector<MovingLoad>& moving, double time);
/// Number of equal time intervals into which the way of the moving loads of a stage of this duration (s) is divided. A
/// load is at its exact position at the ends of each interval. In between, the program distributes it to the two
/// positions, so that its sum and moment are exact at any time.
std::int64_t parts_of_way(const std::vector<MovingLoad>& moving, double duration);

/// Loads at the end of a stage: its own loads, or those of an earlier stage that remain.
Loads loads_after(const std::vector<StageSettings>& stages, std::size_t stage);

/// Points of application of loads on an assembly. The road is determined when the first load lies on it.
class LoadPlaces {
 public:
  LoadPlaces(const Assembly& assembly, const Model& model) : assembly_(&assembly), model_(&model) {}
  /// Throws InputError for a group that does not exist, that contains a fixed block without a guide, or that has more
  /// than one block if the force acts at a point, and for a road load beside the road. Forces on a group are
  /// distributed in proportion to mass, pressures on the road according to their position (RoadShare).
  LoadsAtWork at_work(const Loads& from, const Loads& to) const;

 private:
  const Road& road() const;
  void add_road(const RoadLoad& load, bool end, LoadsAtWork& work) const;

  const Assembly* assembly_;
  const Model* model_;
  mutable std::shared_ptr<const Road> road_;
};

/// Loads in a collapse stage at a multiplier: `base` and the multiplied pattern, or gravity rotated about the axis of
/// the stage by the arc tangent of the multiplier.
Loads loads_at(const Loads& base, const StageSettings& stage, const Vec3& gravity, double multiplier);

}  // namespace voussoir
