#include "tools/run/summary.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/joint_counts.h"
#include "solver/base/constants.h"
#include "solver/effects/parts.h"
#include "solver/statics/hinges.h"
#include "solver/step/damage.h"
#include "solver/step/loads.h"
#include "tools/run/bridge_damage.h"
#include "tools/run/damage_words.h"
#include "tools/run/history_rows.h"
#include "tools/run/numbered_hinges.h"
#include "tools/run/part_damage.h"

namespace voussoir {

namespace {

nlohmann::json demand_json(const Assembly& assembly, const History& history) {
  nlohmann::json demand = {{"places", nlohmann::json::object()}};
  std::map<std::string, std::pair<double, double>> sums;
  std::map<std::string, int> counts;
  for (const DemandPoint& point : demand_points(assembly)) {
    const std::vector<double>& values = history.values(demand_channel(point));
    double largest = 0.0;
    for (double v : values) largest = std::max(largest, std::abs(v));
    const double residual = values.empty() ? 0.0 : values.back();
    demand["places"][point.group] = {
        {"axis", std::string(1, "xyz"[point.axis])}, {"largest", largest}, {"residual", residual}};
    const std::string kind = point.axis == 0 ? "keystone_x" : "spandrel_y";
    sums[kind].first += largest;
    sums[kind].second += std::abs(residual);
    ++counts[kind];
  }
  for (const auto& [kind, sum] : sums)
    demand[kind] = {{"largest_mean", sum.first / counts[kind]}, {"residual_mean", sum.second / counts[kind]}};
  return demand;
}

/// For each family of joints (joint_family()): share of the area of its bonded joints whose bond is lost, largest
/// opening and slip since the start and at present (m), and the word for its damage.
nlohmann::json damage_json(const Assembly& assembly, const Snapshot& snapshot) {
  struct Damage {
    double bonded = 0.0, broken = 0.0, opening = 0.0, slip = 0.0, open_now = 0.0, slip_now = 0.0;
  };
  std::map<std::string, Damage> damage;
  for (const PatchSnapshot& p : snapshot.patches) {
    Damage& d =
        damage[joint_family(assembly.blocks[std::size_t(p.a)].component, assembly.blocks[std::size_t(p.b)].component)];
    if (p.had_bond) d.bonded += p.area, d.broken += p.area * (1.0 - p.bonded);
    d.opening = std::max(d.opening, p.largest_opening);
    d.slip = std::max(d.slip, p.largest_slip);
    d.open_now = std::max(d.open_now, p.opening);
    d.slip_now = std::max(d.slip_now, p.slip);
  }
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, d] : damage)
    json[name] = {{"broken_share", d.bonded > 0.0 ? d.broken / d.bonded : 0.0},
                  {"bonded", d.bonded > 0.0},
                  {"class", damage_word(d.opening)},
                  {"largest_opening", d.opening},
                  {"largest_slip", d.slip},
                  {"residual_opening", d.open_now},
                  {"residual_slip", d.slip_now}};
  return json;
}

/// The ties: their number, the number that have yielded, the largest force (N) and the largest plastic elongation (m).
/// For each tie the stones it holds with their parts, its anchors as built (m), its last and its largest force (N), and
/// its plastic elongation (m).
nlohmann::json ties_json(const Assembly& assembly, const Snapshot& snapshot) {
  nlohmann::json each = nlohmann::json::array();
  double force = 0.0, farthest = 0.0;
  int yielded = 0;
  const std::vector<std::string> parts = parts_of_blocks(assembly);
  const auto place = [](const Vec3& x) { return nlohmann::json{x.x(), x.y(), x.z()}; };
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const PatchSnapshot& p = snapshot.patches[i];
    if (!p.tie) continue;
    const std::array<Vec3, 2> anchors = tie_anchors(assembly.joints[i]);
    const double most = p.largest_tension * p.area;
    force = std::max(force, most), farthest = std::max(farthest, p.yielded);
    yielded += p.yielded > 1e-9;  // m, more than rounding errors
    each.push_back({{"a", p.a},
                    {"b", p.b},
                    {"parts", {parts[std::size_t(p.a)], parts[std::size_t(p.b)]}},
                    {"from", place(anchors[0])},
                    {"to", place(anchors[1])},
                    {"force", p.normal_traction * p.area},
                    {"largest_force", most},
                    {"yielded", p.yielded}});
  }
  if (each.empty()) return each;
  return {{"count", each.size()},
          {"have_yielded", yielded},
          {"largest_force", force},
          {"farthest_yielded", farthest},
          {"each", each}};
}

