#include <algorithm>
#include <filesystem>
#include <regex>

#include "io/case/case.h"
#include "io/case/degrees.h"
#include "io/case/motion_source.h"
#include "io/case/sections.h"
#include "io/records/format.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

std::string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x()), number_text(v.y()), number_text(v.z()));
}

/// Collects "key = value" lines.
class TomlText {
 public:
  void heading(const std::string& name) { text_ += fmt::format("\n{}\n", name); }
  void raw(const std::string& key, const std::string& value) { text_ += fmt::format("{} = {}\n", key, value); }
  void set(const std::string& key, double value) { raw(key, number_text(value)); }
  void set(const std::string& key, const std::string& value) { raw(key, quoted(value)); }
  void set_angle(const std::string& key, double radians) { raw(key, degrees_text(radians)); }
  void set_flag(const std::string& key, bool value) { raw(key, value ? "true" : "false"); }
  std::string text_ = "# Resolved case: every value written out, also those that were defaults.\n";
};

/// Writes the keys whose dotted names are the prefix and one more part, without keys that a profile replaces.
void write_keys(TomlText& out, const GeneratorInput& input, const std::string& prefix,
                const std::vector<Profile>& profiles) {
  std::vector<std::string> replaced;
  for (const Profile& profile : profiles)
    if (input.profiles.contains(prefix + profile.name))
      for (const std::string& key : profile.instead_of) replaced.push_back(prefix + key);
  const auto own = [&](const std::string& key) {
    return key.starts_with(prefix) && key.find('.', prefix.size()) == std::string::npos &&
           std::find(replaced.begin(), replaced.end(), key) == replaced.end();
  };
  for (const auto& [key, word] : input.choices)
    if (own(key)) out.set(key.substr(prefix.size()), word);
  for (const auto& [key, value] : input.values)
    if (own(key)) out.set(key.substr(prefix.size()), value);
  for (const auto& [key, line] : input.profiles) {
    if (!own(key)) continue;
    std::string points;
    for (const Vec3& p : line)
      points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", number_text(p.x()), number_text(p.z()));
    out.raw(key.substr(prefix.size()), "[" + points + "]");
  }
}

void write_bridge(TomlText& out, const Case& c) {
  out.heading("[bridge]");
  if (c.generator.empty()) return out.set("assembly", std::string("assembly.h5"));
  out.set("generator", c.generator);
  write_keys(out, c.generator_input, "", {});
  for (const KeyTable& table : find_generator(c.generator).tables) {
    const std::size_t entries = table.is_list() ? c.generator_input.entries.at(table.name) : 1;
    for (std::size_t i = 0; i < entries; ++i) {
      out.heading(table.heading());
      write_keys(out, c.generator_input, table.prefix(i), table.profiles);
    }
  }
  for (const auto& [name, m] : c.generator_input.materials) {
    out.heading(fmt::format("[materials.{}]", quoted(name)));
    out.set("density", m.density);
    out.set("youngs_modulus", m.youngs_modulus);
    out.set("shear_modulus", m.shear_modulus);
    out.set("tensile_strength", m.tensile_strength);
    out.set("cohesion", m.cohesion);
    out.set_angle("friction_angle", m.friction_angle);
    out.set_angle("dilation_angle", m.dilation_angle);
  }
}

void write_joints(TomlText& out, const Case& c) {
  for (const auto& [key, joint] : c.generator_input.joints) {
    out.heading(fmt::format("[joints.{}]", quoted(key)));
    if (joint.kn > 0.0) out.set("kn", joint.kn);
    if (joint.ks > 0.0) out.set("ks", joint.ks);
    if (!joint.has_law) continue;
    const JointLaw& law = joint.law;
    out.set("kind", joint_law_kinds()[std::size_t(law.kind)]);
    out.set("tensile_strength", law.tension);
    out.set("cohesion", law.cohesion);
    out.set_angle("friction_angle", law.friction_angle);
    out.set("residual_cohesion", law.residual_cohesion);
    out.set_angle("residual_friction_angle", law.residual_friction_angle);
    out.set_angle("dilation_angle", law.dilation_angle);
    out.raw("fracture_energy",
            fmt::format("[{}, {}]", number_text(law.fracture_energy[0]), number_text(law.fracture_energy[1])));
    if (law.kind != JointLaw::Kind::composite) continue;
    out.set("dilation_length", law.dilation_length);
    out.set("dilation_pressure", law.dilation_pressure);
    if (law.compressive_strength == 0.0) continue;
    out.set("compressive_strength", law.compressive_strength);
    out.set("compressive_energy", law.compressive_energy);
    out.set("compressive_peak", law.compressive_peak);
    out.set("cap_shear", law.cap_shear);
  }
}

