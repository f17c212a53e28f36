// The sections of a run's page that document it: the model, and the origin of the results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "solver/base/counted.h"
#include "tools/run/page_sections.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

using nlohmann::json;

/// The general arrangement drawing of the run.
std::string drawing(const RunFiles& run) {
  return sheet_figure(text_if_any(run.directory + "/images/arrangement.svg"));
}

std::string materials_table(const json& inventory) {
  const json materials = inventory.value("materials", json::array());
  if (materials.empty()) return "";
  std::string text = "<h3>Materials</h3>\n<table>\n";
  text += table_row({words_cell("material"),
                     {"mass, t", true},
                     {"density, kg/m³", true},
                     {"E, GPa", true},
                     {"G, GPa", true},
                     {"tensile strength, MPa", true},
                     {"cohesion, MPa", true},
                     {"friction angle, °", true}},
                    "th");
  for (const json& m : materials)
    text +=
        table_row({words_cell(m.value("name", std::string())), formatted_cell(1e-3 * m.value("mass", NAN), "{:.1f}"),
                   formatted_cell(m.value("density", NAN), "{:.0f}"),
                   formatted_cell(1e-9 * m.value("youngs_modulus", NAN), "{:.4g}"),
                   formatted_cell(1e-9 * m.value("shear_modulus", NAN), "{:.4g}"),
                   formatted_cell(1e-6 * m.value("tensile_strength", NAN), "{:.4g}"),
                   formatted_cell(1e-6 * m.value("cohesion", NAN), "{:.4g}"),
                   formatted_cell(m.value("friction_angle", NAN), "{:.1f}")},
                  "td");
  return text + "</table>\n" +
         note(
             "For rigid stones the moduli give the stiffness of the joints between them, and the strengths are those "
             "of the joints. For a deformable fill they are the properties of the soil.");
}

std::string law_words(const json& law) {
  std::string text = law.value("kind", std::string());
  if (!law.contains("tension")) return text;
  text += fmt::format(": ft {:.4g} MPa, c {:.4g} MPa, φ {:.1f}°", 1e-6 * law.value("tension", NAN),
                      1e-6 * law.value("cohesion", NAN), law.value("friction_angle", NAN));
  if (law.contains("residual_cohesion"))
    text += fmt::format(", residual c {:.4g} MPa", 1e-6 * law.value("residual_cohesion", NAN));
  if (law.contains("residual_friction_angle"))
    text += fmt::format(", residual φ {:.1f}°", law.value("residual_friction_angle", NAN));
  if (law.contains("fracture_energy"))
    text += fmt::format(", GI {:.4g} J/m², GII {:.4g} J/m²", law["fracture_energy"][0].get<double>(),
                        law["fracture_energy"][1].get<double>());
  if (law.contains("compressive_strength"))
    text += fmt::format(", fc {:.4g} MPa", 1e-6 * law.value("compressive_strength", NAN));
  if (law.contains("dilation_angle")) text += fmt::format(", ψ {:.1f}°", law.value("dilation_angle", NAN));
  return text;
}

std::string range_text(const json& range) {
  const double low = 1e-9 * range[0].get<double>(), high = 1e-9 * range[1].get<double>();
  return low == high ? fmt::format("{:.3g}", low) : fmt::format("{:.3g} to {:.3g}", low, high);
}

std::string joints_table(const json& inventory) {
  const json joints = inventory.value("joints", json::array());
  if (joints.empty()) return "";
  std::string text = "<h3>Joints</h3>\n<table>\n";
  text += table_row({words_cell("joints within or between"),
                     {"number", true},
                     {"area, m²", true},
                     {"kn, GPa/m", true},
                     {"ks, GPa/m", true},
                     words_cell("laws")},
                    "th");
  for (const json& f : joints) {
    std::vector<std::string> laws;
    for (const json& law : f["laws"]) {
      if (laws.size() == 3 && f["laws"].size() > 4) {
        laws.push_back(fmt::format("and {} more", f["laws"].size() - 3));
        break;
      }
      laws.push_back(f["laws"].size() == 1 ? law_words(law)
                                           : fmt::format("{} ({:.1f} m²)", law_words(law), law.value("area", NAN)));
    }
    text += table_row({words_cell(f.value("joints", std::string())),
                       {std::to_string(f.value("count", 0)), true},
                       formatted_cell(f.value("area", NAN), "{:.1f}"),
                       {range_text(f["kn"]), true},
                       {range_text(f["ks"]), true},
                       words_cell(fmt::format("{}", fmt::join(laws, "; ")))},
                      "td");
  }
  return text + "</table>\n" +
         note(
             "kn, ks: normal and shear stiffness of a joint per area; ft, c, φ: tensile strength, cohesion and "
             "friction angle; GI, GII: fracture energies; fc: compressive strength; ψ: dilation angle.");
}