/// For each sensor: the largest size of its displacement, its last value, and the last time (s) at which it differed
/// from that value by more than 1e-5 of the largest. first_zero (s) is the time at which it first changed sign after it
/// had exceeded that (linear between rows; 0 if it never did). For its block: the largest rotation (rad), and whether
/// it was ever more than 45°.
nlohmann::json sensors_json(const Assembly& assembly, const History& history) {
  nlohmann::json json = nlohmann::json::object();
  for (const Sensor& sensor : assembly.sensors) {
    const std::vector<double>& u = history.values("sensors/" + sensor.id + "/displacement");
    if (u.empty()) continue;
    double largest = 0.0;
    for (double x : u) largest = std::max(largest, std::abs(x));
    std::size_t last = u.size();
    while (last > 0 && std::abs(u[last - 1] - u.back()) <= 1e-5 * largest) --last;
    double first_zero = 0.0, most_turned = 0.0, so_far = 0.0;
    for (std::size_t i = 1; i < u.size() && first_zero == 0.0; ++i) {
      so_far = std::max(so_far, std::abs(u[i - 1]));
      if (u[i - 1] * u[i] < 0.0 && so_far > 1e-5 * largest)  // rounding errors about zero do not count
        first_zero = history.time()[i - 1] + u[i - 1] / (u[i - 1] - u[i]) * (history.time()[i] - history.time()[i - 1]);
    }
    std::array<const std::vector<double>*, 3> turn;
    for (int c = 0; c < 3; ++c)
      turn[std::size_t(c)] = &history.values(fmt::format("sensors/{}/rotation_{}", sensor.id, "xyz"[c]));
    for (std::size_t i = 0; i < u.size(); ++i) {
      most_turned = std::max(most_turned, Vec3((*turn[0])[i], (*turn[1])[i], (*turn[2])[i]).norm());
    }
    json[sensor.id] = {{"largest", largest},
                       {"residual", u.back()},
                       {"moves_until", last > 0 ? history.time()[last - 1] : 0.0},
                       {"first_zero", first_zero},
                       {"largest_rotation", most_turned},
                       {"overturned", most_turned > 0.25 * pi}};
  }
  return json;
}

/// For each group of fixed blocks: the largest, the smallest and the last reaction along x, y and z (N).
nlohmann::json reactions_json(const std::vector<std::string>& groups, const History& history) {
  nlohmann::json json = nlohmann::json::object();
  for (const std::string& group : groups)
    for (char axis : {'x', 'y', 'z'}) {
      const std::vector<double>& f = history.values(fmt::format("reactions/{}_{}", group, axis));
      if (f.empty()) continue;
      json[group][std::string(1, axis)] = {
          {"highest", std::ranges::max(f)}, {"lowest", std::ranges::min(f)}, {"last", f.back()}};
    }
  return json;
}

/// For the last row of each stage that has rows: time (s), reactions (N), and displacements of the sensors (m) since
/// the end of the last gravity stage and since the blocks were built.
nlohmann::json stages_json(const Simulation& run, const History& history) {
  nlohmann::json json = nlohmann::json::array();
  const std::vector<StageSettings>& stages = run.settings().stages;
  const std::vector<double>& numbers = history.values("stage");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i + 1 < numbers.size() && numbers[i + 1] == numbers[i]) continue;
    const auto stage = std::size_t(numbers[i]);
    nlohmann::json one = {{"stage", stage}, {"label", stages.at(stage - 1).label}, {"time", history.time()[i]}};
    for (const std::string& group : run.held_groups())
      for (char axis : {'x', 'y', 'z'})
        one["reactions"][group].push_back(history.values(fmt::format("reactions/{}_{}", group, axis))[i]);
    for (const Sensor& sensor : run.assembly().sensors)
      for (const char* channel : {"displacement", "since_built"})
        one["sensors"][sensor.id][channel] = history.values("sensors/" + sensor.id + "/" + channel)[i];
    json.push_back(std::move(one));
  }
  return json;
}