void write_settings(TomlText& out, const SolverSettings& s) {
  out.heading("[analysis]");
  out.raw("gravity", vector_text(s.gravity));
  out.set("time_step", s.step.time_step);
  out.set("safety", s.step.safety);
  out.set("mass_scaling_limit", s.step.mass_scaling_limit);
  out.set("mass_scaling_step", s.step.mass_scaling_step);
  out.set("equilibrium_tolerance", s.step.equilibrium_tolerance);
  out.set_flag("intact_shortcut", s.step.intact_shortcut);
  out.heading("[contact]");
  out.raw("points_per_side", std::to_string(s.contact.points_per_side));
  out.set("gap_tolerance", s.contact.gap_tolerance);
  out.set("skin", s.contact.skin);
  out.set("reclip_slip", s.contact.reclip_slip);
  out.set_angle("reclip_angle", s.contact.reclip_angle);
  out.set_flag("search", s.contact.search);
  out.heading("[damping]");
  out.set("kind", damping_kinds()[std::size_t(s.damping.kind)]);
  out.set("ratio", s.damping.ratio);
  out.raw("band", fmt::format("[{}, {}]", number_text(s.damping.band[0]), number_text(s.damping.band[1])));
  out.raw("branches", std::to_string(s.damping.branches));
  out.set("coefficient", s.damping.coefficient);
  out.heading("[output]");
  out.set("checkpoint_every", s.output.checkpoint_every);
  out.set("checkpoint_wall", s.output.checkpoint_wall);
  out.set("fields_every", s.output.fields_every);
  out.set("history_every", s.output.history_every);
  out.raw("gravity_modes", fmt::format("{}", s.output.gravity_modes));
}

std::string pulse_text(const PulseSettings& pulse) {
  std::string text =
      fmt::format("{{ kind = {}, axis = {}, amplitude = {}", quoted(pulse_kinds()[std::size_t(pulse.kind)]),
                  quoted(axis_names[pulse.axis]), number_text(pulse.amplitude));
  if (pulse.frequency > 0.0) text += ", frequency = " + number_text(pulse.frequency);
  if (pulse.length > 0.0) text += ", length = " + number_text(pulse.length);
  return text + ", start = " + number_text(pulse.start) + " }";
}

std::string synthetic_text(const SyntheticSettings& s) {
  std::vector<std::string> axes;
  for (int axis = 0; axis < 3; ++axis)
    if (s.axes[std::size_t(axis)]) axes.push_back(quoted(axis_names[axis]));
  std::string size = "peak = " + number_text(s.peak);
  if (s.spectrum) {
    const TargetSpectrum& t = *s.spectrum;
    size = fmt::format("spectrum = {}, ag = {}", quoted(target_codes()[std::size_t(t.code)]), number_text(t.ag));
    if (t.code == TargetCode::ntc2018) size += fmt::format(", f0 = {}, tc = {}", number_text(t.f0), number_text(t.tc));
    size += fmt::format(", soil = \"{}\", topography = {}", t.soil, t.topography);
  }
  return fmt::format(
      "{{ seed = {}, {}, duration = {}, axes = [{}], frequency = {}, bandwidth = {}, rise = {}, strong = {}, "
      "dt = {} }}",
      s.seed, size, number_text(s.duration), fmt::join(axes, ", "), number_text(s.frequency), number_text(s.bandwidth),
      number_text(s.rise), number_text(s.strong), number_text(s.dt));
}

