// voussoir hide: measurements of a bridge that has what its case lacks.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "geometry/nearest_block.h"
#include "io/case/case.h"
#include "io/measured/measured.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/diagnosis/fit.h"
#include "solver/effects/parts.h"
#include "tools/diagnosis/diagnosis_input.h"
#include "tools/diagnosis/hidden_recordings.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// "abutment_restraint both stiffness_share=0.5": what stands between the name and the parameters is the place.
EffectSetting parse_effect(const std::string& text) {
  std::istringstream words(text);
  EffectSetting effect;
  std::string word;
  words >> effect.name;
  while (words >> word) {
    const std::size_t at = word.find('=');
    if (at == std::string::npos) {
      effect.where += (effect.where.empty() ? "" : " ") + word;
      continue;
    }
    try {
      effect.values[word.substr(0, at)] = std::stod(word.substr(at + 1));
    } catch (const std::exception&) {
      throw InputError("--effect \"{}\": {} is no parameter=number", text, word);
    }
  }
  complete(effect);
  return effect;
}

/// Dimensions that a survey can have wrong; not those that only say how it is cut into blocks.
bool is_dimension(const Parameter& p) {
  static const std::vector<std::string> cuts = {"voussoir_", "block_", "fill_length", "fill_width", "fill_height",
                                                "infill_",   "leaf_",  "sliver_",     "base_",      "restraint_"};
  return p.unit == "m" && std::none_of(cuts.begin(), cuts.end(), [&](auto& c) { return p.name.starts_with(c); });
}

/// The case with other dimensions and other blocks. Dimensions that cannot be together are drawn again.
Assembly surveyed_wrongly(const Case& model, const HideRequest& request, Noise& noise) {
  for (int tries = 0;; ++tries) {
    Case c = model;
    // Two dimensions that are the same number are one on the bridge: backing that reaches the end still does, instead
    // of ending a centimetre short of it behind a slot of fill.
    std::map<double, double> errors;
    for (const Parameter& p : find_generator(c.generator).parameters) {
      double& value = c.generator_input.values.at(p.name);
      if (p.name == "block_scale") value = std::clamp(value * request.mesh, p.low, p.high);
      if (!is_dimension(p) || value <= 0.0) continue;
      const auto [error, first] = errors.try_emplace(value, 0.0);
      if (first) error->second = request.defects * noise.normal();
      value = std::clamp(value + error->second, p.low, p.high);
    }
    try {
      return make_assembly(c);
    } catch (const InputError&) {
      if (tries == 100) throw;
    }
  }
}

/// The bridge as it is: other blocks, other dimensions, other stiffness in each part, and the effects.
Assembly true_bridge(const Case& model, const HideRequest& request, Noise& noise) {
  if (model.generator.empty()) throw InputError("{} is made from an assembly file; hide needs a generator", model.path);
  Assembly assembly = surveyed_wrongly(model, request, noise);
  const Effect calibration = find_effect("calibration");
  for (const std::string& where : calibration.places(assembly))
    apply_effect(assembly, {"calibration",
                            where,
                            {{"stiffness", std::exp(request.materials * noise.normal())},
                             {"density", std::exp(0.02 * noise.normal())}}});
  for (const std::string& part : masonry_parts(assembly))
    if (part != "all" && !part.ends_with("s"))
      scale_inside(assembly, masonry_part(assembly, part), std::exp(request.scatter * noise.normal()));
  return assembly;
}

/// Where a box of the assembly's blocks reaches.
Box extent(const Assembly& assembly) {
  Box all;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    const Box box = block_box(block);
    all.low = all.low.cwiseMin(box.low), all.high = all.high.cwiseMax(box.high);
  }
  return all;
}

class Instruments {
 public:
  explicit Instruments(const Assembly& assembly) : assembly_(&assembly) {}
  /// At the block nearest to a point, on it.
  void add(Vec3 at, const std::string& axes) {
    const Box box = block_box(assembly_->blocks[std::size_t(nearest_block(*assembly_, at).block)]);
    at = at.cwiseMax(box.low).cwiseMin(box.high);
    for (double& x : at) x = std::round(100.0 * x) / 100.0;
    for (char axis : axes) {
      MeasuredSensor s;
      s.id = fmt::format("A{:02}{}", count_, axis);
      s.position = at;
      s.direction[axis - 'x'] = 1.0;
      sensors.push_back(s);
    }
    ++count_;
  }
  std::vector<MeasuredSensor> sensors;

 private:
  const Assembly* assembly_;
  int count_ = 1;
};

Vec3 middle_of(const Assembly& assembly, const std::string& group) {
  const Box box = block_box(assembly.blocks[std::size_t(assembly.groups.at(group)[0])]);
  return 0.5 * (box.low + box.high);
}

