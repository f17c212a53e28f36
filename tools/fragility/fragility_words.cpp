#include "tools/fragility/fragility_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"

namespace voussoir {

namespace {

constexpr std::size_t few_records = 10;

std::string spaced(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  return text;
}

std::string one_mixed_words(const Estimate& e, const std::string& column) {
  std::string where = std::isnan(e.above)   ? "θ lies above it"
                      : std::isnan(e.below) ? "θ lies below it"
                      : e.below == e.above
                          ? "θ equals it"
                          : fmt::format("θ lies from {:.4g} to {:.4g} {}", e.below, e.above, measure_unit(column));
  return fmt::format(
      "at one intensity only, {}, some runs exceed the limit and others do not ({:.0f} of {:.0f} exceed it): {}, β is "
      "not known. Run intensities slightly below and above",
      with_unit(e.mixed.im, column), e.mixed.beyond, e.mixed.runs, where);
}

/// The smallest and the largest intensity of the runs.
CurveBand im_range(const Fragility& f) {
  CurveBand range = {INFINITY, 0.0};
  for (const CloudRun& t : f.selection.trials)
    range.low = std::min(range.low, t.im), range.high = std::max(range.high, t.im);
  return range;
}

std::string range_text(const CurveBand& band) {
  return fmt::format("{:.3g} to {:.3g}", band.low, band.high);
}

void remark_on_method(const Fragility& f, std::vector<std::string>& remarks) {
  const bool stripes = !f.levels.empty();
  if (stripes && f.chosen.method == Method::cloud)
    remarks.push_back(fmt::format("Counts give no curve ({}). This curve follows from the line through the demands.",
                                  unknown_words(f.other, f.im)));
  if (!stripes && f.chosen.method == Method::counts && f.limit.demand != collapse_demand)
    remarks.push_back(
        fmt::format("The sizes of the demands give no curve ({}). This curve follows from counts of the runs that "
                    "exceed the limit.",
                    unknown_words(f.other, f.im)));
  if (f.chosen.method == Method::cloud && f.selection.beyond == 0)
    remarks.push_back("No run exceeds the limit, so the line is extrapolated to it.");
  if (f.chosen.method == Method::cloud && f.selection.beyond == f.selection.trials.size())
    remarks.push_back("Every run exceeds the limit, so the line is extrapolated to it.");
  if (f.chosen.method == Method::cloud && f.cloud.collapse.identified == Identified::separated)
    remarks.push_back(fmt::format(
        "All runs with collapse have higher intensities than all others: the probability of collapse is a step at {}.",
        with_unit(f.cloud.collapse.theta, f.im)));
  if (f.chosen.method == Method::cloud && f.cloud.curvature_p < 0.05)
    remarks.push_back(
        fmt::format("The demands deviate from a straight line (p = {:.2g}). Compare with the curve by counts.",
                    f.cloud.curvature_p));
  const CurveBand& band = f.bootstrap.theta;
  if (f.other.identified == Identified::yes && std::isfinite(band.low) &&
      (f.other.theta < band.low || f.other.theta > band.high))
    remarks.push_back(fmt::format("The other method ({}) gives θ = {:.3g} and β = {:.2f}, outside this band.",
                                  f.other.method == Method::counts ? "counts" : "line", f.other.theta, f.other.beta));
}

void remark_on_data(const Fragility& f, std::vector<std::string>& remarks) {
  const SelectedRuns& s = f.selection;
  if (const CurveBand range = im_range(f); f.chosen.theta < range.low || f.chosen.theta > range.high)
    remarks.push_back(fmt::format("θ lies outside the range of intensities of the runs, {} {}.", range_text(range),
                                  measure_unit(f.im)));
  if (s.records.size() < s.trials.size() && f.chosen.method == Method::counts)
    remarks.push_back(
        "Records were used more than once. Use the bands, because standard errors assume that all runs are "
        "independent.");
  if (s.records.size() < few_records)
    remarks.push_back(fmt::format("{}: the bands are rough{}.", counted(s.records.size(), "record"),
                                  s.records.size() == 1 ? ", or there is no band" : ""));
  if (20 * f.bootstrap.unidentified > f.bootstrap.replicates)
    remarks.push_back(
        fmt::format("{} of {} resamples determine no curve and are left out, so the bands may be too narrow.",
                    f.bootstrap.unidentified, f.bootstrap.replicates));
  if (s.zero_demands > 0)
    remarks.push_back(
        fmt::format("{}.", counted(s.zero_demands, "run has a demand of 0. It is counted, but the line does not use it",
                                   "runs have a demand of 0. They are counted, but the line does not use them")));
}

}  // namespace

std::string measure_unit(const std::string& column) {
  if (column == "im.pga" || column.starts_with("im.pga_") || column.starts_with("im.sa_")) return "m/s²";
  if (column == "im.pgv" || column == "im.arias" || column == "im.cav") return "m/s";
  if (column == "im.d595" || column == "im.d575") return "s";
  if (column.starts_with("edp.") || column.ends_with(".largest_opening") || column.ends_with(".largest_slip"))
    return "m";
  return "";
}

std::string measure_name(const std::string& column) {
  static const std::vector<std::pair<std::string, std::string>> names = {
      {"im.pga", "PGA"}, {"im.pgv", "PGV"},    {"im.arias", "Arias intensity"},
      {"im.cav", "CAV"}, {"im.d595", "D5–95"}, {"im.d575", "D5–75"}};
  for (const auto& [name, words] : names)
    if (column == name) return words;
  if (column.starts_with("im.sa_")) return fmt::format("Sa({} s)", column.substr(6));
  if (column.starts_with("im.pga_")) return "PGA along " + column.substr(7);
  for (const char* prefix : {"im.", "edp.", "damage."})
    if (column.starts_with(prefix)) return spaced(column.substr(std::string_view(prefix).size()));
  return column;
}

std::string measure_label(const std::string& column) {
  const std::string unit = measure_unit(column);
  return unit.empty() ? measure_name(column) : fmt::format("{}, {}", measure_name(column), unit);
}

std::string with_unit(double value, const std::string& column) {
  const std::string unit = measure_unit(column);
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string limit_words(const LimitState& limit) {
  if (limit.demand == collapse_demand) return "the bridge collapses";
  return fmt::format("{} reaches {}", measure_name(limit.demand), with_unit(limit.threshold, limit.demand));
}

std::string method_name(const Estimate& e) {
  if (e.method == Method::counts) return "counts";
  return std::isnan(e.curve.collapse_theta) ? "cloud" : "cloud with collapse";
}

std::string method_words(const Fragility& f) {
  if (f.chosen.method == Method::counts)
    return f.levels.empty() ? std::string("counts, run by run")
                            : fmt::format("counts at {}", counted(f.levels.size(), "level"));
  return std::isnan(f.chosen.curve.collapse_theta) ? "line through demands"
                                                   : "line through demands, collapses separately";
}

std::string unknown_words(const Estimate& e, const std::string& column) {
  switch (e.identified) {
    case Identified::yes:
      return "";
    case Identified::no_runs:
      return "no run has both an intensity and a result";
    case Identified::none_beyond:
      return fmt::format("no run exceeds the limit: θ lies above the largest intensity, {}; β is not known",
                         with_unit(e.below, column));
    case Identified::all_beyond:
      return fmt::format("every run exceeds the limit: θ lies below the smallest intensity, {}; β is not known",
                         with_unit(e.above, column));
    case Identified::one_level:
      return "all runs have the same intensity, which gives a share but no slope. Run other levels";
    case Identified::separated:
      return fmt::format(
          "no run up to {0:.4g} and every run from {1:.4g} on exceeds the limit: θ lies from {0:.4g} to {1:.4g} {2}, "
          "and β is too small to be determined by these runs. Run intensities in between",
          e.below, e.above, measure_unit(column));
    case Identified::one_mixed:
      return one_mixed_words(e, column);
    case Identified::falling:
      return "the share of runs that exceed the limit does not increase with the intensity, so this measure does not "
             "predict it";
    case Identified::few_demands:
      return fmt::format("fewer than {} runs without collapse have a demand above 0", least_demands);
    case Identified::flat:
      return "the demand does not increase with the intensity";
    case Identified::collapses:
      return "these runs do not determine the intensity at which collapses begin";
  }
  return "";
}

std::vector<std::string> remarks_on(const Fragility& f) {
  std::vector<std::string> remarks;
  if (f.chosen.identified != Identified::yes) {
    if (f.other.identified != Identified::no_runs && f.other.identified != f.chosen.identified)
      remarks.push_back(fmt::format("The other method gives no curve either: {}.", unknown_words(f.other, f.im)));
    return remarks;
  }
  remark_on_method(f, remarks);
  remark_on_data(f, remarks);
  return remarks;
}

std::string left_out_words(const SelectedRuns& s) {
  std::vector<std::string> parts;
  const auto part = [&](std::size_t count, const char* words) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, words));
  };
  part(s.failed, "failed"), part(s.missing, "not run yet"), part(s.no_im, "without the intensity");
  part(s.no_demand, "without the demand");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace voussoir
