#include "tools/hide/hide.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "geometry/nearest_block.h"
#include "solver/base/error.h"
#include "solver/effects/parts.h"
#include "tools/hide/bridge.h"
#include "tools/hide/instruments.h"
#include "tools/hide/modes.h"
#include "tools/hide/recordings.h"

namespace voussoir {

namespace {

/// What a measurement of this sort cannot hold would be hidden for nothing.
void check_shows(const HideRequest& request) {
  const bool recorded = request.minutes > 0.0 || request.shaken > 0.0;
  if (recorded && request.sensors == "none")
    throw InputError("--minutes and --shaken need sensors; give --sensors sparse or rich");
  if (recorded && request.trace)
    throw InputError("--trace is of modes, which --minutes and --shaken do not give; leave it out");
  if (request.minutes > 0.0 && request.shaken > 0.0) throw InputError("give --minutes or --shaken, not both");
  for (const EffectSetting& e : request.effects) {
    if (e.name == "support_motion" && request.shaken == 0.0)
      throw InputError("support_motion shows only where the ground's motion is recorded: give --shaken too");
    if (e.name == "sensor_fault" && e.values.at("delay") != 0.0 && !recorded)
      throw InputError("a late clock shows only in recordings: give --minutes or --shaken too");
  }
}

std::string answer(const HideRequest& request, const Response& truth) {
  std::string text =
      fmt::format("# What voussoir hide put into the measurements beside this file.\nseed = {}\n", request.seed);
  text +=
      fmt::format("noise = {}\nscatter = {}\nmaterials = {}\ndefects = {}\nmesh = {}\nsensors = \"{}\"\n",
                  request.noise, request.scatter, request.materials, request.defects, request.mesh, request.sensors);
  text += "periods = [";
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(truth.log_frequency.size(), request.modes); ++i)
    text += fmt::format("{}{:.6f}", i ? ", " : "", std::exp(-truth.log_frequency[i]));
  return text + "]\n" + effects_text(request.effects);
}

/// Names of the channels, and clocks that are late.
void finish(Recording& record, const std::vector<MeasuredSensor>& sensors, const HideRequest& request) {
  record.channels.clear();
  for (const MeasuredSensor& s : sensors) record.channels.push_back(s.id);
  if (request.shaken > 0.0) record.channels.insert(record.channels.end(), {"base_x", "base_y", "base_z"});
  set_clocks(request, sensors, record);
}

}  // namespace

HiddenBridge hide(const HideRequest& request) {
  check_shows(request);
  const Case c = read_case(request.case_file, CaseUse::geometry);
  Noise noise(request.seed);
  Assembly assembly = hidden_bridge(c, request, noise);
  const Assembly bare = assembly;
  HiddenBridge hidden;
  Measured& measured = hidden.measured;
  // Before there is ground at the ends, which a sensor near the edge would be put on.
  measured.sensors = instruments(bare, request.sensors);
  std::vector<Sensor> sensors;
  for (const MeasuredSensor& s : measured.sensors)
    sensors.push_back({s.id, s.position, s.direction, nearest_block(bare, s.position).block});
  SolverSettings settings = c.settings;
  for (const EffectSetting& effect : request.effects) {
    if (!find_effect(effect.name).apply_to_sensors) apply_effect(assembly, effect);
    apply_effect(settings, effect);
  }
  const std::vector<Sensor> sound = sensors;
  for (const EffectSetting& effect : request.effects) apply_effect(sensors, effect);
  EigenMemory memory;
  const LinearModel model = linear_model(assembly);
  // An earthquake drives all modes of its band, of which the sensors see the sum.
  const int count = request.shaken > 0.0 ? 80 : 2 * request.modes + 6;
  const Response truth = response(assembly, model, sensors, count, memory, request.shaken > 0.0);
  const double ratio = settings.damping.ratio;
  if (request.minutes > 0.0)
    measured.records = {ambient(truth, request, ratio, noise)};
  else if (request.shaken > 0.0)
    measured.records = {earthquake(assembly, model, truth, memory, sensors, request, ratio, noise)};
  else
    measured.modes = measured_modes(truth, request, ratio, noise);
  for (Recording& record : measured.records) finish(record, measured.sensors, request);
  measured.what =
      fmt::format("made by voussoir hide from {}", std::filesystem::path(request.case_file).filename().string());
  if (request.trace)
    hidden.answer =
        fmt::format("trace = {:.1f}\n", trace_of(bare, truth, sound, request, ratio, c.settings.damping.ratio));
  hidden.answer += answer(request, truth);
  return hidden;
}

}  // namespace voussoir