/// The kind of the mechanism, "global" or "local", or null if no equilibrium was lost; and the moving part.
void add_loss(const Simulation& run, nlohmann::json& json) {
  const Collapse& c = run.collapse();
  json["loss"] = c.found ? nlohmann::json(c.loss.local ? "local" : "global") : nlohmann::json();
  if (!c.found) return;
  json["moving"] = {{"part", moving_part(run.assembly(), c.loss)},
                    {"blocks", c.loss.blocks.size()},
                    {"share_of_mass", c.loss.share},
                    {"fill", c.loss.fill}};
  if (c.loss.rest_stands) json["rest_stands"] = *c.loss.rest_stands;
}

nlohmann::json curve_json(const Collapse& c) {
  nlohmann::json json = nlohmann::json::array();
  for (const CollapsePoint& p : c.curve)
    json.push_back({{"multiplier", p.multiplier}, {"along", p.along}, {"largest", p.largest}, {"settled", p.settled}});
  return json;
}

/// Whether the dynamic runs agree with the static solver; null if there were no dynamic runs.
nlohmann::json confirmed(const Collapse& c) {
  if (!c.stands_below || !c.falls_above) return {};
  return *c.stands_below && *c.falls_above;
}

/// The result of a collapse stage: the largest multiplier, and the joints of the mechanism beyond it.
nlohmann::json collapse_json(const Simulation& run) {
  const Collapse& c = run.collapse();
  const StageSettings& stage = run.settings().stages.back();
  nlohmann::json json = {{"headline", collapse_headline(run.assembly(), c)},
                         {"found", c.found},
                         {"confirmed", confirmed(c)},
                         {"multiplier", c.multiplier},
                         {"above", c.found ? nlohmann::json(c.above) : nlohmann::json()},
                         {"tries", c.tries.size()},
                         {"mechanism", nlohmann::json::array()},
                         {"stands_below", c.stands_below ? nlohmann::json(*c.stands_below) : nlohmann::json()},
                         {"falls_above", c.falls_above ? nlohmann::json(*c.falls_above) : nlohmann::json()}};
  add_loss(run, json);
  json["curve"] = curve_json(c);
  if (stage.collapse.tilt) json["tilt_degrees"] = std::atan(c.multiplier) * 180.0 / pi;
  const Loads loads = loads_at({}, stage, run.model().gravity, c.multiplier);
  double weight = 0.0;
  for (const Body& body : run.model().bodies)
    if (!body.fixed) weight += body.mass * run.model().gravity.norm();
  Vec3 force = Vec3::Zero();
  for (const ForceLoad& load : loads.forces) force += load.force;
  json["force"] = force.norm();
  json["force_over_weight"] = weight > 0.0 ? force.norm() / weight : 0.0;
  json["acceleration_over_gravity"] = loads.acceleration.norm() / std::max(run.model().gravity.norm(), 1e-300);
  for (const MechanismJoint& joint : c.mechanism)
    json["mechanism"].push_back({{"a", joint.a},
                                 {"b", joint.b},
                                 {"kind", joint.slides ? "slide" : "hinge"},
                                 {"edge", edge_name(run.assembly(), joint)},
                                 {"place", {joint.place.x(), joint.place.y(), joint.place.z()}},
                                 {"opening", joint.opening},
                                 {"slip", joint.slip}});
  json["hinges"] = nlohmann::json::array();
  for (const NumberedHinge& h : numbered_hinges(run.assembly(), c.mechanism, run.model().typical_size))
    json["hinges"].push_back({{"number", h.number},
                              {"kind", h.slides ? "slide" : "hinge"},
                              {"edge", h.edge},
                              {"where", h.where},
                              {"place", {h.place.x(), h.place.y(), h.place.z()}},
                              {"joints", h.joints},
                              {"opening", h.opening},
                              {"slip", h.slip}});
  return json;
}

