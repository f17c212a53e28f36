#include "tools/fragility/fragility_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/csv.h"
#include "tools/fragility/fragility_words.h"

namespace voussoir {

namespace {

constexpr std::size_t intensities_in_report = 6;

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json band_json(const CurveBand& band) {
  return {number(band.low), number(band.high)};
}

nlohmann::json line_json(const Line& line) {
  return {{"runs", line.count},
          {"intercept", number(line.intercept)},
          {"slope", number(line.slope)},
          {"slope_std", number(line.slope_std)},
          {"scatter", number(line.scatter)},
          {"r2", number(line.r2)}};
}

nlohmann::json estimate_json(const Estimate& e, const std::string& im) {
  nlohmann::json json = {
      {"method", method_name(e)}, {"identified", e.identified == Identified::yes}, {"theta", number(e.theta)},
      {"beta", number(e.beta)},   {"ln_theta_std", number(e.ln_theta_std)},        {"beta_std", number(e.beta_std)}};
  if (e.identified != Identified::yes) {
    json["reason"] = unknown_words(e, im);
    json["theta_between"] = band_json({e.below, e.above});
  } else if (e.method == Method::cloud) {
    json["stands"] = {{"theta", number(e.curve.theta)}, {"beta", number(e.curve.beta)}};
    if (!std::isnan(e.curve.collapse_theta))
      json["collapse"] = {{"theta", number(e.curve.collapse_theta)}, {"beta", number(e.curve.collapse_beta)}};
  }
  return json;
}

nlohmann::json selection_json(const SelectedRuns& s) {
  return {{"used", s.trials.size()},     {"beyond", s.beyond},           {"collapsed", s.collapsed},
          {"records", s.records.size()}, {"failed", s.failed},           {"missing", s.missing},
          {"without_im", s.no_im},       {"without_demand", s.no_demand}};
}

nlohmann::json curve_json(const Fragility& f) {
  nlohmann::json json = estimate_json(f.chosen, f.im);
  json["case"] = f.case_name;
  json["limit"] = f.limit.name;
  json["demand"] = f.limit.demand;
  json["threshold"] = f.limit.demand == collapse_demand ? nlohmann::json() : number(f.limit.threshold);
  json["im"] = f.im;
  json["im_unit"] = measure_unit(f.im);
  json["runs"] = selection_json(f.selection);
  json["theta_band"] = band_json(f.bootstrap.theta);
  json["beta_band"] = band_json(f.bootstrap.beta);
  json["replicates"] = f.bootstrap.replicates;
  json["replicates_unidentified"] = f.bootstrap.unidentified;
  json["levels"] = nlohmann::json::array();
  if (!f.levels.empty())
    for (const Count& c : f.counts) json["levels"].push_back({{"im", c.im}, {"runs", c.runs}, {"beyond", c.beyond}});
  if (f.cloud.line.known()) json["line"] = line_json(f.cloud.line);
  if (f.limit.demand != collapse_demand) json["other"] = estimate_json(f.other, f.im);
  json["curve"] = nlohmann::json::array();
  for (const CurvePoint& p : f.curve)
    json["curve"].push_back({{"im", p.im},
                             {"probability", number(p.probability)},
                             {"low", number(p.band.low)},
                             {"high", number(p.band.high)}});
  json["remarks"] = remarks_on(f);
  return json;
}

nlohmann::json ranking_json(const IntensityRanking& ranking) {
  nlohmann::json json = {{"case", ranking.case_name}, {"demand", ranking.demand}};
  json["intensities"] = nlohmann::json::array();
  for (const MeasurePair& p : ranking.pairings) {
    nlohmann::json one = line_json(p.line);
    one["im"] = p.im;
    one["efficiency"] = number(p.line.scatter);
    one["practicality"] = number(p.line.slope);
    one["proficiency"] = number(p.proficiency());
    one["sufficiency"] = nlohmann::json::object();
    for (const Sufficiency& s : p.sufficiency) one["sufficiency"][s.characteristic] = number(s.p);
    one["sufficient"] = p.sufficiency.empty() ? nlohmann::json() : nlohmann::json(p.sufficient());
    json["intensities"].push_back(one);
  }
  return json;
}

nlohmann::json damage_json(const std::string& case_name, const DamageRanking& r) {
  nlohmann::json json = {{"case", case_name}, {"damage", r.damage}, {"first_ahead", number(r.ahead)}};
  json["demands"] = nlohmann::json::array();
  for (const Association& a : r.demands)
    json["demands"].push_back({{"demand", a.demand}, {"runs", a.count}, {"rank_correlation", number(a.correlation)}});
  return json;
}

std::string band_text(const CurveBand& band) {
  return std::isfinite(band.low) ? fmt::format("{:.3g} – {:.3g}", band.low, band.high) : std::string("-");
}

std::size_t case_width(const FragilityReport& report) {
  std::size_t width = 4;
  for (const Fragility& f : report.curves) width = std::max(width, f.case_name.size());
  return width;
}

std::string curve_rows(const Fragility& f, std::size_t width) {
  std::string text =
      fmt::format("  {:<{}} {:>5} {:>6}", f.case_name, width, f.selection.trials.size(), f.selection.beyond);
  if (f.chosen.identified == Identified::yes)
    text += fmt::format("  {:>8.3g} {:>17}  {:>6.3f} {:>17}  {}\n", f.chosen.theta, band_text(f.bootstrap.theta),
                        f.chosen.beta, band_text(f.bootstrap.beta), method_words(f));
  else
    text += fmt::format("  no curve: {}\n", unknown_words(f.chosen, f.im));
  for (const std::string& remark : remarks_on(f)) text += fmt::format("    {}\n", remark);
  if (const std::string out = left_out_words(f.selection); !out.empty())
    text += fmt::format("    runs left out: {}\n", out);
  return text;
}

std::string curves_text(const FragilityReport& report) {
  const std::size_t width = case_width(report);
  std::string text;
  for (const auto& group : by_limit(report.curves)) {
    const Fragility& first = *group.front();
    text += fmt::format("\nlimit {}: {}; over {} ({})\n  {:<{}} {:>5} {:>6}  {:>8} {:>17}  {:>6} {:>17}\n",
                        first.limit.name, limit_words(first.limit), first.im, measure_label(first.im), "case", width,
                        "runs", "beyond", "θ", "5 – 95 %", "β", "5 – 95 %");
    for (const Fragility* f : group) text += curve_rows(*f, width);
  }
  return text;
}

std::string ranking_text(const IntensityRanking& ranking) {
  std::string text = fmt::format(
      "\n{}: intensity measures for {}, in order of proficiency\n  {:<14} {:>5} {:>10} {:>12} {:>11} {:>6}  {}\n",
      ranking.case_name, ranking.demand, "", "runs", "efficiency", "practicality", "proficiency", "R²", "sufficiency");
  for (std::size_t i = 0; i < std::min(intensities_in_report, ranking.pairings.size()); ++i) {
    const MeasurePair& p = ranking.pairings[i];
    std::string tests;
    for (const Sufficiency& s : p.sufficiency)
      tests += fmt::format("{}{} {:.2g}", tests.empty() ? "p: " : ", ", measure_name(s.characteristic), s.p);
    if (!p.sufficient()) tests += " (not sufficient)";
    text += fmt::format("  {:<14} {:>5} {:>10.3f} {:>12.3f} {:>11} {:>6.3f}  {}\n", p.im, p.line.count, p.line.scatter,
                        p.line.slope, std::isfinite(p.proficiency()) ? fmt::format("{:.3f}", p.proficiency()) : "-",
                        p.line.r2, tests);
  }
  return text;
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
}

}  // namespace

std::vector<std::vector<const Fragility*>> by_limit(const std::vector<Fragility>& curves) {
  std::vector<std::vector<const Fragility*>> groups;
  for (const Fragility& f : curves) {
    const auto same = [&](const auto& group) {
      const LimitState& l = group.front()->limit;
      return l.name == f.limit.name && l.demand == f.limit.demand && l.threshold == f.limit.threshold &&
             group.front()->im == f.im;
    };
    const auto at = std::find_if(groups.begin(), groups.end(), same);
    if (at == groups.end())
      groups.push_back({&f});
    else
      at->push_back(&f);
  }
  return groups;
}

std::string runs_words(const FragilityReport& r) {
  std::string text = fmt::format("{}: {} done", counted(r.done + r.collapsed + r.failed + r.missing, "run"), r.done);
  if (r.collapsed) text += fmt::format(", {} collapsed", r.collapsed);
  if (r.failed) text += fmt::format(", {} failed", r.failed);
  if (r.missing) text += fmt::format(", {} not run yet", r.missing);
  return text;
}

std::string damage_words(const DamageRanking& r) {
  const Association& first = r.demands.front();
  std::string text = fmt::format("{} follows {} most closely (rank correlation {:.2f}", measure_name(r.damage),
                                 measure_name(first.demand), first.correlation);
  for (std::size_t i = 1; i < std::min<std::size_t>(r.demands.size(), 4); ++i)
    text += fmt::format("; {} {:.2f}", measure_name(r.demands[i].demand), r.demands[i].correlation);
  text += fmt::format(", {})", counted(first.count, "run"));
  if (std::isnan(r.ahead)) return text + ".";
  return text + fmt::format(". It remains first in {:.0f} % of the resamples{}.", 100.0 * r.ahead,
                            r.ahead < 0.95 ? ", so the order is not certain" : "");
}

std::string report_text(const FragilityReport& report) {
  std::string text = fmt::format("{}: {}\n", report.table, runs_words(report));
  text += curves_text(report);
  for (const IntensityRanking& ranking : report.intensities)
    if (!ranking.pairings.empty()) text += ranking_text(ranking);
  for (const CaseDamage& c : report.damage) {
    if (c.rankings.empty()) continue;
    text += fmt::format("\n{}: which demand predicts the damage\n", c.case_name);
    for (const DamageRanking& r : c.rankings) text += fmt::format("  {}\n", damage_words(r));
  }
  if (!report.remarks.empty()) text += "\n";
  for (const std::string& remark : report.remarks) text += remark + "\n";
  return text;
}

nlohmann::json report_json(const FragilityReport& report) {
  nlohmann::json json = {{"program_version", VOUSSOIR_VERSION},
                         {"table", report.table},
                         {"runs",
                          {{"done", report.done},
                           {"collapsed", report.collapsed},
                           {"failed", report.failed},
                           {"missing", report.missing}}},
                         {"seed", report.settings.seed},
                         {"curves", nlohmann::json::array()},
                         {"rankings", nlohmann::json::array()},
                         {"damage", nlohmann::json::array()},
                         {"remarks", report.remarks}};
  for (const Fragility& f : report.curves) json["curves"].push_back(curve_json(f));
  for (const IntensityRanking& r : report.intensities) json["rankings"].push_back(ranking_json(r));
  for (const CaseDamage& c : report.damage)
    for (const DamageRanking& r : c.rankings) json["damage"].push_back(damage_json(c.case_name, r));
  return json;
}

std::string report_csv(const FragilityReport& report) {
  std::string text =
      "case,limit,demand,threshold,im,method,theta,ln_theta_std,theta_5,theta_95,beta,beta_std,beta_5,beta_95,runs,"
      "beyond,collapsed,"
      "records\n";
  for (const Fragility& f : report.curves) {
    const Estimate& e = f.chosen;
    const Bootstrap& b = f.bootstrap;
    text += fmt::format("{},{},{},{},{},{}", csv_cell(f.case_name), csv_cell(f.limit.name), csv_cell(f.limit.demand),
                        f.limit.demand == collapse_demand ? std::string() : csv_number(f.limit.threshold),
                        csv_cell(f.im), e.identified == Identified::yes ? method_name(e) : std::string("none"));
    for (double v : {e.theta, e.ln_theta_std, b.theta.low, b.theta.high, e.beta, e.beta_std, b.beta.low, b.beta.high})
      text += fmt::format(",{}", csv_number(v));
    text += fmt::format(",{},{},{},{}\n", f.selection.trials.size(), f.selection.beyond, f.selection.collapsed,
                        f.selection.records.size());
  }
  return text;
}

}  // namespace voussoir
