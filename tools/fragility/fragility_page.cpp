#include "tools/fragility/fragility_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/fragility/fragility_charts.h"
#include "tools/fragility/fragility_words.h"
#include "viz/page/html.h"
#include "viz/page/svg.h"

namespace voussoir {

namespace {

constexpr std::size_t intensities_on_page = 8;

Cell number(double value, const char* format) {
  return {std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : std::string("–"), true};
}

Cell band_cell(const CurveBand& band) {
  return {std::isfinite(band.low) ? fmt::format("{:.3g} – {:.3g}", band.low, band.high) : std::string("–"), true};
}

std::string curves_table(const std::vector<const Fragility*>& curves) {
  const std::string unit = measure_unit(curves.front()->im);
  std::string text = "<table>\n" + table_row({{"case"},
                                              {"runs", true},
                                              {"records", true},
                                              {"beyond", true},
                                              {"collapsed", true},
                                              {unit.empty() ? std::string("θ") : "θ, " + unit, true},
                                              {"5 – 95 %", true},
                                              {"β", true},
                                              {"5 – 95 %", true},
                                              {"by"}},
                                             "th");
  for (const Fragility* f : curves) {
    const SelectedRuns& s = f->selection;
    const auto count = [](std::size_t n) { return Cell{fmt::format("{}", n), true}; };
    text +=
        table_row({words_cell(f->case_name), count(s.trials.size()), count(s.records.size()), count(s.beyond),
                   count(s.collapsed), number(f->chosen.theta, "{:.3g}"), band_cell(f->bootstrap.theta),
                   number(f->chosen.beta, "{:.2f}"), band_cell(f->bootstrap.beta),
                   words_cell(f->chosen.identified == Identified::yes ? method_words(*f) : std::string("no curve"))},
                  "td");
  }
  return text + "</table>\n";
}

std::vector<std::string> notes_on(const std::vector<const Fragility*>& curves) {
  std::vector<std::string> notes;
  for (const Fragility* f : curves) {
    if (f->chosen.identified != Identified::yes)
      notes.push_back(fmt::format("{}: no curve: {}.", f->case_name, unknown_words(f->chosen, f->im)));
    for (const std::string& remark : remarks_on(*f)) notes.push_back(fmt::format("{}: {}", f->case_name, remark));
    if (const std::string out = left_out_words(f->selection); !out.empty())
      notes.push_back(fmt::format("{}: runs left out: {}.", f->case_name, out));
  }
  return notes;
}

std::string limit_section(const std::vector<const Fragility*>& curves) {
  const Fragility& first = *curves.front();
  std::string text = heading(fmt::format("{}: {}", first.limit.name, limit_words(first.limit)));
  text += figure(curves_chart(curves)) + curves_table(curves);
  if (const auto notes = notes_on(curves); !notes.empty()) text += list(notes);
  if (first.limit.demand == collapse_demand) return text;
  const std::string chart = demand_chart(curves);
  if (chart.empty()) return text;
  text += figure(chart);
  return text + note(
                    "Least-squares lines through the logarithms of the runs without collapse, with one standard "
                    "deviation to both sides (dashed). Triangles at the top: collapsed.");
}

std::string sufficiency_words(const MeasurePair& p) {
  std::string text;
  for (const Sufficiency& s : p.sufficiency)
    text += fmt::format("{}{}: p = {:.2g}", text.empty() ? "" : ", ", measure_name(s.characteristic), s.p);
  if (!p.sufficient()) text += "; not sufficient";
  return text;
}

std::string ranking_table(const IntensityRanking& ranking) {
  if (ranking.pairings.empty()) return "";
  std::string text =
      fmt::format("<h3>{}: {}</h3>\n<table>\n", escaped(ranking.case_name), escaped(measure_name(ranking.demand)));
  text += table_row({{"intensity"},
                     {"runs", true},
                     {"efficiency", true},
                     {"practicality", true},
                     {"proficiency", true},
                     {"R²", true},
                     {"sufficiency"}},
                    "th");
  for (std::size_t i = 0; i < std::min(intensities_on_page, ranking.pairings.size()); ++i) {
    const MeasurePair& p = ranking.pairings[i];
    text += table_row({words_cell(measure_name(p.im) + (p.complete ? "" : " (not in all runs)")),
                       {fmt::format("{}", p.line.count), true},
                       number(p.line.scatter, "{:.3f}"),
                       number(p.line.slope, "{:.2f}"),
                       number(p.proficiency(), "{:.3f}"),
                       number(p.line.r2, "{:.2f}"),
                       words_cell(sufficiency_words(p))},
                      "td", i == 0 ? "best" : "");
  }
  return text + "</table>\n";
}

std::string rankings_section(const FragilityReport& report) {
  std::string tables;
  for (const IntensityRanking& ranking : report.intensities) tables += ranking_table(ranking);
  if (tables.empty()) return "";
  return heading("Which intensity measure predicts which demand") +
         note(
             "Efficiency: scatter of the logarithm of the demand at a given intensity; a smaller value is better. "
             "Practicality: slope of the line. Proficiency: efficiency divided by practicality; a smaller value is "
             "better, and the rows are in this order. Sufficiency: the probability that a further characteristic of "
             "the ground motion improves the prediction as much by chance alone. Below 0.05 the intensity measure is "
             "not sufficient.") +
         tables;
}

std::string damage_section(const FragilityReport& report) {
  std::string text;
  for (const CaseDamage& c : report.damage) {
    if (c.rankings.empty()) continue;
    std::vector<std::string> sentences;
    for (const DamageRanking& r : c.rankings) sentences.push_back(damage_words(r));
    text += fmt::format("<h3>{}</h3>\n{}", escaped(c.case_name), list(sentences));
  }
  if (text.empty()) return "";
  return heading("Which demand predicts the damage") +
         note(
             "Spearman's rank correlation between a demand and the share of broken joint area of a component. 1: the "
             "runs have the same order by both.") +
         text;
}

}  // namespace

std::string fragility_page(const std::string& title, const FragilityReport& report) {
  std::string page = paragraph(runs_words(report) + ".");
  for (const std::string& remark : report.remarks) page += paragraph(remark);
  if (!report.curves.empty())
    page += note(
        fmt::format("The curves are Φ(ln(im/θ)/β). θ is the intensity at which half of the runs exceed the limit. β is "
                    "the standard deviation of its logarithm. Bands: 5 to 95 % of {} resamples of the records.",
                    report.settings.replicates));
  for (const auto& group : by_limit(report.curves)) page += limit_section(group);
  page += rankings_section(report) + damage_section(report);
  return html_page(title, page);
}

}  // namespace voussoir