/// For crowns, quarter points and pier tops: mean displacement (m) and rotation (rad) at the end, since the last
/// gravity stage.
nlohmann::json places_json(const Assembly& assembly, const History& history) {
  nlohmann::json json = nlohmann::json::object();
  for (const std::string& place : shown_places(assembly))
    for (const auto& [what, before] : {std::pair{"displacement", ""}, std::pair{"rotation", "rotation_"}})
      for (const char axis : {'x', 'y', 'z'}) {
        const std::vector<double>& values = history.values(fmt::format("places/{}/{}_{}", place, what, axis));
        if (!values.empty()) json[place][before + std::string(1, axis)] = values.back();
      }
  return json;
}

/// The hinges of the arches at the end.
nlohmann::json hinges_json(const Assembly& assembly, const Snapshot& snapshot) {
  nlohmann::json json = nlohmann::json::array();
  for (const Hinge& hinge : find_hinges(assembly, snapshot))
    json.push_back({{"a", hinge.a},
                    {"b", hinge.b},
                    {"edge", hinge.edge},
                    {"place", {hinge.place.x(), hinge.place.y(), hinge.place.z()}},
                    {"turn", hinge.turn}});
  return json;
}

/// The state of a deformable fill. Shares are of its volume as built.
nlohmann::json fill_json(const FillMesh& mesh, const Snapshot& snapshot) {
  const FillSnapshot& fill = snapshot.fill;
  double whole = 0.0, sheared = 0.0, torn = 0.0, most = 0.0, farthest = 0.0;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto x = [&](std::size_t k) { return mesh.nodes[std::size_t(mesh.tets[i][k])]; };
    const double volume = (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0))) / 6.0;
    whole += volume;
    if (fill.tets[i].yield & has_yielded_in_shear) sheared += volume;
    if (fill.tets[i].yield & has_yielded_in_tension) torn += volume;
    most = std::max(most, fill.tets[i].plastic_shear);
  }
  for (const Vec3& u : fill.displacement) farthest = std::max(farthest, (u - snapshot.base_displacement).norm());
  return {{"nodes", mesh.nodes.size()},         {"tetrahedra", mesh.tets.size()}, {"yielded_in_shear", sheared / whole},
          {"yielded_in_tension", torn / whole}, {"largest_plastic_shear", most},  {"largest_displacement", farthest}};
}

}  // namespace

nlohmann::json joint_kinds_json(const Assembly& assembly) {
  const JointCounts n = count_joints(assembly);
  return {{"bonded", n.bonded}, {"dry", n.dry}, {"ties", n.ties}, {"fill", n.fill}};
}

nlohmann::json summary_of_state(const Simulation& run, const Snapshot& snapshot, const History& history) {
  nlohmann::json json = {{"demand", demand_json(run.assembly(), history)},
                         {"sensors", sensors_json(run.assembly(), history)},
                         {"reactions", reactions_json(run.held_groups(), history)},
                         {"stages", stages_json(run, history)},
                         {"damage", damage_json(run.assembly(), snapshot)},
                         {"hinges", hinges_json(run.assembly(), snapshot)},
                         {"part_damage", part_damage_json(run.assembly(), snapshot)},
                         {"bridge_damage", bridge_damage_json(run.assembly(), snapshot)}};
  if (nlohmann::json places = places_json(run.assembly(), history); !places.empty()) json["places"] = std::move(places);
  if (!snapshot.fill.empty()) json["fill"] = fill_json(run.assembly().fill, snapshot);
  if (nlohmann::json ties = ties_json(run.assembly(), snapshot); !ties.empty()) json["ties"] = std::move(ties);
  if (!run.collapse().tries.empty()) json["collapse"] = collapse_json(run);
  return json;
}

}  // namespace voussoir
