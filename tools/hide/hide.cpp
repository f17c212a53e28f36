#include "tools/hide/hide.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "solver/base/error.h"
#include "tools/hide/bridge.h"
#include "tools/hide/instruments.h"
#include "tools/hide/modes.h"
#include "tools/hide/parapet_gaps.h"
#include "tools/hide/recordings.h"

namespace voussoir {

namespace {

/// Refuses effects that this kind of measurement cannot show.
void check_shows(const HideRequest& request) {
  const bool recorded = request.minutes > 0.0 || request.shaken > 0.0;
  if (recorded && request.sensors == "none")
    throw InputError(
        "--minutes and --shaken need sensors, but --sensors is none. Give sparse, rich, a number of channels or a "
        "file");
  if (recorded && request.noise_said != 1.0)
    throw InputError("--noise-said applies to standard deviations, which recordings do not have. Leave it out");
  if (recorded && request.trace)
    throw InputError("--trace needs measured modes, which --minutes and --shaken do not give. Leave it out");
  if (request.minutes > 0.0 && request.shaken > 0.0)
    throw InputError("--minutes and --shaken cannot be used together. Give only one of them");
  for (const EffectSetting& e : request.effects) {
    if (e.name == "support_motion" && request.shaken == 0.0)
      throw InputError("support_motion has an effect only if the ground motion is recorded. Give --shaken too");
    if (e.name == "sensor_fault" && e.values.at("delay") != 0.0 && !recorded)
      throw InputError("a late clock has an effect only in recordings. Give --minutes or --shaken too");
  }
}

/// A list of texts as TOML has it.
std::string quoted(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) all.push_back(fmt::format("{:?}", text));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

std::string answer(const HideRequest& request, const Response& truth, const std::vector<std::string>& gaps) {
  std::string text =
      fmt::format("# What voussoir hide put into the measurements in this folder.\nseed = {}\n", request.seed);
  text +=
      fmt::format("noise = {}\nnoise_said = {}\nscatter = {}\nmaterials = {}\ndefects = {}\nmesh = {}\n", request.noise,
                  request.noise_said, request.scatter, request.materials, request.defects, request.mesh);
  text += fmt::format("sensors = {:?}\n", request.sensors);
  std::vector<std::string> keys, loosenings;
  for (const auto& [key, word] : request.truth) keys.push_back(key + "=" + word);
  for (const Loosening& l : request.loosenings) loosenings.push_back(l.text);
  text += fmt::format("truth = {}\nparapet_gaps = {}\nloosened = {}\n", quoted(keys), quoted(gaps), quoted(loosenings));
  text += "periods = [";
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(truth.log_frequency.size(), request.modes); ++i)
    text += fmt::format("{}{:.6f}", i ? ", " : "", std::exp(-truth.log_frequency[i]));
  return text + "]\n" + effects_text(request.effects);
}

/// The positions of the channels on the drawing, as a site would note them, if the plan has the same channels on both
/// bridges.
std::vector<MeasuredSensor> as_drawn(const Case& c, const HideRequest& request,
                                     const std::vector<MeasuredSensor>& built) {
  const std::vector<MeasuredSensor> drawn = instruments(make_assembly(c), request);
  const auto same = [](const MeasuredSensor& a, const MeasuredSensor& b) { return a.id == b.id; };
  return std::equal(drawn.begin(), drawn.end(), built.begin(), built.end(), same) ? drawn : built;
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
  Assembly assembly = hidden_bridge(c, request);
  const std::vector<std::string> gaps = open_parapets(assembly, request);
  const Assembly bare = assembly;
  HiddenBridge hidden;
  Measured& measured = hidden.measured;
  // Sensors are placed before the effects are applied, so that none near the edge is placed on the ground at the ends.
  const std::vector<MeasuredSensor> built = instruments(bare, request);
  const std::vector<std::int64_t> blocks = place_sensors(built, request.sensors, bare);
  std::vector<Sensor> sensors;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    sensors.push_back({built[i].id, built[i].position, built[i].direction, blocks[i]});
  measured.sensors = as_drawn(c, request, built);
  for (const Loosening& l : request.loosenings) loosen(assembly, l);
  SolverSettings settings = c.settings;
  for (const EffectSetting& effect : request.effects) {
    if (!find_effect(effect.name).apply_to_sensors) apply_effect(assembly, effect);
    apply_effect(settings, effect);
  }
  const std::vector<Sensor> sound = sensors;
  for (const EffectSetting& effect : request.effects) apply_effect(sensors, effect);
  EigenMemory memory;
  const LinearModel model = linear_model(assembly);
  // An earthquake excites all modes of its band, and the sensors measure their sum.
  const int count = request.shaken > 0.0 ? 80 : 2 * request.modes + 6;
  const Response truth = response(assembly, model, sensors, count, memory, request.shaken > 0.0);
  const double ratio = settings.damping.ratio;
  if (request.minutes > 0.0)
    measured.records = {ambient(truth, sensors, request, ratio)};
  else if (request.shaken > 0.0)
    measured.records = {earthquake(assembly, model, truth, memory, sensors, request, ratio)};
  else
    measured.modes = measured_modes(truth, sensors, request, ratio);
  for (Recording& record : measured.records) finish(record, measured.sensors, request);
  measured.what =
      fmt::format("made by voussoir hide from {}", std::filesystem::path(request.case_file).filename().string());
  if (request.trace)
    hidden.answer =
        fmt::format("trace = {:.1f}\n", trace_of(bare, truth, sound, request, ratio, c.settings.damping.ratio));
  hidden.answer += answer(request, truth, gaps);
  return hidden;
}

}  // namespace voussoir
