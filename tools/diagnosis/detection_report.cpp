#include "tools/diagnosis/detection_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "viz/page/html.h"

namespace voussoir {

namespace {

using nlohmann::json;

std::string per_cent(double factor) {
  return fmt::format("{:.0f} %", 100.0 * factor);
}

std::vector<std::string> helped(const Addition& a) {
  std::vector<std::string> all;
  for (const Addition::Helped& h : a.most)
    all.push_back(fmt::format("{} at {} ({})", h.name, h.where, per_cent(h.factor)));
  return all;
}

}  // namespace

json number(double x) {
  return std::isfinite(x) ? json(x) : json(nullptr);
}

std::string detectable_text(const Detectable& d) {
  std::vector<std::string> sides;
  if (std::isfinite(d.below)) sides.push_back(fmt::format("below {:.2g}", d.below));
  if (std::isfinite(d.above)) sides.push_back(fmt::format("above {:.2g}", d.above));
  if (sides.empty()) return fmt::format("{}: no amount within its bounds", d.parameter);
  return fmt::format("{} {}{}", d.parameter, fmt::join(sides, " or "), d.unit == "-" ? "" : " " + d.unit);
}

std::string detection_text(const Detection& d) {
  std::string text;
  if (!d.least.empty()) text += "least amounts that these data would show with a probability of 0.9:\n";
  for (const Detectable& least : d.least)
    text += fmt::format("  {} at {}: {}\n", least.name, least.where, detectable_text(least));
  if (!d.further.empty())
    text +=
        "further sensors and modes that would lower these least amounts, each together with those of its kind listed "
        "above it:\n";
  for (const Addition& a : d.further)
    text += fmt::format("  {}: least amounts fall to {} on average, most for {}\n", a.text, per_cent(a.factor),
                        fmt::join(helped(a), ", "));
  return text;
}

void add_detection(const Detection& d, json& j) {
  j["detectable"] = json::array();
  for (const Detectable& least : d.least)
    j["detectable"].push_back({{"effect", least.name},
                               {"where", least.where},
                               {"parameter", least.parameter},
                               {"unit", least.unit},
                               {"neutral", least.neutral},
                               {"below", number(least.below)},
                               {"above", number(least.above)}});
  j["further"] = json::array();
  for (const Addition& a : d.further) {
    json most = json::array();
    for (const Addition::Helped& h : a.most)
      most.push_back({{"effect", h.name}, {"where", h.where}, {"factor", h.factor}});
    j["further"].push_back({{"what", a.text}, {"sensor", a.sensor}, {"factor", a.factor}, {"most", most}});
  }
}

std::string detection_section(const Detection& d, std::string_view title) {
  if (d.least.empty()) return "";
  std::string text = heading(title);
  text += note(
      "For each effect, the table gives the least amount that would be named with a probability of 0.9 from these "
      "modes, sensors and uncertainties, in addition to what was found. A smaller amount may exist on the bridge "
      "without being named.");
  text += "<table>\n" + table_row({{"effect"}, {"where"}, {"least amount"}}, "th");
  for (const Detectable& least : d.least)
    text += table_row({words_cell(least.name), words_cell(least.where), words_cell(detectable_text(least))}, "td");
  text += "</table>\n";
  if (d.further.empty()) return text;
  text += heading("Useful further measurements");
  text += note(
      "The table lists the further sensors and the further modes that lower these least amounts most, each together "
      "with those of its kind listed above it. The column with the least amounts gives the average share of the "
      "amounts in the table above that remains. The last column names the effects whose least amounts fall most by "
      "this sensor or mode alone. A sensor counts in every measured mode. A mode counts with its period and with its "
      "shape at the present sensors.");
  text += "<table>\n" + table_row({{"measurement"}, {"least amounts fall to", true}, {"largest reductions"}}, "th");
  for (const Addition& a : d.further)
    text += table_row(
        {{escaped(a.text)}, {per_cent(a.factor), true}, words_cell(fmt::format("{}", fmt::join(helped(a), ", ")))},
        "td");
  return text + "</table>\n";
}

}  // namespace voussoir