void write_motion(TomlText& out, const MotionSource& source, std::size_t stage) {
  std::array<std::string, 3> names;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!source.files[axis].empty()) names[axis] = motion_file_name(stage, int(axis));
  out.text_ += motion_source_text(source, names);
}

std::string list_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x()), number_text(v.y()), number_text(v.z()));
}

void write_drives(TomlText& out, const std::vector<Drive>& drives) {
  std::vector<std::string> texts;
  for (const Drive& d : drives) {
    const bool constant = !d.velocity.isZero(0.0);
    // Only where they say something: stages without a motion have no such keys.
    const std::string departs =
        d.with_ground() ? "" : fmt::format(", factor = {}, delay = {}", number_text(d.factor), number_text(d.delay));
    texts.push_back(fmt::format("{{ group = {}, {} = {}{} }}", quoted(d.group), constant ? "velocity" : "displacement",
                                list_text(constant ? d.velocity : d.displacement), departs));
  }
  if (!texts.empty()) out.raw("drive", fmt::format("[{}]", fmt::join(texts, ", ")));
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) all.push_back(quoted(word));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

void write_construction(TomlText& out, const std::optional<ConstructionSettings>& construction) {
  if (!construction) return out.set("construction", std::string("at once"));
  if (construction->steps.empty()) {
    out.set("construction", std::string("staged"));
    out.set("lift", construction->lift);
    return;
  }
  std::vector<std::string> texts;
  for (const ConstructionStep& step : construction->steps) {
    std::string text = step.add.empty() ? "strike = " + quoted_list(step.strike) : "add = " + quoted_list(step.add);
    if (!step.label.empty()) text += ", label = " + quoted(step.label);
    if (step.below < 1e300) text += fmt::format(", below = {}", number_text(step.below));
    if (step.lift > 0.0) text += fmt::format(", lift = {}", number_text(step.lift));
    if (step.centering) text += ", centering = true";
    texts.push_back("{ " + text + " }");
  }
  out.raw("construction", fmt::format("[{}]", fmt::join(texts, ", ")));
}

void write_placements(TomlText& out, const std::vector<Placement>& placements) {
  std::vector<std::string> texts;
  for (const Placement& p : placements)
    texts.push_back(fmt::format("{{ group = {}, move = {}, angle = {}, axis = {}, through = {} }}", quoted(p.group),
                                list_text(p.move), degrees_text(p.angle), list_text(p.axis), list_text(p.through)));
  if (!texts.empty()) out.raw("place", fmt::format("[{}]", fmt::join(texts, ", ")));
}

std::string road_text(const RoadLoad& load, double speed) {
  const RoadArea& a = load.area;
  return fmt::format("{{ road = [{}, {}, {}, {}], pressure = {}, of = {}{} }}", number_text(a.x0), number_text(a.x1),
                     number_text(a.y0), number_text(a.y1), number_text(load.pressure), quoted(load.of),
                     speed == 0.0 ? "" : ", speed = " + number_text(speed));
}

void write_loads(TomlText& out, const Loads& loads, const std::vector<MovingLoad>& moving) {
  std::vector<std::string> texts;
  if (!loads.acceleration.isZero(0.0))
    texts.push_back(fmt::format("{{ acceleration = {} }}", list_text(loads.acceleration)));
  for (const ForceLoad& load : loads.forces)
    texts.push_back(fmt::format("{{ group = {}, force = {}{} }}", quoted(load.group), list_text(load.force),
                                load.at ? ", at = " + list_text(*load.at) : ""));
  for (const RoadLoad& load : loads.road) texts.push_back(road_text(load, 0.0));
  for (const MovingLoad& load : moving) texts.push_back(road_text(load.start, load.speed));
  out.raw("load", fmt::format("[{}]", fmt::join(texts, ", ")));
}

