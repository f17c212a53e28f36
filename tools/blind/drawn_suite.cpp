// The rule by which the second and the third suite are drawn. It was written before either was run, and is not changed
// in view of their results.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/random.h"
#include "tools/blind/trials.h"

namespace voussoir {

namespace {

/// Random numbers of one trial: each purpose has its own stream.
class Draw {
 public:
  Draw(std::uint64_t seed, int trial) : seed_(seed), trial_(trial) {}
  RandomStream stream(const std::string& purpose) const { return stream_of(seed_, "suite: " + purpose, trial_); }
  double between(const std::string& purpose, double low, double high) const {
    return low + (high - low) * stream(purpose).uniform();
  }
  double log_between(const std::string& purpose, double low, double high) const {
    return low * std::pow(high / low, stream(purpose).uniform());
  }
  /// In low … high.
  int whole(const std::string& purpose, int low, int high) const {
    return low + int(stream(purpose).below(std::size_t(high) - std::size_t(low) + 1));
  }
  bool happens(const std::string& purpose, double probability) const {
    return stream(purpose).uniform() <= probability;
  }
  template <class T>
  const T& one_of(const std::string& purpose, const std::vector<T>& list) const {
    return list[stream(purpose).below(list.size())];
  }

 private:
  std::uint64_t seed_;
  int trial_;
};

/// Of a bridge as drawn, m.
struct Plan {
  int spans;
  double abutment, span, pier, foot;  // foot: z of the abutments' base
  double span_start(int i) const { return abutment + i * (span + pier); }
};
Plan plan_of(const std::string& bridge) {
  return bridge == "cs1" ? Plan{4, 4.8, 10.0, 1.6, 0.0} : Plan{3, 7.5, 15.0, 3.5, 5.8};
}

/// Names of the parts of a bridge with so many spans.
std::vector<std::string> numbered(const std::string& name, int count) {
  std::vector<std::string> all;
  for (int i = 0; i < count; ++i) all.push_back(fmt::format("{} {}", name, i));
  return all;
}
std::vector<std::string> together(std::vector<std::string> one, const std::vector<std::string>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

std::vector<std::string> places_of(const std::string& effect, const std::string& bridge) {
  const int spans = plan_of(bridge).spans;
  const std::vector<std::string> arches = numbered("arch", spans), piers = numbered("pier", spans - 1);
  const std::vector<std::string> abutments = {"abutment left", "abutment right"};
  if (effect == "abutment_restraint") return {"left", "right", "both"};
  if (effect == "neighbouring_structure") return {"left", "right"};
  if (effect == "foundation_flexibility") return together(together(piers, abutments), {"all"});
  if (effect == "support_motion") return together(piers, abutments);
  if (effect == "spandrel_separation") return {"both", "spandrel y-", "spandrel y+"};
  if (effect == "stiffer_masonry") return together(together(arches, piers), {"arches", "piers"});
  if (effect == "joint_softening")
    return together(together(arches, piers), {"arches", "piers", "backing", "spandrel y-", "spandrel y+"});
  if (effect == "added_mass") return {"deck"};
  if (effect != "scour") return {"all"};
  std::vector<std::string> sides;
  for (const std::string& pier : piers)
    for (const char* side : {"x-", "x+", "y-", "y+"}) sides.push_back(fmt::format("{} {}", pier, side));
  return sides;
}

/// The amount of an effect: a range for each parameter, drawn evenly on a logarithmic scale.
struct Amount {
  const char *effect, *parameter;
  double low, high;
};
const Amount amounts[] = {{"abutment_restraint", "stiffness_share", 0.1, 0.8},
                          {"foundation_flexibility", "soil_shear_modulus", 1e7, 8e7},
                          {"scour", "lost_share", 0.3, 0.7},
                          {"added_mass", "mass_per_length", 1e4, 5e4},
                          {"joint_softening", "factor", 0.1, 0.4},
                          {"stiffer_masonry", "factor", 2.0, 4.0},
                          {"fill_stiffness", "factor", 0.05, 0.2},
                          {"fill_interface", "factor", 0.02, 0.1},
                          {"spandrel_separation", "factor", 0.001, 0.01},
                          {"tie_rods", "axial_stiffness", 2e9, 8e9},
                          {"parapet_not_structural", "factor", 0.001, 0.01},
                          {"neighbouring_structure", "stiffness", 1e9, 4e9},
                          {"neighbouring_structure", "mass", 2e5, 6e5},
                          {"amplitude_stiffness", "share_open", 0.6, 0.9},
                          {"damping", "ratio", 0.04, 0.08},
                          {"support_motion", "factor", 0.3, 0.6}};

std::string effect_text(const Draw& draw, const std::string& effect, const std::string& where) {
  std::string text = effect + " " + where;
  for (const Amount& a : amounts)
    if (effect == a.effect)
      text += fmt::format(" {}={:.3g}", a.parameter,
                          draw.log_between(fmt::format("amount of {} {}", effect, a.parameter), a.low, a.high));
  return text;
}
std::string drawn_effect(const Draw& draw, const std::string& effect, const std::string& bridge) {
  return effect_text(draw, effect, draw.one_of("place of " + effect, places_of(effect, bridge)));
}

/// The kinds of sensor faults in order. The channel is determined when the sensor plan is known.
std::string drawn_fault(const Draw& draw, int sort) {
  const double u = draw.between("channel", 0.0, 1.0);
  const auto channel = [&](const char* which) { return fmt::format("sensor_fault channel {{{}{:.4f}}}", which, u); };
  const double sign = draw.happens("sign", 0.5) ? 1.0 : -1.0;
  switch (sort) {
    case 0:
      return channel("any ") + " gain=-1";
    case 1:
      return channel("any ") + fmt::format(" gain={:.3g}", std::pow(draw.log_between("gain", 1.8, 3.5), sign));
    case 2:
      return channel("flat ") + fmt::format(" turn={:g}", 90.0 * sign);
    case 3:
      return channel("flat ") + fmt::format(" turn={:g}", 45.0 * sign);
    case 4:
      return channel("flat ") + fmt::format(" tilt={:g}", 90.0 * sign);
    case 5:
      return channel("any ") + " gain=0";
    case 6:
      return fmt::format("sensor_fault channels {{pair {:.4f}}}", u);
    default:
      return channel("any ") + fmt::format(" delay={:.3g}", sign * draw.log_between("delay", 0.01, 0.03));
  }
}

/// Other deviations of the bridge and its measurement, independent of the hidden effects.
BlindTrial drawn_truth(const Draw& draw, std::uint64_t seed, int number) {
  BlindTrial t;
  t.bridge = draw.happens("bridge", 0.5) ? "cs1" : "cs2";
  t.seed = 10000 * seed + std::uint64_t(number);
  t.sensors = fmt::format("{}", draw.whole("sensors", 5, 40));
  t.noise = std::round(1e4 * draw.log_between("noise", 0.005, 0.02)) / 1e4;
  if (draw.happens("noise said", 0.25)) t.noise_said = 0.5;
  t.mesh = std::round(100.0 * draw.log_between("mesh", 0.7, 1.6)) / 100.0;
  t.defects = std::round(1e3 * draw.between("defects", 0.02, 0.05)) / 1e3;
  t.scatter = std::round(1e3 * draw.between("scatter", 0.05, 0.10)) / 1e3;
  return t;
}

/// Deviations that depend on the bridge: fill, bond, spans, parapets.
void draw_making(const Draw& draw, BlindTrial& t) {
  const double fill = draw.between("fill", 0.0, 1.0);
  if (fill < 0.35) {
    t.truth = {"backfill=deformable", "fill_edge=1"};
  } else if (fill < 0.5) {
    t.fill = "deformable";
    t.truth = {"backfill=rigid"};
  }
  if (fill >= 0.35 && draw.happens("bond", 0.5)) t.truth.push_back("fill_bond=running");
  const Plan plan = plan_of(t.bridge);
  if (draw.happens("longer span", 0.3))
    t.truth.push_back(fmt::format("span_{}_clear={:.2f}", draw.whole("which span", 0, plan.spans - 1),
                                  plan.span + draw.between("how much longer", 0.05, 0.3)));
  if (t.bridge == "cs1" && draw.happens("gaps", 0.5)) t.parapet_gaps = draw.whole("number of gaps", 1, 4);
}

/// Effects that are excluded from the diagnosis, together with similar ones.
void draw_without(const Draw& draw, int sort, BlindTrial& t) {
  const Plan plan = plan_of(t.bridge);
  const std::string pier = fmt::format("pier {}", draw.whole("pier", 0, plan.spans - 2));
  const std::string arch = fmt::format("arch {}", draw.whole("arch", 0, plan.spans - 1));
  if (sort == 0) {
    const std::string where = draw.one_of("place of abutment_restraint", places_of("abutment_restraint", t.bridge));
    t.effects = {effect_text(draw, "abutment_restraint", where)};
    t.without = "abutment_restraint,neighbouring_structure";
    t.where = where == "both" ? "abutment" : "abutment " + where;
  } else if (sort == 1) {
    t.effects = {effect_text(draw, "foundation_flexibility", pier)};
    t.without = "foundation_flexibility,joint_softening,scour";
    t.where = pier;
  } else if (sort == 2) {
    t.effects = {effect_text(draw, "joint_softening", arch)};
    t.without = "joint_softening";
    t.where = arch;
  } else {
    t.effects = {effect_text(draw, "scour", pier + " " + draw.one_of<std::string>("side", {"x-", "x+", "y-", "y+"}))};
    t.without = "scour,foundation_flexibility,joint_softening";
    t.where = pier;
  }
}

/// Damage that no effect describes.
void draw_loosened(const Draw& draw, int sort, BlindTrial& t) {
  const Plan plan = plan_of(t.bridge);
  const double factor = draw.log_between("factor", 0.01, 0.05);
  const std::string side = draw.happens("side", 0.5) ? "y-" : "y+", half = side == "y-" ? "y=..0" : "y=0..";
  const int span = draw.whole("arch", 0, plan.spans - 1);
  if (sort == 0) {  // some rows of voussoirs at a quarter of the span
    const double x = plan.span_start(span) + plan.span * (draw.happens("quarter", 0.5) ? 0.25 : 0.75);
    t.where = fmt::format("arch {}", span);
    t.loosened = {fmt::format("part={} x={:.2f}..{:.2f} factor={:.3g}", t.where, x - 0.125 * plan.span,
                              x + 0.125 * plan.span, factor)};
  } else if (sort == 1) {  // a pier split from top to bottom
    t.where = fmt::format("pier {}", draw.whole("pier", 0, plan.spans - 2));
    t.loosened = {fmt::format("part={} {} factor={:.3g}", t.where, half, factor)};
  } else if (sort == 2) {  // a crack of settlement across one spandrel wall
    const double x = plan.span_start(span) + draw.between("crack", 0.25, 0.75) * plan.span;
    t.where = "spandrel " + side;
    t.loosened = {fmt::format("part={} x={:.2f}..{:.2f} factor={:.3g}", t.where, x - 2.0, x + 2.0, factor)};
  } else {  // the foot of an abutment is washed out
    t.where = draw.happens("end", 0.5) ? "abutment left" : "abutment right";
    t.loosened = {fmt::format("part={} z=..{:.2f} factor={:.3g}", t.where, plan.foot + 3.0, factor)};
  }
}

constexpr const char* single_effects[] = {"abutment_restraint",
                                          "abutment_restraint",
                                          "abutment_restraint",
                                          "foundation_flexibility",
                                          "foundation_flexibility",
                                          "foundation_flexibility",
                                          "scour",
                                          "scour",
                                          "added_mass",
                                          "added_mass",
                                          "joint_softening",
                                          "joint_softening",
                                          "joint_softening",
                                          "joint_softening",
                                          "stiffer_masonry",
                                          "stiffer_masonry",
                                          "fill_stiffness",
                                          "fill_stiffness",
                                          "fill_interface",
                                          "fill_interface",
                                          "spandrel_separation",
                                          "spandrel_separation",
                                          "tie_rods",
                                          "parapet_not_structural",
                                          "neighbouring_structure",
                                          "neighbouring_structure",
                                          "amplitude_stiffness",
                                          "damping",
                                          "support_motion",
                                          "support_motion"};

/// Two effects that can act together; the last two pairs are an effect and a fault.
void draw_two(const Draw& draw, int pair, BlindTrial& t) {
  std::vector<std::string> names = {"abutment_restraint",     "foundation_flexibility", "joint_softening",
                                    "neighbouring_structure", "stiffer_masonry",        "added_mass",
                                    "fill_interface"};
  const std::string first = draw.one_of("first", names);
  t.effects = {drawn_effect(draw, first, t.bridge)};
  if (pair >= 8) {
    t.effects.push_back(drawn_fault(draw, draw.whole("fault", 0, 2)));
    return;
  }
  const bool at_ends = first == "abutment_restraint" || first == "neighbouring_structure";
  std::erase_if(names, [&](const std::string& name) {
    return name == first || (at_ends && (name == "abutment_restraint" || name == "neighbouring_structure"));
  });
  t.effects.push_back(drawn_effect(draw, draw.one_of("second", names), t.bridge));
}

}  // namespace

std::vector<BlindTrial> drawn_suite(std::uint64_t seed) {
  constexpr int nothing = 12, single = 30, two = 10, outside = 8, faults = 8;
  std::vector<BlindTrial> suite;
  for (int n = 0; n < nothing + single + two + outside + faults; ++n) {
    const Draw draw(seed, n);
    BlindTrial t = drawn_truth(draw, seed, n);
    int k = n - nothing;
    const std::string effect = k >= 0 && k < single ? single_effects[k] : "";
    if (effect == "parapet_not_structural") t.bridge = "cs1";
    draw_making(draw, t);
    if (effect == "support_motion") t.shaken = 60.0, t.noise_said = 1.0;
    if (!effect.empty()) t.effects = {drawn_effect(draw, effect, t.bridge)};
    k -= single;
    if (k >= 0 && k < two) draw_two(draw, k, t);
    k -= two;
    if (k >= 0 && k < 4) draw_without(draw, k, t);
    if (k >= 4 && k < outside) draw_loosened(draw, k - 4, t);
    k -= outside;
    if (k >= 0) t.effects = {drawn_fault(draw, k)};
    // Two channels of one place are among 20 on either bridge; a fault is one of several channels' own.
    if (k >= 0 || t.effects.size() > 1) t.sensors = fmt::format("{}", draw.whole("more sensors", 20, 40));
    if (k == faults - 1) t.minutes = 10.0, t.noise_said = 1.0;
    suite.push_back(t);
  }
  return suite;
}

}  // namespace voussoir
