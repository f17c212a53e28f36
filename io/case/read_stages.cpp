#include <algorithm>
#include <filesystem>

#include "io/case/degrees.h"
#include "io/case/sections.h"
#include "io/hdf5/atomic_file.h"
#include "io/records/sets.h"
#include "solver/base/error.h"
#include "solver/motion/baseline.h"

namespace voussoir {

const std::vector<std::string>& stage_kinds() {
  static const std::vector<std::string> names = {"gravity", "motion", "free", "collapse"};
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

constexpr double largest_peak = 1e4;  // m/s2; beyond, the unit or the scale is wrong
const std::vector<std::string> axes = {"x", "y", "z"};

PulseSettings read_pulse(TableReader& table) {
  PulseSettings pulse;
  pulse.kind = PulseSettings::Kind(table.required_word("kind", pulse_kinds()));
  pulse.axis = int(table.required_word("axis", axes));
  pulse.amplitude = table.required_number("amplitude", {-1e4, 1e4, "m/s2"});
  pulse.frequency = table.number("frequency", 0.0, {0.0, 1e3, "Hz", true});
  pulse.length = table.number("length", 0.0, {0.0, 1e5, "s", true});
  pulse.start = table.number("start", 0.0, {0.0, 1e5, "s"});
  table.finish();
  return pulse;
}

/// The spectrum that a synthetic motion shall have.
std::optional<TargetSpectrum> read_spectrum(TableReader& table) {
  if (!table.has("spectrum")) {
    for (const char* key : {"ag", "f0", "tc", "soil", "topography"})
      if (table.has(key)) table.fail(key, "belongs to a 'spectrum': name it, such as spectrum = \"ntc2018\"");
    return std::nullopt;
  }
  TargetSpectrum t;
  t.code = TargetCode(table.required_word("spectrum", target_codes()));
  t.ag = table.required_number("ag", {0.0, 5.0, "g", true});
  if (t.code == TargetCode::ntc2018) {
    t.f0 = table.required_number("f0", {2.0, 5.0, ""});
    t.tc = table.required_number("tc", {0.0, 2.0, "s", true});
  }
  t.soil = char('A' + table.required_word("soil", {"A", "B", "C", "D", "E"}));
  t.topography = int(table.integer("topography", 1, 1, 4));
  return t;
}

SyntheticSettings read_synthetic(TableReader& table, double stage_duration) {
  SyntheticSettings s;
  s.seed = std::uint64_t(table.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  s.spectrum = read_spectrum(table);
  if (!s.spectrum) s.peak = table.required_number("peak", {0.0, 1e3, "m/s2", true});
  if (s.spectrum && table.has("peak")) table.fail("peak", "and 'spectrum' are both given: keep one");
  s.duration = table.number("duration", stage_duration, {0.0, 1e4, "s", true});
  s.frequency = table.number("frequency", s.frequency, {0.0, 50.0, "Hz", true});
  s.bandwidth = table.number("bandwidth", s.bandwidth, {0.0, 2.0, "(damping ratio of the ground)", true});
  s.rise = table.number("rise", s.rise, {0.0, 1.0, "(share of the duration)", true});
  s.strong = table.number("strong", s.strong, {0.0, 1.0, "(share of the duration)", true});
  s.dt = table.number("dt", s.dt, {0.0, 0.1, "s", true});
  if (table.has("axes")) {
    s.axes = {};
    for (const std::string& name : table.texts("axes")) {
      const auto found = std::find(axes.begin(), axes.end(), name);
      if (found == axes.end()) table.fail("axes", fmt::format("holds \"{}\": expected x, y or z", name));
      s.axes[std::size_t(found - axes.begin())] = true;
    }
  }
  table.finish();
  return s;
}

/// Names and contents of the files; they are turned into numbers in motion_of().
void read_record(TableReader& stage, const Case& c, MotionSource& source) {
  const std::vector<std::string> names = stage.texts("record");
  if (names.size() > 3)
    stage.fail("record", fmt::format("names {} files: expected one, or up to three for x, y, z", names.size()));
  bool any = false;
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    if (names[axis].empty()) continue;
    any = true;
    source.files[axis] = relative_to(c.path, names[axis]);
    if (!std::filesystem::is_regular_file(source.files[axis]))
      stage.fail("record", fmt::format("is \"{}\": there is no such file", source.files[axis]));
    source.texts[axis] = read_text(source.files[axis]);
    const RecordFormat& format = recognise(source.texts[axis]);
    if (format.unit > 0.0 && stage.has("units"))
      stage.fail("units", fmt::format("is given, but {} is a file of {}, which says its units itself: leave it out",
                                      source.files[axis], format.name));
    if (format.unit == 0.0) source.units_asked = true;
  }
  if (!any) stage.fail("record", "names no file: give at least one");
  const std::vector<std::string>& known = acceleration_units();
  source.units = known[stage.word("units", known, 0)];
  source.dt = stage.number("dt", 0.0, {0.0, 10.0, "s", true});
  source.correct = stage.flag("correct", false);
  source.begin = stage.number("begin", 0.0, {0.0, 1e5, "s"});
}

GroundMotion motion_of_records(const TableReader& stage, const MotionSource& source) {
  std::array<RecordFile, 3> files;
  std::array<const RecordFile*, 3> along = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if (source.files[i].empty()) continue;
    files[i] = parse_record(source.texts[i], source.files[i], source.dt);
    along[i] = &files[i];
  }
  GroundMotion motion = join_components(along, acceleration_unit(source.units));
  const auto left_out = std::size_t(std::llround(source.begin / motion.dt));
  if (left_out + 2 > motion.acceleration.size())
    stage.fail("begin", fmt::format("is {} s, and the record ends at {} s", source.begin, motion.duration()));
  motion.acceleration.erase(motion.acceleration.begin(), motion.acceleration.begin() + std::ptrdiff_t(left_out));
  return source.correct ? correct_baseline(motion) : motion;
}

GroundMotion motion_of(const TableReader& stage, const MotionSource& source) {
  GroundMotion motion;
  try {
    if (source.kind == MotionSource::Kind::record) motion = motion_of_records(stage, source);
    if (source.kind == MotionSource::Kind::pulse) motion = make_pulse(source.pulse);
    if (source.kind == MotionSource::Kind::synthetic) motion = synthesize(source.synthetic);
  } catch (const InputError& error) {
    if (source.kind == MotionSource::Kind::record) throw;  // names its own file and row
    stage.fail(std::string("is not possible: ") + error.what());
  }
  if (source.scale != 1.0)
    for (Vec3& a : motion.acceleration) a *= source.scale;
  double peak = 0.0;
  for (const Vec3& a : motion.acceleration) peak = std::max(peak, a.cwiseAbs().maxCoeff());
  if (!(peak <= largest_peak))
    stage.fail(fmt::format("has a ground motion with a peak of {:.3g} m/s2, expected at most {:g}: look at its unit{}",
                           peak, largest_peak, source.scale == 1.0 ? "" : " and 'scale'"));
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

void read_motion(TableReader& table, const Case& c, StageSettings& stage, MotionSource& source) {
  const bool record = table.has("record"), pulse = table.has("pulse"), synthetic = table.has("synthetic");
  if (record + pulse + synthetic > 1) table.fail("has more than one of 'record', 'pulse' and 'synthetic': choose one");
  if (record + pulse + synthetic == 0) table.missing("record", "file names, or 'pulse' = {…}, or 'synthetic' = {…}");
  source.scale = table.number("scale", 1.0, {-1e6, 1e6, ""});
  if (record) {
    source.kind = MotionSource::Kind::record;
    read_record(table, c, source);
  } else {
    for (const char* key : {"units", "dt", "correct", "begin"})
      if (table.has(key)) table.fail(key, "belongs to a 'record': remove it");
    source.kind = pulse ? MotionSource::Kind::pulse : MotionSource::Kind::synthetic;
    if (auto sub = table.table("pulse", "the pulse of " + table.place())) source.pulse = read_pulse(*sub);
    if (auto sub = table.table("synthetic", "the synthetic motion of " + table.place()))
      source.synthetic = read_synthetic(*sub, stage.duration);
  }
  stage.motion = motion_of(table, source);
}

void read_drives(TableReader& table, StageSettings& stage) {
  for (TableReader& sub : table.tables("drive")) {
    Drive drive;
    drive.group = sub.required_text("group");
    if (sub.has("velocity") && sub.has("displacement"))
      sub.fail("velocity", "and 'displacement' are both given: keep one");
    const bool departs = sub.has("factor") || sub.has("delay");
    if (departs && stage.kind != StageSettings::Kind::motion)
      sub.fail(sub.has("factor") ? "factor" : "delay",
               "compares with the ground's motion, but this stage has none: set kind = \"motion\" or remove it");
    if (!sub.has("velocity") && !sub.has("displacement") && !departs)
      sub.missing("displacement",
                  "[x, y, z] in m, from rest to rest over the stage; or 'velocity', constant, in m/s; in a motion "
                  "stage also 'factor' or 'delay'");
    drive.velocity = sub.vector("velocity", Vec3::Zero());
    drive.displacement = sub.vector("displacement", Vec3::Zero());
    drive.factor = sub.number("factor", 1.0, {-10.0, 10.0, ""});
    drive.delay = sub.number("delay", 0.0, {-10.0, 10.0, "s"});
    if (!(drive.velocity.norm() <= 10.0)) sub.fail("velocity", "is above 10 m/s: look at its unit");
    if (!(drive.displacement.norm() <= 10.0 * stage.duration))
      sub.fail("displacement", "asks for more than 10 m/s on average: look at its unit");
    sub.finish();
    stage.drives.push_back(drive);
  }
}

void read_placements(TableReader& table, StageSettings& stage) {
  for (TableReader& sub : table.tables("place")) {
    Placement p;
    p.group = sub.required_text("group");
    p.move = sub.vector("move", p.move);
    p.angle = to_radians(sub.number("angle", 0.0, {-180.0, 180.0, "degrees"}));
    p.axis = sub.vector("axis", p.axis);
    p.through = sub.vector("through", p.through);
    if (p.axis.norm() < 1e-9) sub.fail("axis", "has no direction");
    if (p.angle != 0.0 && !sub.has("through")) sub.missing("through", "a point of the axis, [x, y, z] in m");
    sub.finish();
    stage.placements.push_back(p);
  }
}

void read_loads(TableReader& table, StageSettings& stage) {
  if (!table.has("load")) return;
  Loads loads;
  for (TableReader& sub : table.tables("load")) {
    if (sub.has("acceleration") == sub.has("group"))
      sub.fail("needs either 'acceleration' (m/s2, of all free blocks) or 'group' and 'force' (N)");
    if (sub.has("acceleration")) {
      loads.acceleration += sub.vector("acceleration", Vec3::Zero());
    } else {
      ForceLoad load;
      load.group = sub.required_text("group");
      if (!sub.has("force")) sub.missing("force", "[x, y, z] in N, on the whole group");
      load.force = sub.vector("force", Vec3::Zero());
      if (sub.has("at")) load.at = sub.vector("at", Vec3::Zero());
      loads.forces.push_back(load);
    }
    sub.finish();
  }
  if (!(loads.acceleration.norm() <= largest_peak)) table.fail("load", "is above 1e4 m/s2: look at its unit");
  stage.loads = loads;
}

void read_collapse(TableReader& table, StageSettings& stage) {
  CollapseSettings& s = stage.collapse;
  if (table.has("tilt")) {
    s.tilt = table.vector("tilt", Vec3::Zero());
    if (s.tilt->norm() < 1e-9) table.fail("tilt", "has no direction: give the axis about which gravity turns");
  }
  if (s.tilt && stage.loads) table.fail("tilt", "and 'load' are both given: keep one");
  if (!s.tilt && !stage.loads)
    table.missing("load", "the pattern that is multiplied, for instance [{ acceleration = [9.81, 0, 0] }]; or 'tilt'");
  s.to = table.number("to", s.to, {0.0, 1e12, "", true});
  s.tolerance = table.number("tolerance", 1e-3 * s.to, {1e-6 * s.to, 0.25 * s.to, ""});
  s.displacement = table.number("displacement", s.displacement, {1e-6, 10.0, "", true});
  s.confirm = table.number("confirm", s.confirm, {0.0, 1e4, "s"});
}

const char* plain_label(const StageSettings& stage) {
  switch (stage.kind) {
    case StageSettings::Kind::gravity:
      return "gravity";
    case StageSettings::Kind::collapse:
      return "collapse";
    default:
      return stage.drives.empty() ? "free vibration" : "driven blocks";
  }
}

/// Keys that only other kinds of stage have get a message of their own instead of "unknown".
void refuse_foreign_keys(TableReader& table, StageSettings::Kind kind) {
  const std::string& name = stage_kinds()[std::size_t(kind)];
  if (kind == StageSettings::Kind::gravity || kind == StageSettings::Kind::collapse) {
    const char* why = kind == StageSettings::Kind::gravity ? "ends in equilibrium" : "takes no simulated time";
    if (table.has("duration"))
      table.fail("duration", "has no meaning in a " + name + " stage, which " + why + ": remove it");
    if (table.has("place"))
      table.fail("place", "has no meaning in a " + name + " stage: place blocks in a free or motion stage");
    if (table.has("drive"))
      table.fail("drive",
                 "has no meaning in a " + name + " stage, which takes no time: drive in a free or motion stage");
  }
  if (kind != StageSettings::Kind::gravity && table.has("method"))
    table.fail("method", "belongs to a gravity stage: remove it");
  if (kind != StageSettings::Kind::collapse)
    for (const char* key : {"to", "tilt", "tolerance", "displacement", "confirm"})
      if (table.has(key)) table.fail(key, "belongs to a collapse stage: set kind = \"collapse\" or remove it");
  if (kind == StageSettings::Kind::motion) return;
  for (const char* key : {"record", "pulse", "synthetic", "scale", "units", "correct", "dt"})
    if (table.has(key)) table.fail(key, "belongs to a motion stage: set kind = \"motion\" or remove it");
}

}  // namespace

void read_stages(TableReader& root, Case& c, CaseUse use) {
  std::vector<TableReader> tables = root.tables("stage");
  if (tables.empty() && (use == CaseUse::run || root.has("stage")))
    root.missing("stage", "at least one [[stage]], usually kind = \"gravity\" first");
  for (TableReader& table : tables) {
    StageSettings stage;
    MotionSource source;
    stage.kind = StageSettings::Kind(table.required_word("kind", stage_kinds()));
    refuse_foreign_keys(table, stage.kind);
    if (stage.kind == StageSettings::Kind::gravity)
      stage.method = StageSettings::Method(table.word("method", gravity_methods(), 0));
    if (stage.timed()) stage.duration = table.required_number("duration", {0.0, 1e6, "s", true});
    if (stage.kind == StageSettings::Kind::motion) read_motion(table, c, stage, source);
    if (stage.timed()) read_drives(table, stage), read_placements(table, stage);
    read_loads(table, stage);
    if (stage.kind == StageSettings::Kind::collapse) {
      read_collapse(table, stage);
      if (&table != &tables.back()) table.fail("kind", "is \"collapse\": such a stage must be the last");
    }
    stage.label =
        table.text("label", stage.kind == StageSettings::Kind::motion ? label_of(source) : plain_label(stage));
    table.finish();
    c.settings.stages.push_back(std::move(stage));
    c.motions.push_back(std::move(source));
  }
}

}  // namespace voussoir
