// The sections of a run's page on damage: by parts of the bridge, by families of joints, and the demands.
#include <fmt/format.h>

#include <cmath>

#include "tools/run/damage_words.h"
#include "tools/run/page_sections.h"
#include "tools/run/part_damage.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {

using nlohmann::json;

Cell millimetres(double metres) {
  return formatted_cell(1e3 * metres, "{:.2f}");
}

bool damaged(const json& entry) {
  return entry.value("largest_opening", 0.0) > unmoved || entry.value("largest_slip", 0.0) > unmoved ||
         entry.value("broken_share", 0.0) > 0.0;
}

std::string classes_note() {
  std::string classes;
  double from = 0.0;
  for (const DamageClass& c : damage_classes()) {
    classes += fmt::format(
        "{}{} {}", classes.empty() ? "" : ", ", c.word,
        std::isfinite(c.below) ? fmt::format("below {:g} mm", 1e3 * c.below) : fmt::format("from {:g} mm", 1e3 * from));
    from = c.below;
  }
  return note(
      "The words follow from the largest opening of a joint since the start, compared with widths of cracks after "
      "Burland, Broms & de Mello (1977): " +
      classes + ".");
}

/// The parts of the bridge that have been damaged, the worst first.
std::string parts_table(const RunFiles& run) {
  constexpr std::size_t most = 20;
  std::string rows;
  std::size_t count = 0;
  for (const json& entry : run.summary.value("part_damage", json::array())) {
    if (!damaged(entry) || ++count > most) continue;
    const json& at = entry["at"];
    rows += table_row({words_cell(part_words(entry)), words_cell(damage_sentence(entry)),
                       words_cell(fmt::format("{:.2f}, {:.2f}, {:.2f}", at[0].get<double>(), at[1].get<double>(),
                                              at[2].get<double>()))},
                      "td");
  }
  if (rows.empty()) return "";
  return "<table>\n" +
         table_row(
             {words_cell("joints within or between"), words_cell("damage"), words_cell("worst place (x, y, z), m")},
             "th") +
         rows + "</table>\n" +
         (count > most ? note(fmt::format("These are the {} worst of {} rows. All are in summary.json (part_damage).",
                                          most, count))
                       : std::string());
}

std::string families_table(const RunFiles& run) {
  std::string rows, whole;
  for (const auto& [name, entry] : run.of("damage").items())
    if (damaged(entry))
      rows += table_row({words_cell(name), words_cell(damage_sentence(entry))}, "td");
    else
      whole += (whole.empty() ? "" : ", ") + name;
  std::string text;
  if (!rows.empty())
    text = "<table>\n" + table_row({words_cell("joints within or between"), words_cell("damage")}, "th") + rows +
           "</table>\n";
  return text + (whole.empty() ? "" : note("No joint has opened, slid or broken in " + whole + "."));
}

}  // namespace

std::string damage_section(const RunFiles& run) {
  if (run.of("damage").empty()) return "";
  const std::string parts = parts_table(run);
  // Summaries of earlier versions have no damage by parts.
  const std::string families = run.summary.contains("part_damage") ? std::string() : families_table(run);
  return (parts.empty() ? "" : heading("Damage by parts of the bridge") + parts + classes_note()) +
         (families.empty() ? "" : heading("Damage by families of joints") + families);
}

std::string demand_section(const RunFiles& run) {
  const json& demand = run.of("demand");
  if (run.ends_at_rest()) return "";  // places_section() reports the displacements
  std::string text;
  const json places = demand.value("places", json::object());
  for (const auto& [name, place] : places.items())
    if (place.value("largest", 0.0) > unmoved)
      text += table_row({words_cell(name), words_cell(place.value("axis", std::string())),
                         millimetres(place.value("largest", NAN)), millimetres(place.value("residual", NAN))},
                        "td");
  if (text.empty()) return "";
  for (const auto& [kind, words] :
       {std::pair{"keystone_x", "mean of the keystones, x"}, std::pair{"spandrel_y", "mean of the spandrel walls, y"}})
    if (demand.contains(kind))
      text += table_row({words_cell(words), words_cell(""), millimetres(demand[kind].value("largest_mean", NAN)),
                         millimetres(demand[kind].value("residual_mean", NAN))},
                        "td", "best");
  return heading("Displacements relative to the base") + "<table>\n" +
         table_row({words_cell("place"), words_cell("axis"), {"largest, mm", true}, {"at the end, mm", true}}, "th") +
         text + "</table>\n";
}

}  // namespace voussoir
