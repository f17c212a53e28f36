// The first sentences of a run's page.
#include <fmt/format.h>

#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "tools/run/damage_words.h"
#include "tools/run/page_sections.h"
#include "tools/run/part_damage.h"
#include "tools/run/steps_report.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

using nlohmann::json;

std::string sentence(const std::string& head, const std::string& words) {
  return fmt::format("<p><strong>{}</strong> {}</p>\n", escaped(head), escaped(words));
}

std::string collapse_sentence(const RunFiles& run) {
  if (!run.summary.contains("collapse")) return "";
  return sentence("Collapse load.", run.of("collapse").value("headline", std::string()));
}

std::string steps_sentence(const RunFiles& run) {
  std::string text;
  for (const json& one : steps_json(run.stages(), run.history)) {
    const bool loaded = one.value("largest_force", 0.0) != 0.0;
    std::string words = one.value("whole", false)
                            ? "the program found an equilibrium at every increment"
                            : fmt::format("there is no equilibrium beyond the share {:.4g}", one.value("share", 0.0));
    if (loaded)
      words += fmt::format(
          "; the largest force is {:.4g} kN, at a displacement of {:.4g} mm, and the last force {:.4g} kN, at {:.4g} "
          "mm",
          1e-3 * one.value("largest_force", NAN), 1e3 * one.value("largest_force_at", NAN),
          1e-3 * one.value("force", NAN), 1e3 * one.value("displacement", NAN));
    text += sentence(fmt::format("{}:", one.value("label", std::string())), words + ".");
  }
  return text;
}

/// For a run with a gravity stage only: the largest settlement and compression.
std::string gravity_sentence(const RunFiles& run) {
  const json gravity = run.summary.value("gravity", json::array());
  if (run.stages().size() != 1 || gravity.empty()) return "";
  const json* sunk = nullptr;
  const json* pressed = nullptr;
  for (const json& part : gravity.back()["parts"])
    if (!sunk || part["settlement"] > (*sunk)["settlement"]) sunk = &part;
  for (const json& family : gravity.back()["joints"])
    if (!pressed || family["compression"] > (*pressed)["compression"]) pressed = &family;
  std::string words = "The bridge stands.";
  if (sunk)
    words += fmt::format(" Its largest settlement is {} ({}).", mm_text((*sunk)["settlement"].get<double>(), 2),
                         (*sunk)["part"].get<std::string>());
  if (pressed)
    words += fmt::format(" The largest mean compression of a joint is {:.3f} MPa ({}).",
                         1e-6 * (*pressed)["compression"].get<double>(), (*pressed)["joints"].get<std::string>());
  return sentence("Under its own weight.", words);
}

/// The worst damage of the masonry, and separately that of joints with soil or loose infill.
std::string damage_sentences(const RunFiles& run) {
  const json* masonry = nullptr;
  const json* loose = nullptr;
  const json parts = run.summary.value("part_damage", json::array());
  for (const json& entry : parts) {
    const json*& worst = entry.value("fill", false) ? loose : masonry;
    if (!worst) worst = &entry;
  }
  std::string text;
  const auto add = [&](const json* entry, const char* where) {
    if (!entry) return;
    if (std::max((*entry)["largest_opening"].get<double>(), (*entry)["largest_slip"].get<double>()) < unmoved) {
      text += sentence(where, "No joint has opened or slid.");
      return;
    }
    std::string damage = damage_sentence(*entry);
    text += sentence(where, fmt::format("The worst place is {}, {}. The damage is {}.", part_words(*entry),
                                        place_words((*entry)["at"]), damage));
  };
  add(masonry, "Masonry.");
  add(loose, "Joints with infill or soil.");
  const json& fill = run.of("fill");
  if (fill.contains("yielded_in_shear"))
    text += sentence(
        "Fill.", fmt::format("{:.1f} % of its volume has yielded in shear and {:.1f} % in tension. The largest "
                             "displacement is {}.",
                             100.0 * fill.value("yielded_in_shear", 0.0), 100.0 * fill.value("yielded_in_tension", 0.0),
                             mm_text(fill.value("largest_displacement", 0.0), 1)));
  return text;
}