/// sparse: along one edge of the deck, across and upwards over the keystones, lengthways over the piers; rich: both
/// edges, more axes, the ends and the piers at half their height; none.
std::vector<MeasuredSensor> instruments(const Assembly& assembly, const std::string& which) {
  if (which != "sparse" && which != "rich" && which != "none")
    throw InputError("--sensors is {}; give sparse, rich or none", which);
  Instruments all(assembly);
  if (which == "none") return {};
  const Box box = extent(assembly);
  const bool rich = which == "rich";
  const double top = box.high.z();
  for (const auto& [name, blocks] : assembly.groups) {
    if (name.starts_with("keystone ")) {
      const double x = middle_of(assembly, name).x();
      all.add({x, box.low.y(), top}, rich ? "xyz" : "yz");
      if (rich) all.add({x, box.high.y(), top}, "yz");
    }
    if (name.starts_with("base pier ")) {
      const Vec3 base = middle_of(assembly, name);
      all.add({base.x(), box.low.y(), top}, rich ? "xy" : "x");
      if (rich) all.add({base.x(), box.low.y(), 0.5 * (base.z() + top)}, "xy");
    }
  }
  if (rich)
    for (double x : {box.low.x(), box.high.x()}) all.add({x, box.low.y(), top}, "xyz");
  return all.sensors;
}

/// The lowest modes that are not local, as they would be measured.
std::vector<MeasuredMode> measured_modes(const Response& r, const HideRequest& request, double ratio, Noise& noise) {
  std::vector<MeasuredMode> modes;
  for (std::size_t i = 0; i < r.words.size() && int(modes.size()) < request.modes; ++i) {
    if (r.words[i].direction == "local" || r.words[i].order == 0) continue;
    MeasuredMode mode;
    mode.name = fmt::format("{}", modes.size() + 1);
    mode.period = std::exp(-r.log_frequency[Eigen::Index(i)]) * (1.0 + request.noise * noise.normal());
    mode.period_std = request.noise * mode.period;
    mode.direction = r.words[i].direction;
    mode.damping = std::min(0.5, ratio * std::exp(0.1 * noise.normal()));
    mode.damping_std = 0.1 * *mode.damping;
    const Eigen::VectorXd seen = r.sensors.col(Eigen::Index(i));
    const double largest = seen.size() > 0 ? seen.cwiseAbs().maxCoeff() : 0.0;
    const double spread = 2.0 * request.noise;  // shapes are known half as well as periods
    for (Eigen::Index s = 0; s < seen.size(); ++s)
      mode.shape.push_back({std::size_t(s), seen[s] / largest + spread * noise.normal(), spread});
    modes.push_back(mode);
  }
  return modes;
}

