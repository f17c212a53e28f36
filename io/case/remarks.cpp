#include "io/case/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/case/usual.h"
#include "io/toml/table_reader.h"
#include "solver/base/constants.h"

namespace voussoir {

namespace {

constexpr double ringing = 20.0;  // s of free vibration after a motion that is no cause for a remark

/// Goes through the text of a case, so that the line of each value is known.
class Values {
 public:
  Values(const Case& c, std::vector<std::string>& out) : case_(c), out_(out) {}

  void table(const toml::table& table, const std::string& section, const std::string& path) {
    for (const auto& [name, node] : table) {
      const std::string key(name.str());
      if (section.empty() && key == "check") continue;  // a check is judged by the case that it changes
      if (const toml::table* inner = node.as_table()) {
        const bool named = section == "materials" || section == "joints";
        this->table(*inner, named ? section : joined(section, key), joined(path, key));
      } else if (const toml::array* list = node.as_array()) {
        array(*list, key, section, path);
      } else if (node.is_number()) {
        judge(key, *node.value<double>(), section, path, name.source());
      }
    }
  }

 private:
  static std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  void array(const toml::array& list, const std::string& key, const std::string& section, const std::string& path) {
    double squares = 0.0;
    std::size_t i = 0, numbers = 0;
    for (const toml::node& node : list) {
      ++i;
      if (const toml::table* inner = node.as_table()) {
        // The load pattern of a collapse stage is multiplied by the unknown multiplier.
        if (key == "load" && section == "stage" && collapses_) continue;
        if (key == "stage") collapses_ = (*inner)["kind"].value_or(std::string()) == "collapse";
        table(*inner, joined(section, key), fmt::format("{}[{}]", joined(path, key), i));
      } else if (node.is_number()) {
        const double value = *node.value<double>();
        squares += value * value, ++numbers;
        if (key == "fracture_energy") judge(key, value, section, path, list.source());
      }
    }
    if (numbers == 3) judge(key, std::sqrt(squares), section, path, list.source());
  }

  const Usual* usual_of(const std::string& section, const std::string& key) const {
    if (section != "bridge" || case_.generator.empty()) return usual_of_key(section, key);
    for (const Parameter& p : find_generator(case_.generator).parameters)
      if (p.name == key) return usual_of_parameter(p.name, p.unit);
    return nullptr;
  }

  void judge(const std::string& key, double value, const std::string& section, const std::string& path,
             const toml::source_region& source) {
    const Usual* usual = usual_of(section, key);
    if (!usual) return;
    if (const std::string text = unusual(*usual, value); !text.empty())
      out_.push_back(fmt::format("{}:{}: {} = {:g} {} in [{}]: {}.", case_.path, source.begin.line, key, value,
                                 usual->unit, path, text));
  }

  const Case& case_;
  std::vector<std::string>& out_;
  bool collapses_ = false;  // the stage at hand
};

/// Time (s) and size (m/s2) of the largest acceleration of a motion.
std::pair<double, double> peak_of(const GroundMotion& motion) {
  std::pair<double, double> peak;
  for (std::size_t i = 0; i < motion.acceleration.size(); ++i)
    if (const double a = motion.acceleration[i].cwiseAbs().maxCoeff(); a > peak.second)
      peak = {motion.dt * double(i), a};
  return peak;
}

/// The place of a key of a stage: "FILE:LINE: ".
std::string place_of(const Case& c, const toml::table& stage, const char* key) {
  const auto found = stage.find(key);
  const auto& source = found == stage.end() ? stage.source() : found->first.source();
  return fmt::format("{}:{}: ", c.path, source.begin.line);
}

/// Checks the duration of a motion against its stage, and the peak of a record.
void remark_motion(const Case& c, std::size_t i, const toml::table& table, std::vector<std::string>& out) {
  const StageSettings& stage = c.settings.stages[i];
  if (stage.motion.acceleration.size() < 2) return;
  const double duration = stage.motion.duration();
  const auto [when, peak] = peak_of(stage.motion);
  if (c.motions[i].kind == MotionSource::Kind::record)
    if (const std::string text = unusual(usual("peak"), peak); !text.empty())
      out.push_back(
          fmt::format("{}the motion of stage {} has a peak of {:.4g} m/s2 ({:.3g} g): {}; set it with 'units' "
                      "or 'scale'.",
                      place_of(c, table, "record"), i + 1, peak, peak / standard_gravity, text));
  const std::string place = place_of(c, table, "duration");
  if (stage.duration - duration > std::max(ringing, duration))
    out.push_back(
        fmt::format("{}stage {} lasts {:g} s, but its motion only {:.4g} s; for the rest of the stage the ground "
                    "does not move. Check 'duration' and the time step of the motion, {:.4g} s.",
                    place, i + 1, stage.duration, duration, stage.motion.dt));
  if (when > stage.duration)
    out.push_back(
        fmt::format("{}stage {} ends after {:g} s, before the peak of its motion, which is {:.3g} m/s2 at {:.4g} s "
                    "of {:.4g} s.",
                    place, i + 1, stage.duration, peak, when, duration));
}

}  // namespace

std::vector<std::string> remarks(const Case& c) {
  std::vector<std::string> out;
  const toml::table root = parse_toml(c.text, c.path);
  Values(c, out).table(root, "", "");
  const toml::array* stages = root["stage"].as_array();
  for (std::size_t i = 0; stages && i < stages->size() && i < c.settings.stages.size(); ++i)
    if (const toml::table* table = stages->get(i)->as_table()) remark_motion(c, i, *table, out);
  return out;
}

std::vector<std::string> remarks(const Assembly& assembly, const std::string& name) {
  std::vector<std::string> out;
  const auto judge = [&](const std::string& what, const char* quantity, double value) {
    const Usual& u = usual(quantity);
    if (const std::string text = unusual(u, value); !text.empty())
      out.push_back(fmt::format("{}: {} {:.4g} {}: {}.", name, what, value, u.unit, text));
  };
  if (!assembly.blocks.empty()) {
    Box box = block_box(assembly.blocks.front());
    for (const Block& block : assembly.blocks) {
      const Box own = block_box(block);
      box.low = box.low.cwiseMin(own.low);
      box.high = box.high.cwiseMax(own.high);
    }
    judge("the largest side of the structure is", "extent", (box.high - box.low).maxCoeff());
  }
  if (!assembly.generator.empty()) return out;  // the case states the materials
  for (const Material& m : assembly.materials) {
    judge(fmt::format("density of '{}' is", m.name), "density", m.density);
    judge(fmt::format("Young's modulus of '{}' is", m.name), "modulus", m.youngs_modulus);
    judge(fmt::format("shear modulus of '{}' is", m.name), "shear modulus", m.shear_modulus);
    judge(fmt::format("tensile strength of '{}' is", m.name), "strength", m.tensile_strength);
    judge(fmt::format("cohesion of '{}' is", m.name), "strength", m.cohesion);
  }
  return out;
}

std::vector<std::string> remarks(const Case& c, const Assembly& assembly) {
  std::vector<std::string> out = remarks(c);
  for (std::string& text : remarks(assembly, c.assembly_file.empty() ? c.path : c.assembly_file))
    out.push_back(std::move(text));
  return out;
}

}  // namespace voussoir