/// For summaries of earlier versions, which have no damage by parts.
std::string family_sentence(const RunFiles& run) {
  if (run.summary.contains("part_damage")) return "";
  const json& damage = run.of("damage");
  std::string worst;
  double most = -1.0;
  for (const auto& [name, entry] : damage.items())
    if (const double opening = entry.value("largest_opening", 0.0); opening > most) most = opening, worst = name;
  return worst.empty() ? ""
                       : sentence(fmt::format("Worst joints: {}.", worst),
                                  "The damage is " + damage_sentence(damage[worst]) + ".");
}

/// The peak acceleration of the ground, and whether stones have fallen by the end.
std::string motion_sentence(const RunFiles& run) {
  std::string text;
  for (const StageSettings& stage : run.stages()) {
    if (stage.kind != StageSettings::Kind::motion) continue;
    double peak = 0.0;
    for (const Vec3& a : stage.motion.acceleration) peak = std::max(peak, a.cwiseAbs().maxCoeff());
    text += sentence(fmt::format("{}.", stage.label),
                     fmt::format("The largest acceleration of the ground along one axis is {:.3g} m/s² ({:.3g} g).",
                                 peak, peak / standard_gravity));
  }
  const bool stands = run.summary.value("finished", false) && !run.summary.contains("fallen");
  if (text.empty() || !stands) return text;
  constexpr double gone = 1.0;  // m, opening of a joint whose stone has fallen
  const json parts = run.summary.value("part_damage", json::array());
  const bool whole = std::ranges::none_of(parts, [](const json& p) { return p.value("largest_opening", 0.0) > gone; });
  return text + (whole ? sentence("The bridge stands", "at the end of the run.")
                       : sentence("Stones have fallen", "by the end of the run."));
}

std::string fallen_sentence(const RunFiles& run) {
  if (!run.summary.contains("fallen")) return "";
  const json& fallen = run.of("fallen");
  return sentence("The bridge fell",
                  fmt::format("at {:.2f} s. At that time {:.0f} % of the mass that can move had moved farther than the "
                              "limit of the campaign.",
                              fallen.value("time", NAN), 100.0 * fallen.value("share_of_mass", NAN)));
}

/// The damage class of the bridge, and the worst finding.
std::string bridge_sentence(const RunFiles& run) {
  const json& damage = run.of("bridge_damage");
  const json findings = damage.value("findings", json::array());
  if (findings.empty()) return "";
  return sentence(
      fmt::format("Class of the bridge: {}.", damage.value("class", std::string())),
      fmt::format("{}{}.", findings.front().value("words", std::string()),
                  findings.size() > 1 ? fmt::format(", and {}", counted(findings.size() - 1, "more finding")) : ""));
}

std::string ties_sentence(const RunFiles& run) {
  const json& ties = run.of("ties");
  if (!ties.contains("count")) return "";
  return sentence("Ties.",
                  fmt::format("{} of {} have yielded. The largest force is {:.1f} kN.", ties.value("have_yielded", 0),
                              ties.value("count", 0), 1e-3 * ties.value("largest_force", 0.0)));
}

}  // namespace

std::string verdict_section(const RunFiles& run) {
  std::string text = fallen_sentence(run);
  if (!run.summary.value("finished", true) && !run.summary.contains("fallen"))
    text += sentence("The run has not ended.",
                     fmt::format("It has reached t = {:.3f} s. All results on this page are those of that moment.",
                                 run.summary.value("end_time", 0.0)));
  text += motion_sentence(run) + collapse_sentence(run) + steps_sentence(run) + gravity_sentence(run) +
          damage_sentences(run) + bridge_sentence(run) + family_sentence(run) + ties_sentence(run);
  return text.empty() ? "" : fmt::format("<div class=\"verdict found\">\n{}</div>\n", text);
}

}  // namespace voussoir