void write_collapse(TomlText& out, const CollapseSettings& collapse) {
  if (collapse.tilt) out.raw("tilt", list_text(*collapse.tilt));
  out.set("to", collapse.to);
  out.set("tolerance", collapse.tolerance);
  out.set("displacement", collapse.displacement);
  out.set("confirm", collapse.confirm);
}

void write_quasi_static(TomlText& out, const StageSettings& stage) {
  const QuasiStaticSettings& s = stage.quasi_static;
  out.set("method", gravity_methods()[std::size_t(stage.method)]);
  out.set("duration", stage.duration);
  out.raw("steps", std::to_string(s.steps));
  std::vector<std::string> corners;
  for (const double corner : s.path) corners.push_back(number_text(corner));
  out.raw("path", fmt::format("[{}]", fmt::join(corners, ", ")));
  if (s.push) out.set("push", *s.push);
  out.raw("halvings", std::to_string(s.halvings));
}

void write_guides(TomlText& out, const std::vector<Guide>& guides) {
  for (const Guide& guide : guides) {
    std::vector<std::string> ways;
    for (std::size_t c = 0; c < 3; ++c)
      if (guide.free[c]) ways.push_back(quoted(axis_names[c]));
    out.heading("[[guide]]");
    out.set("group", guide.group);
    out.raw("free", fmt::format("[{}]", fmt::join(ways, ", ")));
    out.set_flag("turn", guide.turn);
  }
}

void write_stages(TomlText& out, const Case& c) {
  for (std::size_t i = 0; i < c.settings.stages.size(); ++i) {
    const StageSettings& stage = c.settings.stages[i];
    out.heading("[[stage]]");
    out.set("kind", stage_kinds()[std::size_t(stage.kind)]);
    out.set("label", stage.label);
    if (stage.kind == StageSettings::Kind::gravity) {
      out.set("method", gravity_methods()[std::size_t(stage.method)]);
      out.set_flag("allow_motion", stage.allow_motion);
      write_construction(out, stage.construction);
    }
    if (stage.timed()) out.set("duration", stage.duration);
    if (stage.kind == StageSettings::Kind::quasi_static) write_quasi_static(out, stage);
    if (stage.kind == StageSettings::Kind::motion) write_motion(out, c.motions[i], i);
    write_drives(out, stage.drives);
    write_placements(out, stage.placements);
    if (stage.loads || !stage.moving.empty()) write_loads(out, stage.loads.value_or(Loads{}), stage.moving);
    if (stage.kind == StageSettings::Kind::collapse) write_collapse(out, stage.collapse);
  }
}

void write_effects(TomlText& out, const std::vector<EffectSetting>& effects) {
  for (const EffectSetting& effect : effects) {
    out.heading("[[effect]]");
    out.set("name", effect.name);
    if (!effect.where.empty()) out.set("where", effect.where);
    for (const auto& [parameter, value] : effect.values) out.set(parameter, value);
  }
}

void write_modal(TomlText& out, const Case& c) {
  const ModalSettings& modal = c.settings.modal;
  out.heading("[modal]");
  out.raw("modes", std::to_string(modal.modes));
  out.set("state", modal_states()[std::size_t(modal.state)]);
  out.set_flag("geometric", modal.geometric);
  for (const ExpectedPeriod& expected : c.expected_periods) {
    out.heading("[[modal.expected]]");
    out.set("direction", expected.direction);
    out.raw("order", std::to_string(expected.order));
    out.set("period", expected.period);
    out.set("source", expected.source);
  }
}

/// A curve that was read is copied next to the resolved case; a missing curve keeps its name.
void write_plots(TomlText& out, const std::vector<PlotSpec>& plots) {
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const PlotSpec& plot = plots[i];
    out.heading("[[plot]]");
    for (const auto& [key, text] : {std::pair{"name", &plot.name},
                                    {"title", &plot.title},
                                    {"label", &plot.label},
                                    {"x", &plot.x},
                                    {"y", &plot.y},
                                    {"x_label", &plot.x_label},
                                    {"y_label", &plot.y_label}})
      out.set(key, *text);
    out.set("x_factor", plot.x_factor);
    out.set("y_factor", plot.y_factor);
    for (std::size_t k = 0; k < plot.measured.size(); ++k) {
      const MeasuredCurve& curve = plot.measured[k];
      out.heading("[[plot.measured]]");
      out.set("file", curve.text.empty() ? curve.file : measured_file_name(i, k));
      out.set("label", curve.label);
    }
  }
}

}  // namespace