/// Sum of squares, in standard deviations, of what fitted materials leave of the effects in these modes if all else is
/// known: without noise, with the true mesh, dimensions and stiffness of parts. Half of it is the most that evidence
/// for the effects can come to.
double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio) {
  Noise none(0, 0.0);
  DiagnosisProblem problem;
  problem.base = bare;
  problem.features.sensors = sensors;
  for (const MeasuredMode& mode : measured_modes(truth, request, ratio, none))
    problem.features.modes.push_back(feature_of(mode, sensors.size()));
  problem.damping = bare_ratio;
  problem.modes = int(problem.features.modes.size()) + 8;
  problem.error.shape = 0.01;  // as diagnose takes it without what its mesh does
  set_shape_errors(problem);
  const Hypothesis materials = {calibrations(bare), {}};
  return fit(problem, materials, Eigen::VectorXd::Zero(Eigen::Index(materials.size())), 8).misfit;
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

int hide(const HideRequest& request) {
  const Case c = read_case(request.case_file, CaseUse::geometry);
  Noise noise(request.seed);
  Assembly assembly = true_bridge(c, request, noise);
  const Assembly bare = assembly;
  // Before there is ground at the ends, which a sensor near the edge would be put on.
  Measured measured;
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
  if (request.minutes > 0.0)
    measured.records = {ambient(truth, request, settings.damping.ratio, noise)};
  else if (request.shaken > 0.0)
    measured.records = {earthquake(assembly, model, truth, memory, sensors, request, settings.damping.ratio, noise)};
  else
    measured.modes = measured_modes(truth, request, settings.damping.ratio, noise);
  for (Recording& record : measured.records) {
    record.channels.clear();
    for (const MeasuredSensor& s : measured.sensors) record.channels.push_back(s.id);
    if (request.shaken > 0.0) record.channels.insert(record.channels.end(), {"base_x", "base_y", "base_z"});
    set_clocks(request, measured.sensors, record);
  }
  measured.what = fmt::format("made by voussoir hide from {}", fs::path(request.case_file).filename().string());
  fs::create_directories(request.directory);
  write_measured(measured, request.directory + "/measured");
  std::string text = answer(request, truth);
  if (request.trace)
    text = fmt::format("trace = {:.1f}\n",
                       trace_of(bare, truth, sound, request, settings.damping.ratio, c.settings.damping.ratio)) +
           text;
  write_atomically(request.directory + "/answer.toml", text);
  fmt::print("{} at {} sensors in {}/measured; the answer is in {}/answer.toml\n",
             request.shaken > 0.0    ? fmt::format("{:g} s of an earthquake", request.shaken)
             : request.minutes > 0.0 ? fmt::format("{:g} min of vibration", request.minutes)
                                     : fmt::format("{} modes", measured.modes.size()),
             measured.sensors.size(), request.directory, request.directory);
  return 0;
}

/// What a measurement of this sort cannot hold would be hidden for nothing.
void check_shows(const HideRequest& request) {
  const bool recorded = request.minutes > 0.0 || request.shaken > 0.0;
  for (const EffectSetting& e : request.effects) {
    if (e.name == "support_motion" && request.shaken == 0.0)
      throw InputError("support_motion shows only where the ground's motion is recorded: give --shaken too");
    if (e.name == "sensor_fault" && e.values.at("delay") != 0.0 && !recorded)
      throw InputError("a late clock shows only in recordings: give --minutes or --shaken too");
  }
}

int hide_run(const std::vector<std::string>& arguments) {
  CommandLine line("hide", "hide CASE --effect \"NAME PLACE PARAMETER=VALUE\" -o DIR",
                   "voussoir hide cases/cs1-f.toml --effect \"abutment_restraint both\" --seed 7 -o hidden");
  HideRequest request;
  line.described.add_options()("effect", options::value<std::vector<std::string>>()->composing(),
                               "what the case lacks; may be repeated; none: nothing")(
      "sensors", options::value<std::string>(&request.sensors)->default_value(request.sensors),
      "sparse, rich or none (periods alone)")("modes", whole_option("modes", 1, 1000, &request.modes)->default_value(6),
                                              "that are measured")(
      "minutes", real_option("minutes", 0.0, 600.0, &request.minutes)->default_value(0.0),
      "of ambient vibration instead of modes; the noise of its channels is five times --noise")(
      "shaken", real_option("shaken", 0.0, 3600.0, &request.shaken)->default_value(0.0),
      "s of a synthetic earthquake, recorded on the ground too, instead of modes; noise as with --minutes")(
      "noise",
      real_option("noise", 0.0, 0.999, &request.noise)->default_value(request.noise, fmt::format("{}", request.noise)),
      "standard deviation of periods, share; of shapes twice that")(
      "scatter",
      real_option("scatter", 0.0, 0.999, &request.scatter)
          ->default_value(request.scatter, fmt::format("{}", request.scatter)),
      "of the stiffness of each part (standard deviation of the logarithm)")(
      "materials",
      real_option("materials", 0.0, 0.999, &request.materials)
          ->default_value(request.materials, fmt::format("{}", request.materials)),
      "the same, of each material")("defects",
                                    real_option("defects", 0.0, 0.999, &request.defects)
                                        ->default_value(request.defects, fmt::format("{}", request.defects)),
                                    "m, standard deviation of every dimension")(
      "mesh",
      real_option("mesh", 0.2, 5.0, &request.mesh)->default_value(request.mesh, fmt::format("{}", request.mesh)),
      "size of the true bridge's blocks over the case's")(
      "trace",
      "write to answer.toml how much of the effects shows in the modes: their sum of squares in standard "
      "deviations that fitted materials leave")(
      "seed", options::value<std::uint64_t>(&request.seed)->default_value(request.seed), "of all that is random")(
      "output,o", options::value<std::string>(&request.directory)->value_name("DIR"), "where to");
  line.positional = {"CASE"};
  line.required = {"CASE", "output"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  request.case_file = values["CASE"].as<std::string>();
  request.trace = values.count("trace") > 0;
  const bool recorded = request.minutes > 0.0 || request.shaken > 0.0;
  if (recorded && request.sensors == "none")
    throw InputError("--minutes and --shaken need sensors; give --sensors sparse or rich");
  if (recorded && values.count("trace"))
    throw InputError("--trace is of modes, which --minutes and --shaken do not give; leave it out");
  if (request.minutes > 0.0 && request.shaken > 0.0) throw InputError("give --minutes or --shaken, not both");
  if (values.count("effect"))
    for (const std::string& text : values["effect"].as<std::vector<std::string>>())
      request.effects.push_back(parse_effect(text));
  check_shows(request);
  return hide(request);
}

}  // namespace

Verb hide_verb() {
  return {"hide", "measurements of a bridge that has what its case lacks: to try diagnose on", hide_run};
}

}  // namespace voussoir
