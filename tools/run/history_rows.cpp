#include "tools/run/history_rows.h"

#include <fmt/format.h>

#include "solver/step/damage.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

namespace {

/// Mean displacement of the centroids of the group's blocks, relative to the base and to the state after gravity.
double group_displacement(const Simulation& run, const DemandPoint& point) {
  const std::vector<std::int64_t>& blocks = run.assembly().groups.at(point.group);
  double sum = 0.0;
  for (std::int64_t b : blocks)
    sum += relative_displacement(run.model(), run.state(), b, run.assembly().blocks[b].centroid)[point.axis];
  return sum / double(blocks.size());
}

}  // namespace

std::string demand_channel(const DemandPoint& point) {
  return fmt::format("demand/{} {}", point.group, "xyz"[point.axis]);
}

std::vector<DemandPoint> demand_points(const Assembly& assembly) {
  std::vector<DemandPoint> points;
  for (const auto& [name, blocks] : assembly.groups) {
    if (blocks.empty()) continue;
    if (name.starts_with("keystone")) points.push_back({name, 0});
    if (name.starts_with("spandrel")) points.push_back({name, 1});
  }
  return points;
}

std::vector<std::string> shown_places(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& [name, blocks] : assembly.groups)
    if (!blocks.empty() &&
        (name.starts_with("keystone ") || name.starts_with("quarter ") || name.starts_with("pier top ")))
      names.push_back(name);
  return names;
}

const std::vector<std::pair<const char*, double StepRow::*>>& step_channels() {
  static const std::vector<std::pair<const char*, double StepRow::*>> all = {
      {"steps/share", &StepRow::share},
      {"steps/multiplier", &StepRow::multiplier},
      {"steps/displacement", &StepRow::displacement},
      {"steps/force", &StepRow::force}};
  return all;
}

namespace {

/// Mean over a group's blocks of displacement and rotation since the last gravity stage.
std::pair<Vec3, Vec3> place_moved(const Simulation& run, const std::string& group) {
  const std::vector<std::int64_t>& blocks = run.assembly().groups.at(group);
  Vec3 u = Vec3::Zero(), turn = Vec3::Zero();
  for (const std::int64_t b : blocks) {
    u += relative_displacement(run.model(), run.state(), b, run.assembly().blocks[std::size_t(b)].centroid);
    turn += relative_rotation(run.model(), run.state(), b);
  }
  return {u / double(blocks.size()), turn / double(blocks.size())};
}

void add_step_channels(const Simulation& run, std::vector<Channel>& channels) {
  const char* units[] = {"-", "-", "m", "N"};
  for (std::size_t i = 0; i < step_channels().size(); ++i) channels.push_back({step_channels()[i].first, units[i]});
  const DeckLine deck(run.assembly());
  for (const double x : deck.stations()) channels.push_back({DeckLine::channel(x), "m"});
}

}  // namespace

std::vector<Channel> history_channels(const Simulation& run) {
  const Assembly& assembly = run.assembly();
  std::vector<Channel> channels = {{"time", "s"}, {"stage", "-"}};
  for (const auto& term : energy_terms()) channels.push_back({std::string("energy/") + term.first, "J"});
  channels.push_back({"energy/balance_error", "-"});
  for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("base/displacement_{}", axis), "m"});
  for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("base/acceleration_{}", axis), "m/s2"});
  channels.push_back({"contacts", "-"});
  for (const DemandPoint& point : demand_points(assembly)) channels.push_back({demand_channel(point), "m"});
  for (const std::string& family : bonded_families(assembly))
    channels.push_back({fmt::format("damage/{}/broken_share", family), "-"});
  for (const Sensor& sensor : assembly.sensors) {
    channels.push_back({"sensors/" + sensor.id + "/displacement", "m"});
    channels.push_back({"sensors/" + sensor.id + "/since_built", "m"});
    channels.push_back({"sensors/" + sensor.id + "/velocity", "m/s"});
    channels.push_back({"sensors/" + sensor.id + "/acceleration", "m/s2"});
    for (char axis : {'x', 'y', 'z'})
      channels.push_back({fmt::format("sensors/{}/rotation_{}", sensor.id, axis), "rad"});
  }
  for (const std::string& group : run.held_groups())
    for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("reactions/{}_{}", group, axis), "N"});
  for (const std::string& place : shown_places(assembly))
    for (const auto& [what, unit] : {std::pair{"displacement", "m"}, std::pair{"rotation", "rad"}})
      for (char axis : {'x', 'y', 'z'}) channels.push_back({fmt::format("places/{}/{}_{}", place, what, axis), unit});
  if (run.quasi_static()) add_step_channels(run, channels);
  return channels;
}

std::vector<double> history_row(const Simulation& run, const Sample& s, const DeckLine& deck) {
  std::vector<double> row = {s.time, double(s.stage + 1)};
  for (const auto& term : energy_terms()) row.push_back(s.energies.*term.second);
  row.push_back(s.balance_error);
  for (int c = 0; c < 3; ++c) row.push_back(s.base_displacement[c]);
  for (int c = 0; c < 3; ++c) row.push_back(s.base_acceleration[c]);
  row.push_back(double(s.contacts));
  for (const DemandPoint& point : demand_points(run.assembly())) row.push_back(group_displacement(run, point));
  row.insert(row.end(), s.broken_shares.begin(), s.broken_shares.end());
  for (std::size_t i = 0; i < run.assembly().sensors.size(); ++i) {
    const Sensor& sensor = run.assembly().sensors[i];
    const Vec3 u = relative_displacement(run.model(), run.state(), sensor.block, sensor.position);
    row.push_back(sensor.direction.dot(u));
    row.push_back(
        sensor.direction.dot(displacement_since_built(run.model(), run.state(), sensor.block, sensor.position)));
    row.push_back(sensor.direction.dot(point_velocity(run.model(), run.state(), sensor.block, sensor.position)));
    row.push_back(s.accelerations[i]);
    const Vec3 turn = relative_rotation(run.model(), run.state(), sensor.block);
    for (int c = 0; c < 3; ++c) row.push_back(turn[c]);
  }
  for (const Vec3& reaction : s.reactions) row.insert(row.end(), reaction.begin(), reaction.end());
  for (const std::string& place : shown_places(run.assembly())) {
    const auto [u, turn] = place_moved(run, place);
    row.insert(row.end(), u.begin(), u.end());
    row.insert(row.end(), turn.begin(), turn.end());
  }
  if (!run.quasi_static()) return row;
  for (const auto& [name, value] : step_channels()) row.push_back(s.step.*value);
  const std::vector<double> settled = deck.displacements(run.model(), run.state());
  row.insert(row.end(), settled.begin(), settled.end());
  return row;
}

}  // namespace voussoir
