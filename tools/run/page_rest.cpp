// The sections of a run's page on reactions, displacements and ties at the end.
#include <fmt/format.h>

#include <cmath>

#include "tools/run/page_sections.h"
#include "viz/page/html.h"

namespace voussoir {

namespace {

using nlohmann::json;

/// A note that compares the vertical reactions with the weight.
std::string balance_note(const RunFiles& run, double vertical) {
  const json& inventory = run.of("inventory");
  if (!inventory.value("supports_each_once", false)) return "";
  const json weight = inventory.value("weight", json::object());
  const double all = weight.value("stones", 0.0) + weight.value("fill", 0.0);
  if (!(all > 0.0)) return "";
  const double other = vertical - all;
  return note(
      fmt::format("The sum of the vertical reactions is {:.4g} kN. The free stones and the deformable fill weigh "
                  "{:.4g} kN (stones {:.4g} kN, deformable fill {:.4g} kN). The difference, {:.3g} kN ({:.2g} % of the "
                  "weight), comes from other loads.",
                  1e-3 * vertical, 1e-3 * all, 1e-3 * weight.value("stones", 0.0), 1e-3 * weight.value("fill", 0.0),
                  1e-3 * other, 100.0 * other / all));
}

}  // namespace

std::string reactions_section(const RunFiles& run) {
  const json& reactions = run.of("reactions");
  if (reactions.empty()) return "";
  const bool rest = run.ends_at_rest();
  std::string text = heading(rest ? "Reactions at the end" : "Reactions") + "<table>\n";
  std::vector<Cell> head = {words_cell("fixed blocks"), {"x, kN", true}, {"y, kN", true}, {"z, kN", true}};
  if (!rest) head.push_back({"smallest z, kN", true}), head.push_back({"largest z, kN", true});
  text += table_row(head, "th");
  double sum[3] = {0.0, 0.0, 0.0};
  for (const auto& [group, axes] : reactions.items()) {
    std::vector<Cell> cells = {words_cell(group)};
    for (int c = 0; c < 3; ++c) {
      const double last = axes.value(std::string(1, "xyz"[c]), json::object()).value("last", NAN);
      sum[c] += last;
      cells.push_back(formatted_cell(1e-3 * last, "{:.2f}"));
    }
    if (!rest)
      for (const char* end : {"lowest", "highest"})
        cells.push_back(formatted_cell(1e-3 * axes.value("z", json::object()).value(end, NAN), "{:.2f}"));
    text += table_row(cells, "td");
  }
  const bool each_once = run.of("inventory").value("supports_each_once", false);
  if (each_once && reactions.size() > 1)
    text += table_row({words_cell("together"), formatted_cell(1e-3 * sum[0], "{:.2f}"),
                       formatted_cell(1e-3 * sum[1], "{:.2f}"), formatted_cell(1e-3 * sum[2], "{:.2f}")},
                      "td", "best");
  text += "</table>\n";
  text += note(rest ? "These are the forces of the ground, or of a prescribed motion, on these blocks."
                    : "These are the forces of the ground on these blocks in the last row of the history, and the "
                      "range of the vertical force.");
  return text + (rest ? balance_note(run, sum[2]) : "");
}

std::string places_section(const RunFiles& run) {
  const json& places = run.of("places");
  std::string rows;
  for (const auto& [name, place] : places.items()) {
    double most = 0.0;
    for (const char* axis : {"x", "y", "z"}) most = std::max(most, std::abs(place.value(axis, 0.0)));
    if (most < unmoved) continue;
    const auto turn = [&place = place](const char* axis) {
      return formatted_cell(1e3 * place.value(axis, NAN), "{:.2f}");
    };
    rows += table_row(
        {words_cell(name), formatted_cell(1e3 * place.value("x", NAN), "{:.2f}"),
         formatted_cell(1e3 * place.value("y", NAN), "{:.2f}"), formatted_cell(1e3 * place.value("z", NAN), "{:.2f}"),
         turn("rotation_x"), turn("rotation_y"), turn("rotation_z")},
        "td");
  }
  if (rows.empty()) return "";
  return heading("Crowns, quarter points and pier tops at the end") + "<table>\n" +
         table_row({words_cell("place"),
                    {"x, mm", true},
                    {"y, mm", true},
                    {"z, mm", true},
                    {"about x, mrad", true},
                    {"about y, mrad", true},
                    {"about z, mrad", true}},
                   "th") +
         rows + "</table>\n" +
         note(
             "Each row is the mean over the blocks of the group, relative to the ground and to the end of the gravity "
             "stage.");
}

std::string ties_section(const RunFiles& run) {
  const json& ties = run.of("ties");
  if (!ties.contains("each")) return "";
  std::string text = heading("Ties") + "<table>\n";
  text += table_row({words_cell("tie"),
                     words_cell("from"),
                     words_cell("to"),
                     {"force at the end, kN", true},
                     {"largest force, kN", true},
                     {"plastic elongation, mm", true}},
                    "th");
  std::size_t count = 0;
  for (const json& tie : ties["each"]) {
    const double yielded = tie.value("yielded", 0.0);
    const auto end = [&](const char* anchor, const char* block) {
      if (!tie.contains(anchor)) return words_cell(fmt::format("block {}", tie.value(block, 0)));
      const json& at = tie[anchor];
      return words_cell(fmt::format("{} ({:.2f}, {:.2f}, {:.2f})",
                                    tie["parts"][*block == 'a' ? 0 : 1].get<std::string>(), at[0].get<double>(),
                                    at[1].get<double>(), at[2].get<double>()));
    };
    text += table_row({words_cell(std::to_string(++count)), end("from", "a"), end("to", "b"),
                       formatted_cell(1e-3 * tie.value("force", NAN), "{:.1f}"),
                       formatted_cell(1e-3 * tie.value("largest_force", NAN), "{:.1f}"),
                       yielded > 1e-9 ? formatted_cell(1e3 * yielded, "{:.2f}") : words_cell("no")},
                      "td", yielded > 1e-9 ? "best" : "");
  }
  return text + "</table>\n" +
         note("The coordinates are those of the anchors as built, m. Ties in bold have yielded. Tension is positive.");
}

}  // namespace voussoir
