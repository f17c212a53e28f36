#include <algorithm>

#include "io/case/degrees.h"
#include "io/case/sections.h"
#include "solver/base/error.h"

namespace voussoir {

const std::vector<std::string>& damping_kinds() {
  static const std::vector<std::string> names = {"none", "maxwell", "rayleigh", "local"};
  return names;
}

namespace {

void read_analysis(TableReader& table, SolverSettings& settings) {
  if (table.is_list("gravity"))
    settings.gravity = table.vector("gravity", settings.gravity);
  else
    settings.gravity.z() = -table.number("gravity", -settings.gravity.z(), {0.0, 1000.0, "m/s2"});
  StepSettings& s = settings.step;
  s.time_step = table.number("time_step", s.time_step, {0.0, 1.0, "s"});
  s.safety = table.number("safety", s.safety, {0.0, 1.0, "", true});
  s.mass_scaling_limit = table.number("mass_scaling_limit", s.mass_scaling_limit, {0.0, 1.0, ""});
  s.mass_scaling_step = table.number("mass_scaling_step", s.mass_scaling_step, {0.0, 1.0, "s"});
  if (s.mass_scaling_step > 0.0 && s.mass_scaling_limit == 0.0)
    table.missing("mass_scaling_limit", "the share of the mass that may be added; 'mass_scaling_step' needs it");
  s.equilibrium_tolerance = table.number("equilibrium_tolerance", s.equilibrium_tolerance, {0.0, 0.1, "", true});
  s.intact_shortcut = table.flag("intact_shortcut", s.intact_shortcut);
  table.finish();
}

void read_contact(TableReader& table, ContactSettings& s) {
  s.points_per_side = int(table.integer("points_per_side", s.points_per_side, 3, 5));
  s.gap_tolerance = table.number("gap_tolerance", s.gap_tolerance, {0.0, 0.1, "m", true});
  s.skin = table.number("skin", s.skin, {0.0, 1.0, "", true});
  s.reclip_slip = table.number("reclip_slip", s.reclip_slip, {0.0, 1.0, "", true});
  if (table.has("reclip_angle"))
    s.reclip_angle = to_radians(table.number("reclip_angle", 0.0, {0.0, 45.0, "degrees", true}));
  s.search = table.flag("search", s.search);
  table.finish();
}

void read_damping(TableReader& table, DampingSettings& s) {
  s.kind = DampingSettings::Kind(table.word("kind", damping_kinds(), std::size_t(s.kind)));
  s.ratio = table.number("ratio", s.ratio, {0.0, 0.5, ""});
  if (table.has("band")) {
    const auto band = table.numbers("band", 2, {0.0, 1e4, "Hz", true});
    if (!(band[0] < band[1]))
      table.fail("band", fmt::format("is [{}, {}]. The first frequency must be the lower one.", band[0], band[1]));
    s.band = {band[0], band[1]};
  }
  s.branches = int(table.integer("branches", s.branches, 1, 4));
  s.coefficient = table.number("coefficient", s.coefficient, {0.0, 1.0, ""});
  table.finish();
}

void read_output(TableReader& table, OutputSettings& s) {
  s.checkpoint_every = table.number("checkpoint_every", s.checkpoint_every, {0.0, 1e9, "s", true});
  s.checkpoint_wall = table.number("checkpoint_wall", s.checkpoint_wall, {0.0, 1e9, "s", true});
  s.fields_every = table.number("fields_every", s.fields_every, {0.0, 1e9, "s"});
  s.history_every = table.number("history_every", s.history_every, {0.0, 1e9, "s", true});
  s.gravity_modes = int(table.integer("gravity_modes", s.gravity_modes, 0, 20));
  table.finish();
}

/// "x", "y", "z" or a vector of any length. A vector that has unit length to rounding is not changed.
Vec3 read_direction(TableReader& table) {
  if (table.is_text("direction")) return Vec3::Unit(Eigen::Index(table.word("direction", {"x", "y", "z"}, 0)));
  if (!table.has("direction")) table.missing("direction", "\"x\", \"y\", \"z\" or a vector");
  const Vec3 v = table.vector("direction", Vec3::Zero());
  const double length = v.norm();
  if (!(length > 1e-9)) table.fail("direction", "is zero. It must be a vector other than zero.");
  return std::abs(length - 1.0) < 1e-12 ? v : Vec3(v / length);
}

void read_guides(TableReader& root, std::vector<Guide>& guides) {
  for (TableReader& table : root.tables("guide")) {
    Guide guide;
    guide.group = table.required_text("group");
    guide.turn = table.flag("turn", false);
    if (!table.has("free") && !guide.turn)
      table.missing("free", R"(the axes along which the group may move, such as ["z"], or 'turn' = true)");
    for (const std::string& axis : table.has("free") ? table.texts("free") : std::vector<std::string>{}) {
      const std::size_t c = axis.size() == 1 ? std::string("xyz").find(axis) : std::string::npos;
      if (c == std::string::npos)
        table.fail("free", fmt::format(R"(contains "{}". It must be "x", "y" or "z", or a list of them.)", axis));
      guide.free[c] = true;
    }
    for (const Guide& other : guides)
      if (other.group == guide.group)
        table.fail("group",
                   fmt::format("is \"{}\", which another [[guide]] has. Give all axes of a group in one [[guide]].",
                               guide.group));
    table.finish();
    guides.push_back(std::move(guide));
  }
}

}  // namespace

void read_settings(TableReader& root, Case& c) {
  c.settings.contact.reclip_angle = writable_angle(c.settings.contact.reclip_angle);
  if (auto table = root.table("analysis", "[analysis]")) read_analysis(*table, c.settings);
  if (auto table = root.table("contact", "[contact]")) read_contact(*table, c.settings.contact);
  if (auto table = root.table("damping", "[damping]")) read_damping(*table, c.settings.damping);
  read_guides(root, c.settings.guides);
  if (auto table = root.table("output", "[output]")) read_output(*table, c.settings.output);
  c.generator_input.gap_tolerance = c.settings.contact.gap_tolerance;
}

void read_sensors(TableReader& root, Case& c) {
  for (TableReader& table : root.tables("sensor")) {
    SensorSpec sensor;
    sensor.id = table.required_text("id");
    const bool usable = !sensor.id.empty() && sensor.id.find_first_of("/,;\n") == std::string::npos;
    if (!usable)
      table.fail("id", fmt::format("is \"{}\". It must not be empty and must not contain / , or ;", sensor.id));
    for (const SensorSpec& other : c.sensors)
      if (other.id == sensor.id)
        table.fail("id", fmt::format("is \"{}\", which another sensor has. Each sensor needs its own id.", sensor.id));
    if (!table.has("position")) table.missing("position", "[x, y, z] in m");
    sensor.position = table.place_in_m("position", Vec3::Zero());
    sensor.direction = read_direction(table);
    table.finish();
    c.sensors.push_back(std::move(sensor));
  }
}

}  // namespace voussoir