std::string resolved_text(const Case& c) {
  TomlText out;
  write_bridge(out, c);
  write_joints(out, c);
  write_settings(out, c.settings);
  write_guides(out, c.settings.guides);
  write_stages(out, c);
  for (const SensorSpec& sensor : c.sensors) {
    out.heading("[[sensor]]");
    out.set("id", sensor.id);
    out.raw("position", vector_text(sensor.position));
    out.raw("direction", vector_text(sensor.direction));
  }
  write_effects(out, c.effects);
  write_modal(out, c);
  write_plots(out, c.plots);
  for (const DemandLimit& limit : c.limits) {
    out.heading("[[limit_state]]");
    out.set("name", limit.name);
    out.set("demand", limit.demand);
    out.set("threshold", limit.threshold);
  }
  return out.text_;
}

bool is_copy_for_case(const std::string& name) {
  static const std::regex copies(
      "motion_[0-9]+_[xyz]\\.txt|measured_[0-9]+_[0-9]+\\.txt");  // motion_file_name(), measured_file_name()
  return std::regex_match(name, copies);
}

void write_resolved_case(const Case& c, const std::string& directory) {
  const std::filesystem::path folder(directory);
  for (std::size_t i = 0; i < c.motions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!c.motions[i].files[std::size_t(axis)].empty())
        write_atomically((folder / motion_file_name(i, axis)).string(), c.motions[i].texts[std::size_t(axis)]);
  for (std::size_t i = 0; i < c.plots.size(); ++i)
    for (std::size_t k = 0; k < c.plots[i].measured.size(); ++k)
      if (const std::string& text = c.plots[i].measured[k].text; !text.empty())
        write_atomically((folder / measured_file_name(i, k)).string(), text);
  write_atomically((folder / "case.toml").string(), resolved_text(c));
}

void write_self_contained_case(const Case& c, const std::string& directory) {
  write_resolved_case(c, directory);
  if (!c.assembly_file.empty()) write_atomically(directory + "/assembly.h5", read_text(c.assembly_file));
}

std::string motion_source_text(const MotionSource& source, const std::array<std::string, 3>& files) {
  TomlText out;
  out.text_.clear();
  out.set("scale", source.scale);
  if (source.pga > 0.0) out.set("scale_to_pga", source.pga);
  if (source.kind == MotionSource::Kind::pulse) out.raw("pulse", pulse_text(source.pulse));
  if (source.kind == MotionSource::Kind::synthetic) out.raw("synthetic", synthetic_text(source.synthetic));
  if (source.kind != MotionSource::Kind::record) return out.text_;
  out.raw("record", fmt::format("[{}, {}, {}]", quoted(files[0]), quoted(files[1]), quoted(files[2])));
  // A case with 'units' is refused if a file states its own unit.
  if (std::ranges::none_of(source.texts, [](const std::string& text) { return recognise(text).unit > 0.0; }))
    out.set("units", source.units);
  if (source.dt > 0.0) out.set("dt", source.dt);
  if (!source.columns.empty()) {
    std::vector<std::string> words;
    for (const std::string& word : source.columns) words.push_back(quoted(word));
    out.raw("columns", fmt::format("[{}]", fmt::join(words, ", ")));
  }
  if (source.begin > 0.0) out.set("begin", source.begin);
  out.set_flag("correct", source.correct);
  return out.text_;
}

std::string effects_text(const std::vector<EffectSetting>& effects) {
  TomlText out;
  out.text_.clear();
  write_effects(out, effects);
  return out.text_;
}

}  // namespace voussoir
