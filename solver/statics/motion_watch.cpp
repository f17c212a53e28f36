#include "solver/statics/motion_watch.h"

#include "solver/statics/equilibrium.h"

namespace voussoir {

void MotionWatch::Track::follow(double now, double done, double least) {
  moved = std::max(moved, now);
  work += done;
  if (moved < least || moved < 2.0 * begun) return;
  before = drive;
  drive = work / (moved - begun);
  begun = moved, work = 0.0;
}

MotionWatch::MotionWatch(const Model& model, const std::vector<char>& loaded, const State& from, double distance)
    : model_(model),
      mark_(loaded),
      pose_(from.pose),
      nodes_(from.fill.pose),
      distance_(distance),
      far_(std::max(model.typical_size, 4.0 * distance)) {}

bool MotionWatch::hopeless(const State& state, double work) {
  double loaded = 0.0, stones = 0.0, fill = 0.0;
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const bool marked = !mark_.empty() && mark_[i];
    double& largest = marked ? loaded : stones;
    if (!model_.bodies[i].still()) largest = std::max(largest, body_displacement(model_, pose_, state.pose, i));
  }
  for (std::size_t i = 0; i < nodes_.size(); i += node_width)
    fill = std::max(fill, (Vec3(&state.fill.pose[i]) - Vec3(&nodes_[i])).norm());
  const double least = 0.25 * distance_;  // so that two doublings are known at the distance
  loaded_.follow(std::max(loaded, fill), work, least);
  stones_.follow(stones, work, least);
  if (std::max({loaded, stones, fill}) > far_) return true;
  constexpr double takes_part = 0.1;  // of the largest displacement
  const bool masonry = stones > takes_part * std::max(loaded, fill);
  if (masonry && stones > distance_) return stones_.driven_on();
  return model_.fill.empty() && loaded > distance_ && loaded_.driven_on();
}

}  // namespace voussoir