std::string supports_list(const RunFiles& run, const json& inventory) {
  const json supports = inventory.value("supports", json::array());
  if (supports.empty()) return "";
  std::vector<std::string> items;
  for (const json& s : supports) {
    const std::string group = s.value("group", std::string());
    std::string how = "moves with the ground";
    for (const Guide& guide : run.c.settings.guides)
      if (guide.group == group) {
        std::string axes;
        for (std::size_t c = 0; c < 3; ++c)
          if (guide.free[c]) axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[c]);
        how = (axes.empty() ? "held along all axes" : "free along " + axes) + (guide.turn ? ", free to turn" : "");
      }
    for (const StageSettings& stage : run.stages())
      for (const Drive& drive : stage.drives)
        if (drive.group == group) how += fmt::format("; driven in the stage '{}'", stage.label);
    items.push_back(fmt::format("{} ({}): {}", group, counted(s.value("blocks", 0), "block"), how));
  }
  return "<h3>Supports: blocks that cannot move freely</h3>\n" + list(items);
}

std::string damping_words(const DampingSettings& d) {
  switch (d.kind) {
    case DampingSettings::Kind::none:
      return "none";
    case DampingSettings::Kind::maxwell:
      return fmt::format("{} parallel to joints and fill, {:g} % of critical damping from {:g} to {:g} Hz",
                         counted(d.branches, "Maxwell branch", "Maxwell branches"), 100.0 * d.ratio, d.band[0],
                         d.band[1]);
    case DampingSettings::Kind::rayleigh:
      return fmt::format("Rayleigh, {:g} % of critical damping at {:g} and {:g} Hz", 100.0 * d.ratio, d.band[0],
                         d.band[1]);
    case DampingSettings::Kind::local:
      return fmt::format("local (Cundall), {:g} times the out-of-balance force", d.coefficient);
  }
  return "";
}

std::string assumptions(const RunFiles& run) {
  const SolverSettings& s = run.c.settings;
  const bool timed = std::ranges::any_of(s.stages, [](const StageSettings& stage) { return stage.timed(); });
  const bool fill = run.of("fill").contains("tetrahedra");
  std::vector<std::string> items = {
      "Stones are rigid. They meet in joints without thickness, which carry compression, bond and friction. All "
      "deformation of the masonry is in the joints."};
  items.push_back(fmt::format("Contact is computed at {} along each side of a quadrilateral joint; {}.",
                              counted(s.contact.points_per_side, "point"),
                              s.contact.search
                                  ? "the program finds contacts between stones that touch later"
                                  : "the program does not search for contacts between stones that touch later"));
  items.push_back(fill ? fmt::format("The fill is a continuum of {}, elastic and perfectly plastic (Mohr–Coulomb).",
                                     counted(run.of("fill").value("tetrahedra", 0), "tetrahedron", "tetrahedra"))
                       : "There is no deformable fill. Any fill consists of rigid blocks.");
  items.push_back(fmt::format("Gravity is ({:g}, {:g}, {:g}) m/s².", s.gravity.x(), s.gravity.y(), s.gravity.z()));
  if (!s.stages.empty() && s.stages.front().kind == StageSettings::Kind::gravity)
    items.push_back(
        s.stages.front().construction
            ? "The bridge is built in construction steps. Each step comes to rest before the next one begins."
            : "The whole bridge is present when gravity begins to act.");
  if (timed) items.push_back("Damping in stages with time steps: " + damping_words(s.damping) + ".");
  if (timed && s.step.mass_scaling_limit > 0.0)
    items.push_back(fmt::format("Mass scaling may add up to {:g} times the mass (to the inertia only).",
                                s.step.mass_scaling_limit));
  for (const EffectSetting& effect : run.c.effects) items.push_back("Effect: " + effect.text() + ".");
  return "<h3>Assumptions</h3>\n" + list(items);
}

}  // namespace

std::string model_section(const RunFiles& run) {
  const json& inventory = run.of("inventory");
  return heading("The model") + drawing(run) + assumptions(run) + materials_table(inventory) + joints_table(inventory) +
         supports_list(run, inventory);
}

std::string provenance_section(const RunFiles& run) {
  const json& p = run.of("provenance");
  std::string text = heading("Origin of these results");
  if (!p.empty()) {
    text += paragraph(fmt::format("Computed on {} by voussoir {} (commit {}, {}, kernels for {}), {}.",
                                  p.value("date", std::string("?")), p.value("version", std::string("?")),
                                  p.value("commit", std::string("?")), p.value("compiler", std::string("?")),
                                  p.value("kernels", std::string("?")),
                                  counted(run.summary.value("threads", 1), "thread")));
    text += "<table class=\"small\">\n" + table_row({words_cell("file"), {"bytes", true}, words_cell("SHA-256")}, "th");
    for (const json& file : p.value("files", json::array()))
      text += table_row({words_cell(file.value("name", std::string())),
                         {std::to_string(file.value("bytes", std::int64_t(0))), true},
                         {"<code>" + escaped(file.value("sha256", std::string())) + "</code>", false}},
                        "td");
    text += "</table>\n";
  } else {
    text += paragraph("voussoir " + run.summary.value("program_version", std::string("?")) +
                      ". That version did not record the date, the commit and the digests of the input files.");
  }
  return text + "<h3>The case with every key written out</h3>\n<pre class=\"case\">" + escaped(run.c.text) + "</pre>\n";
}

}  // namespace voussoir
