#include "io/case/motion_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/case/sections.h"
#include "io/records/sets.h"
#include "io/records/table.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/motion/baseline.h"

namespace voussoir {

namespace {

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

/// The target spectrum of a synthetic motion; empty: none.
std::optional<TargetSpectrum> read_spectrum(TableReader& table) {
  if (!table.has("spectrum")) {
    for (const char* key : {"ag", "f0", "tc", "soil", "topography"})
      if (table.has(key)) table.fail(key, "needs a 'spectrum', such as spectrum = \"ntc2018\"");
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
  if (s.spectrum && table.has("peak")) table.fail("peak", "and 'spectrum' are both given. Keep one of them.");
  s.duration = table.number("duration", stage_duration, {0.0, 1e4, "s", true});
  s.frequency = table.number("frequency", s.frequency, {0.0, 50.0, "Hz", true});
  s.bandwidth = table.number("bandwidth", s.bandwidth, {0.0, 2.0, "(damping ratio of the ground filter)", true});
  s.rise = table.number("rise", s.rise, {0.0, 1.0, "(share of the duration)", true});
  s.strong = table.number("strong", s.strong, {0.0, 1.0, "(share of the duration)", true});
  s.dt = table.number("dt", s.dt, {0.0, 0.1, "s", true});
  if (table.has("axes")) {
    s.axes = {};
    for (const std::string& name : table.texts("axes")) {
      const auto found = std::find(axes.begin(), axes.end(), name);
      if (found == axes.end())
        table.fail("axes", fmt::format("contains \"{}\". It must be a list of x, y and z.", name));
      s.axes[std::size_t(found - axes.begin())] = true;
    }
  }
  table.finish();
  return s;
}

/// Reads the meaning of the columns of a table.
void read_columns_key(TableReader& stage, MotionSource& source) {
  if (!stage.has("columns")) return;
  source.columns = stage.texts("columns");
  for (const std::string& word : source.columns)
    if (std::ranges::find(column_words(), word) == column_words().end())
      stage.fail("columns",
                 fmt::format("contains \"{}\". Give t, x, y or z for each column, or \"\" to skip it.", word));
  for (const char* word : {"t", "x", "y", "z"})
    if (std::ranges::count(source.columns, word) > 1)
      stage.fail("columns", fmt::format("contains \"{}\" twice. Give each word once.", word));
  if (source.columns.empty() || std::ranges::count(source.files, "") < 2)
    stage.fail("columns", "is for a single file with a table. Name its columns, and give no other file.");
}

/// Reads names and contents of the files; ground_motion() converts them into numbers.
void read_record(TableReader& stage, const std::string& path, MotionSource& source) {
  const std::vector<std::string> names = stage.texts("record");
  if (names.size() > 3)
    stage.fail("record", fmt::format("has {} files. Give one file, or up to three for x, y and z.", names.size()));
  bool any = false;
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    if (names[axis].empty()) continue;
    any = true;
    source.files[axis] = relative_to(path, names[axis]);
    std::error_code ignored;  // an error counts as a file that does not exist
    if (!std::filesystem::is_regular_file(source.files[axis], ignored))
      stage.fail("record", fmt::format("is \"{}\", but there is no such file", shown(source.files[axis], 300)));
    source.texts[axis] = read_text(source.files[axis]);
    const RecordFormat& format = recognise(source.texts[axis]);
    if (format.unit > 0.0 && stage.has("units"))
      stage.fail("units",
                 fmt::format("is given, but {} has the format {}, which states its own units. Leave the key out.",
                             source.files[axis], format.name));
  }
  if (!any) stage.fail("record", "has no file name. Give at least one.");
  const std::vector<std::string>& known = acceleration_units();
  source.units = known[stage.word("units", known, 0)];
  source.dt = stage.number("dt", 0.0, {1e-5, 1.0, "s"});
  read_columns_key(stage, source);
  source.correct = stage.flag("correct", false);
  source.begin = stage.number("begin", 0.0, {0.0, 1e5, "s"});
}

GroundMotion motion_of_records(const MotionSource& source) {
  GroundMotion motion = record_motion(source.files, source.texts, {source.units, source.dt, source.columns});
  const auto left_out = std::size_t(std::llround(source.begin / motion.dt));
  if (left_out + 2 > motion.acceleration.size())
    throw InputError("{}: the record ends at {} s, but 'begin' is {} s. Set a smaller 'begin'.",
                     *std::ranges::find_if(source.files, [](const auto& f) { return !f.empty(); }), motion.duration(),
                     source.begin);
  motion.acceleration.erase(motion.acceleration.begin(), motion.acceleration.begin() + std::ptrdiff_t(left_out));
  return source.correct ? correct_baseline(motion) : motion;
}

/// Throws InputError for a motion that does not move.
void scale_to(GroundMotion& motion, double pga) {
  double peak = 0.0;
  for (const Vec3& a : motion.acceleration) peak = std::max(peak, a.cwiseAbs().maxCoeff());
  if (!(peak > 0.0)) throw InputError("'scale_to_pga' is {} m/s2, but the ground motion is zero. Check its file.", pga);
  for (Vec3& a : motion.acceleration) a *= pga / peak;
}

}  // namespace

MotionSource read_motion_source(TableReader& table, const std::string& path, double stage_duration) {
  MotionSource source;
  const bool record = table.has("record"), pulse = table.has("pulse"), synthetic = table.has("synthetic");
  if (record + pulse + synthetic > 1)
    table.fail("has more than one of 'record', 'pulse' and 'synthetic'. Keep one of them.");
  if (record + pulse + synthetic == 0) table.missing("record", "file names, or 'pulse' = {…}, or 'synthetic' = {…}");
  source.scale = table.number("scale", 1.0, {-1e6, 1e6, ""});
  source.pga = table.number("scale_to_pga", 0.0, {0.0, largest_peak, "m/s2", true});
  if (record) {
    source.kind = MotionSource::Kind::record;
    read_record(table, path, source);
  } else {
    for (const char* key : {"units", "dt", "correct", "begin", "columns"})
      if (table.has(key)) table.fail(key, "is only for a 'record'. Remove it.");
    source.kind = pulse ? MotionSource::Kind::pulse : MotionSource::Kind::synthetic;
    if (auto sub = table.table("pulse", "the pulse of " + table.place())) source.pulse = read_pulse(*sub);
    if (auto sub = table.table("synthetic", "the synthetic motion of " + table.place()))
      source.synthetic = read_synthetic(*sub, stage_duration);
  }
  return source;
}

GroundMotion ground_motion(const MotionSource& source) {
  GroundMotion motion;
  if (source.kind == MotionSource::Kind::record) motion = motion_of_records(source);
  if (source.kind == MotionSource::Kind::pulse) motion = make_pulse(source.pulse);
  if (source.kind == MotionSource::Kind::synthetic) motion = synthesize(source.synthetic);
  if (source.pga > 0.0) scale_to(motion, source.pga);
  if (source.scale != 1.0)
    for (Vec3& a : motion.acceleration) a *= source.scale;
  return motion;
}

}  // namespace voussoir
