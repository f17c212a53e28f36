#include <algorithm>
#include <filesystem>

#include "io/case/degrees.h"
#include "io/case/motion_source.h"
#include "io/case/sections.h"
#include "io/traffic/place_vehicle.h"
#include "solver/base/error.h"

namespace voussoir {

const std::vector<std::string>& stage_kinds() {
  static const std::vector<std::string> names = {"gravity", "motion", "free", "collapse", "quasi-static"};
  return names;
}

const std::vector<std::string>& gravity_methods() {
  static const std::vector<std::string> names = {"automatic", "newton", "relaxation"};
  return names;
}

std::string motion_file_name(std::size_t stage, int axis) {
  return fmt::format("motion_{}_{}.txt", stage + 1, axis_names[axis]);
}

namespace {

void check_peak(const TableReader& stage, const MotionSource& source, double peak) {
  if (!(peak <= largest_peak))
    stage.fail(
        fmt::format("has a ground motion with a peak of {:.3g} m/s2; at most {:g} m/s2 are allowed. Check its unit{}.",
                    peak, largest_peak, source.scale == 1.0 ? "" : " and 'scale'"));
}

/// The scaled motion of a stage. Errors name the stage.
GroundMotion motion_of(const TableReader& stage, const MotionSource& source) {
  GroundMotion motion;
  try {
    motion = ground_motion(source);
  } catch (const InputError& error) {
    if (source.kind == MotionSource::Kind::record) throw;  // names its own file and row
    stage.fail(std::string("is not possible: ") + error.what());
  }
  double peak = 0.0;
  for (const Vec3& a : motion.acceleration) peak = std::max(peak, a.cwiseAbs().maxCoeff());
  check_peak(stage, source, peak);
  return motion;
}

std::string label_of(const MotionSource& source) {
  if (source.kind == MotionSource::Kind::pulse)
    return fmt::format("motion (pulse {} {})", pulse_kinds()[std::size_t(source.pulse.kind)],
                       axis_names[source.pulse.axis]);
  if (source.kind == MotionSource::Kind::synthetic)
    return fmt::format("motion (synthetic, seed {})", source.synthetic.seed);
  std::vector<std::string> names;
  for (const std::string& file : source.files)
    if (!file.empty()) names.push_back(std::filesystem::path(file).filename().string());
  return fmt::format("motion ({})", fmt::join(names, ", "));
}

/// A synthetic motion is only checked if the case is not run, because computing it may take seconds.
void read_motion(TableReader& table, const Case& c, CaseUse use, StageSettings& stage, MotionSource& source) {
  source = read_motion_source(table, c.path, stage.duration);
  if (use == CaseUse::run || source.kind != MotionSource::Kind::synthetic) {
    stage.motion = motion_of(table, source);
    return;
  }
  try {
    check_synthetic(source.synthetic);
  } catch (const InputError& error) {
    table.fail(std::string("is not possible: ") + error.what());
  }
  check_peak(table, source, (source.pga > 0.0 ? source.pga : source.synthetic.peak) * std::abs(source.scale));
}

void read_drives(TableReader& table, StageSettings& stage) {
  for (TableReader& sub : table.tables("drive")) {
    Drive drive;
    drive.group = sub.required_text("group");
    if (sub.has("velocity") && stage.kind == StageSettings::Kind::quasi_static)
      sub.fail("velocity",
               "is not for a quasi-static stage. Give 'displacement' = [x, y, z], its value in m at the share 1.");
    if (sub.has("velocity") && sub.has("displacement"))
      sub.fail("velocity", "and 'displacement' are both given. Keep one of them.");
    const bool departs = sub.has("factor") || sub.has("delay");
    if (departs && stage.kind != StageSettings::Kind::motion)
      sub.fail(sub.has("factor") ? "factor" : "delay",
               "refers to the ground motion, but this stage has none. Set kind = \"motion\" or remove it.");
    if (!sub.has("velocity") && !sub.has("displacement") && !departs)
      sub.missing("displacement",
                  "[x, y, z] in m, from rest to rest over the stage; or 'velocity', constant, in m/s; or in a motion "
                  "stage 'factor' or 'delay'");
    drive.velocity = sub.vector("velocity", Vec3::Zero());
    drive.displacement = sub.vector("displacement", Vec3::Zero());
    drive.factor = sub.number("factor", 1.0, {-10.0, 10.0, ""});
    drive.delay = sub.number("delay", 0.0, {-10.0, 10.0, "s"});
    if (!(drive.velocity.norm() <= 10.0)) sub.fail("velocity", "is above 10 m/s. Check its unit.");
    if (stage.timed() && !(drive.displacement.norm() <= 10.0 * stage.duration))
      sub.fail("displacement", "needs a mean velocity above 10 m/s. Check its unit.");
    if (!stage.timed() && !(drive.displacement.norm() > 0.0 && drive.displacement.norm() <= 10.0))
      sub.fail("displacement", "must have a length above 0 and at most 10 m");
    sub.finish();
    stage.drives.push_back(drive);
  }
}

void read_placements(TableReader& table, StageSettings& stage) {
  for (TableReader& sub : table.tables("place")) {
    Placement p;
    p.group = sub.required_text("group");
    p.move = sub.place_in_m("move", p.move);
    p.angle = to_radians(sub.number("angle", 0.0, {-180.0, 180.0, "degrees"}));
    p.axis = sub.vector("axis", p.axis);
    p.through = sub.place_in_m("through", p.through);
    if (p.axis.norm() < 1e-9) sub.fail("axis", "is zero and has no direction. Give a vector other than zero.");
    if (p.angle != 0.0 && !sub.has("through")) sub.missing("through", "a point on the axis, [x, y, z] in m");
    sub.finish();
    stage.placements.push_back(p);
  }
}

ForceLoad read_force(TableReader& sub) {
  ForceLoad load;
  load.group = sub.required_text("group");
  if (!sub.has("force")) sub.missing("force", "[x, y, z] in N, the total force on the group");
  load.force = sub.vector("force", Vec3::Zero());
  if (sub.has("at")) load.at = sub.place_in_m("at", Vec3::Zero());
  return load;
}

RoadLoad read_road_load(TableReader& sub) {
  RoadLoad load;
  const std::vector<double> r = sub.numbers("road", 4, {-1e7, 1e7, "m"});
  load.area = {r[0], r[1], r[2], r[3]};
  if (!(r[0] < r[1] && r[2] < r[3]))
    sub.fail("road", "must be [x from, x to, y from, y to] in m, each with the smaller value first");
  load.pressure = sub.required_number("pressure", {0.0, 1e9, "N/m2"});
  load.of = sub.text("of", "a load");
  return load;
}

/// Adds a load without speed to `loads`, and one with a speed to the moving loads of the stage.
void add_road_load(TableReader& sub, StageSettings& stage, Loads& loads, const RoadLoad& load, double speed) {
  if (speed == 0.0) {
    loads.road.push_back(load);
    return;
  }
  if (!stage.timed() && stage.kind != StageSettings::Kind::quasi_static)
    sub.fail("speed", "is only for stages of kind \"free\", \"motion\" or \"quasi-static\". Leave it out here.");
  stage.moving.push_back({load, speed});
}

const Limits speeds = {-100.0, 100.0, "m/s"};

/// Vehicles of the library or of a file in the folder of the case, with the place of their front.
void read_vehicles(TableReader& table, const std::string& beside, StageSettings& stage, Loads& loads) {
  if (!table.has("vehicle")) return;
  for (TableReader& sub : table.tables("vehicle")) {
    const std::string name = sub.required_text("name");
    Vehicle vehicle;
    try {
      vehicle = read_vehicle(name.ends_with(".toml") ? relative_to(beside, name) : name);
      if (sub.has("variant")) vehicle = variant_named(vehicle, sub.text("variant", ""));
    } catch (const InputError& error) {
      sub.fail("name", fmt::format("is not a vehicle: {}", error.what()));
    }
    VehiclePlace place;
    place.x = sub.required_number("x", {-1e6, 1e6, "m"});
    place.y = sub.number("y", 0.0, {-1e3, 1e3, "m"});
    place.towards_right = sub.word("towards", {"right", "left"}, 0) == 0;
    vehicle = amplified(vehicle, sub.number("factor", 1.0, {0.0, 1e6, ""}));
    const double speed = sub.number("speed", 0.0, {0.0, 100.0, "m/s"});
    for (const RoadLoad& load : loads_of(vehicle, place))
      add_road_load(sub, stage, loads, load, place.towards_right ? speed : -speed);
    sub.finish();
  }
}

void read_load_tables(TableReader& table, StageSettings& stage, Loads& loads) {
  if (!table.has("load")) return;
  for (TableReader& sub : table.tables("load")) {
    if (int(sub.has("acceleration")) + int(sub.has("group")) + int(sub.has("road")) != 1)
      sub.fail(
          "needs one of 'acceleration' (m/s2, of all free blocks), 'group' with 'force' (N), and 'road' with "
          "'pressure' (N/m2)");
    if (sub.has("acceleration"))
      loads.acceleration += sub.vector("acceleration", Vec3::Zero());
    else if (sub.has("group"))
      loads.forces.push_back(read_force(sub));
    else
      add_road_load(sub, stage, loads, read_road_load(sub), sub.number("speed", 0.0, speeds));
    sub.finish();
  }
}

void read_loads(TableReader& table, const std::string& beside, StageSettings& stage) {
  if (!table.has("load") && !table.has("vehicle")) return;
  Loads loads;
  read_load_tables(table, stage, loads);
  read_vehicles(table, beside, stage, loads);
  if (!(loads.acceleration.norm() <= largest_peak)) table.fail("load", "is above 1e4 m/s2. Check its unit.");
  const bool still = !loads.acceleration.isZero(0.0) || !loads.forces.empty() || !loads.road.empty();
  if (still && !stage.moving.empty())
    table.fail(
        "load",
        "has loads with a speed and loads without. Give the loads without a speed in an earlier stage; they stay.");
  if (stage.moving.empty()) stage.loads = loads;
}

void read_collapse(TableReader& table, StageSettings& stage) {
  CollapseSettings& s = stage.collapse;
  if (table.has("tilt")) {
    s.tilt = table.vector("tilt", Vec3::Zero());
    if (s.tilt->norm() < 1e-9)
      table.fail("tilt", "is zero and has no direction. Give the axis about which gravity turns.");
  }
  if (s.tilt && stage.loads) table.fail("tilt", "and 'load' are both given. Keep one of them.");
  if (!s.tilt && !stage.loads)
    table.missing("load", "the load pattern that is multiplied, such as [{ acceleration = [9.81, 0, 0] }]; or 'tilt'");
  s.to = table.number("to", s.to, {0.0, 1e12, "", true});
  s.tolerance = table.number("tolerance", 1e-3 * s.to, {1e-6 * s.to, 0.25 * s.to, ""});
  s.displacement = table.number("displacement", s.displacement, {1e-6, 10.0, "", true});
  s.confirm = table.number("confirm", s.confirm, {0.0, 1e4, "s"});
}

bool has_force(const Loads& loads) {
  return !loads.acceleration.isZero(0.0) ||
         std::ranges::any_of(loads.forces, [](const ForceLoad& l) { return !l.force.isZero(0.0); }) ||
         std::ranges::any_of(loads.road, [](const RoadLoad& l) { return l.pressure > 0.0; });
}

/// Call it after loads and drives have been read.
void read_quasi_static(TableReader& table, bool last, StageSettings& stage) {
  QuasiStaticSettings& s = stage.quasi_static;
  s.steps = int(table.integer("steps", s.steps, 1, 100000));
  s.halvings = int(table.integer("halvings", s.halvings, 0, 20));
  if (table.has("path")) s.path = table.number_list("path", {-100.0, 100.0, ""});
  double from = 0.0;
  for (const double corner : s.path) {
    if (corner == from)
      table.fail("path", fmt::format("goes from {0:g} to {0:g}. Successive corners must differ, and the first one must "
                                     "differ from 0, where the path begins.",
                                     corner));
    from = corner;
  }
  if (!stage.moving.empty() && (s.path.size() != 1 || s.path[0] != 1.0))
    table.fail("path", "is not for loads with a speed, which cross the bridge once. Remove it.");
  if (!stage.loads && stage.moving.empty() && stage.drives.empty())
    table.missing("load", "or 'vehicle' or 'drive': the values that change from increment to increment");
  if (!table.has("push")) return;
  s.push = table.required_number("push", {-10.0, 10.0, "m"});
  if (!stage.loads || !has_force(*stage.loads))
    table.fail("push",
               "needs a load without speed that is not zero, but this stage has none. Give one, or remove the key.");
  if (!stage.drives.empty()) table.fail("push", "and 'drive' are both given. Keep one of them.");
  if (*s.push == 0.0)
    table.fail("push", "is 0. Give the displacement (m) by which the loaded points are pushed along the loads.");
  if (!last) table.fail("push", "is allowed in the last stage only, because the program finds the size of the loads");
}

ConstructionStep read_step(TableReader& table) {
  ConstructionStep step;
  if (table.has("add")) step.add = table.texts("add");
  if (table.has("strike")) step.strike = table.texts("strike");
  if (step.add.empty() == step.strike.empty())
    table.missing(
        step.add.empty() ? "add" : "strike",
        "components or groups that this construction step adds; or 'strike', those whose centering it removes; "
        "not both");
  step.label = table.text("label", "");
  step.below = table.number("below", step.below, {-1e5, 1e5, "m"});
  step.lift = table.number("lift", 0.0, {0.0, 1e4, "m"});
  step.centering = table.flag("centering", false);
  if (!step.strike.empty())
    for (const char* key : {"below", "lift", "centering"})
      if (table.has(key))
        table.fail(key, "is only for a construction step with 'add', but this one has 'strike'. Remove it.");
  table.finish();
  return step;
}

/// construction = "staged", or a list of steps.
void read_construction(TableReader& table, bool first, StageSettings& stage) {
  const bool lift = table.has("lift");
  if (!table.has("construction")) {
    if (lift)
      table.fail("lift",
                 "is the height of the lifts of a staged construction. Set construction = \"staged\" or remove it.");
    return;
  }
  ConstructionSettings construction;
  if (table.is_text("construction")) {
    if (table.word("construction", {"at once", "staged"}, 0) == 0) {
      if (lift)
        table.fail("lift", "is not for construction = \"at once\". Remove it, or set construction = \"staged\".");
      return;
    }
    construction.lift = table.number("lift", construction.lift, {0.0, 1e4, "m", true});
  } else {
    if (lift)
      table.fail("lift", "is only for construction = \"staged\". In a list give 'lift' in each construction step.");
    for (TableReader& sub : table.tables("construction")) construction.steps.push_back(read_step(sub));
    if (construction.steps.empty())
      table.fail("construction", "has no construction steps. Give at least one, or \"staged\".");
  }
  if (!first) table.fail("construction", "is only for the first stage. After it the structure is already built.");
  stage.construction = construction;
}

const char* plain_label(const StageSettings& stage) {
  switch (stage.kind) {
    case StageSettings::Kind::gravity:
      return "gravity";
    case StageSettings::Kind::collapse:
      return "collapse";
    case StageSettings::Kind::quasi_static:
      return stage.drives.empty() ? "load steps" : "settlement steps";
    default:
      return stage.drives.empty() ? "free vibration" : "driven blocks";
  }
}

/// Reports keys of other kinds of stages with their own message instead of as unknown.
void refuse_foreign_keys(TableReader& table, StageSettings::Kind kind) {
  const std::string& name = stage_kinds()[std::size_t(kind)];
  if (kind == StageSettings::Kind::gravity || kind == StageSettings::Kind::collapse) {
    const char* why = kind == StageSettings::Kind::gravity ? "ends in equilibrium" : "takes no simulated time";
    if (table.has("duration")) table.fail("duration", "is not for a " + name + " stage, which " + why + ". Remove it.");
    if (table.has("place"))
      table.fail("place", "is not for a " + name + " stage. Place blocks in a free or motion stage.");
    if (table.has("drive"))
      table.fail("drive",
                 "is not for a " + name + " stage, which takes no time. Drive blocks in a free or motion stage.");
  }
  const bool steps = kind == StageSettings::Kind::quasi_static;
  if (steps && table.has("place"))
    table.fail("place", "is not for a quasi-static stage. Place blocks in a free or motion stage.");
  if (kind != StageSettings::Kind::gravity && !steps && table.has("method"))
    table.fail("method", "is only for a gravity or quasi-static stage. Remove it.");
  if (kind != StageSettings::Kind::gravity)
    for (const char* key : {"allow_motion", "construction", "lift"})
      if (table.has(key)) table.fail(key, "is only for a gravity stage. Remove it.");
  if (!steps)
    for (const char* key : {"steps", "path", "push", "halvings"})
      if (table.has(key))
        table.fail(key, "is only for a quasi-static stage. Set kind = \"quasi-static\" or remove it.");
  if (kind != StageSettings::Kind::collapse)
    for (const char* key : {"to", "tilt", "tolerance", "displacement", "confirm"})
      if (table.has(key)) table.fail(key, "is only for a collapse stage. Set kind = \"collapse\" or remove it.");
  if (kind == StageSettings::Kind::motion) return;
  for (const char* key :
       {"record", "pulse", "synthetic", "scale", "scale_to_pga", "units", "columns", "correct", "dt", "begin"})
    if (table.has(key)) table.fail(key, "is only for a motion stage. Set kind = \"motion\" or remove it.");
}

}  // namespace

void read_stages(TableReader& root, Case& c, CaseUse use) {
  std::vector<TableReader> tables = root.tables("stage");
  if (tables.empty() && (use == CaseUse::run || root.has("stage")))
    root.missing("stage", "at least one [[stage]], usually with kind = \"gravity\" first");
  for (TableReader& table : tables) {
    StageSettings stage;
    MotionSource source;
    stage.kind = StageSettings::Kind(table.required_word("kind", stage_kinds()));
    refuse_foreign_keys(table, stage.kind);
    if (stage.kind == StageSettings::Kind::gravity)
      stage.method = StageSettings::Method(table.word("method", gravity_methods(), 0)),
      stage.allow_motion = table.flag("allow_motion", false),
      read_construction(table, &table == &tables.front(), stage);
    const bool steps = stage.kind == StageSettings::Kind::quasi_static;
    if (steps) stage.method = StageSettings::Method(table.word("method", gravity_methods(), 0));
    if (steps) stage.duration = table.number("duration", 1.0, {0.0, 1e6, "s", true});
    if (stage.timed()) stage.duration = table.required_number("duration", {0.0, 1e6, "s", true});
    if (stage.kind == StageSettings::Kind::motion) read_motion(table, c, use, stage, source);
    if (stage.timed() || steps) read_drives(table, stage);
    if (stage.timed()) read_placements(table, stage);
    read_loads(table, c.path, stage);
    if (steps) read_quasi_static(table, &table == &tables.back(), stage);
    if (stage.kind == StageSettings::Kind::collapse) {
      read_collapse(table, stage);
      if (&table != &tables.back()) table.fail("kind", "is \"collapse\". A collapse stage must be the last stage.");
    }
    stage.label =
        table.text("label", stage.kind == StageSettings::Kind::motion ? label_of(source) : plain_label(stage));
    table.finish();
    c.settings.stages.push_back(std::move(stage));
    c.motions.push_back(std::move(source));
  }
}

}  // namespace voussoir
