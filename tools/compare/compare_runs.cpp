// Comparison of runs: keys in which the cases differ, numbers, damage by parts, histories, pictures with the same
// scale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "io/case/flat_case.h"
#include "io/vtk/series.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/compare/compare.h"
#include "tools/run/part_damage.h"
#include "tools/run/run_files.h"
#include "tools/run/steps_report.h"
#include "viz/page/html.h"
#include "viz/page/line_chart.h"
#include "viz/render.h"

namespace voussoir {

namespace {

using nlohmann::json;
using Runs = std::vector<RunFiles>;

/// Rows of the table, in the order in which they first occur in a run.
class Rows {
 public:
  explicit Rows(std::size_t runs) : runs_(runs) {}
  void set(std::size_t run, const std::string& what, const std::string& unit, double value) {
    if (!std::isfinite(value)) return;
    const auto [at, fresh] = places_.try_emplace(what, all_.size());
    if (fresh) all_.push_back({what, unit, std::vector<double>(runs_, NAN)});
    all_[at->second].values[run] = value;
  }
  std::vector<ComparedRow> take() { return std::move(all_); }

 private:
  std::size_t runs_;
  std::map<std::string, std::size_t> places_;
  std::vector<ComparedRow> all_;
};

void add_answers(Rows& rows, std::size_t i, const RunFiles& run) {
  if (run.summary.contains("collapse"))
    rows.set(i, "collapse: largest multiplier with an equilibrium", "", run.of("collapse").value("multiplier", NAN));
  for (const json& one : run.summary.value("quasi_static", json::array())) {
    const std::string of = fmt::format("stage {}: ", one.value("stage", 0));
    rows.set(i, of + "largest force", "kN", 1e-3 * one.value("largest_force", NAN));
    rows.set(i, of + "share of the path with an equilibrium", "", one.value("share", NAN));
    rows.set(i, of + "displacement at its end", "mm", 1e3 * one.value("displacement", NAN));
  }
  if (run.summary.contains("fallen")) rows.set(i, "time of the fall", "s", run.of("fallen").value("time", NAN));
  const json& demand = run.of("demand");
  for (const auto& [kind, words] :
       {std::pair{"keystone_x", "keystones along"}, std::pair{"spandrel_y", "spandrel walls across"}})
    if (demand.contains(kind)) {
      rows.set(i, fmt::format("{}, largest, mean", words), "mm", 1e3 * demand[kind].value("largest_mean", NAN));
      rows.set(i, fmt::format("{}, at the end, mean", words), "mm", 1e3 * demand[kind].value("residual_mean", NAN));
    }
}

/// Adds the damage of the masonry and, separately, of joints with soil or loose infill.
void add_damage(Rows& rows, std::size_t i, const RunFiles& run) {
  double opening[2] = {NAN, NAN}, slip[2] = {NAN, NAN};
  for (const json& part : run.summary.value("part_damage", json::array())) {
    const std::size_t k = part.value("fill", false) ? 1 : 0;
    opening[k] = std::fmax(opening[k], 1e3 * part.value("largest_opening", 0.0));
    slip[k] = std::fmax(slip[k], 1e3 * part.value("largest_slip", 0.0));
  }
  rows.set(i, "largest opening of masonry", "mm", opening[0]);
  rows.set(i, "largest slip of masonry", "mm", slip[0]);
  rows.set(i, "largest opening of joints with soil or infill", "mm", opening[1]);
  const json& damage = run.of("damage");
  for (const auto& [family, entry] : damage.items())
    if (entry.value("bonded", false))
      rows.set(i, "bond lost: " + family, "%", 100.0 * entry.value("broken_share", NAN));
  const json& fill = run.of("fill");
  if (fill.empty()) return;
  rows.set(i, "fill: yielded in shear", "%", 100.0 * fill.value("yielded_in_shear", NAN));
  rows.set(i, "fill: largest displacement", "mm", 1e3 * fill.value("largest_displacement", NAN));
}

void add_rest(Rows& rows, std::size_t i, const RunFiles& run) {
  const json& ties = run.of("ties");
  if (ties.contains("count")) {
    rows.set(i, "ties that have yielded", "", ties.value("have_yielded", 0));
    rows.set(i, "largest force of a tie", "kN", 1e-3 * ties.value("largest_force", NAN));
  }
  if (run.ends_at_rest()) {
    const json &places = run.of("places"), &reactions = run.of("reactions");
    for (const auto& [name, place] : places.items()) rows.set(i, name + ", down", "mm", -1e3 * place.value("z", NAN));
    for (const auto& [group, axes] : reactions.items())
      rows.set(i, "vertical reaction of " + group, "kN", 1e-3 * axes.value("z", json::object()).value("last", NAN));
  }
  const json gravity = run.summary.value("gravity", json::array());
  if (!gravity.empty())
    for (const json& mode : gravity.back().value("periods", json::array())) {
      const std::string motion = mode.value("motion", std::string());
      rows.set(i, "period, intact: " + motion, "s", mode.value("intact", NAN));
      if (mode["now"].is_number()) rows.set(i, "period under gravity: " + motion, "s", mode["now"].get<double>());
    }
  const json weight = run.of("inventory").value("weight", json::object());
  rows.set(i, "weight of what is free to move", "kN", 1e-3 * (weight.value("stones", NAN) + weight.value("fill", NAN)));
}

std::vector<ComparedRow> number_rows(const Runs& runs) {
  Rows rows(runs.size());
  for (const auto& add : {add_answers, add_damage, add_rest})
    for (std::size_t i = 0; i < runs.size(); ++i) add(rows, i, runs[i]);
  return rows.take();
}

/// A table of the keys in which the cases differ.
std::string case_differences(const Runs& runs, const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::string>> values;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const auto& [key, value] : flat_case(runs[i].c.text, runs[i].directory + "/case.toml"))
      values.try_emplace(key, runs.size()).first->second[i] = value;
  std::string text;
  for (const auto& [key, of] : values) {
    if (std::ranges::all_of(of, [&of = of](const std::string& v) { return v == of.front(); })) continue;
    std::vector<Cell> cells = {words_cell(key)};
    for (const std::string& value : of) cells.push_back(words_cell(value.empty() ? "–" : shortened(value, 60)));
    text += table_row(cells, "td");
  }
  if (text.empty()) return heading("The cases") + paragraph("All cases have the same keys and values.");
  std::vector<Cell> head = {words_cell("key")};
  for (const std::string& name : names) head.push_back(words_cell(name));
  return heading("Keys in which the cases differ") + "<table>\n" + table_row(head, "th") + text + "</table>\n";
}

/// A table of the largest openings by parts of the bridge, the widest first.
std::string part_table(const Runs& runs, const std::vector<std::string>& names) {
  constexpr std::size_t most = 25;
  std::map<std::string, ComparedRow> parts;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const json& part : runs[i].summary.value("part_damage", json::array()))
      parts.try_emplace(part_words(part), ComparedRow{part_words(part), "mm", std::vector<double>(runs.size(), NAN)})
          .first->second.values[i] = 1e3 * part.value("largest_opening", NAN);
  std::vector<ComparedRow> rows;
  for (auto& [name, row] : parts) rows.push_back(row);
  const auto widest = [](const ComparedRow& row) {
    double w = 0.0;
    for (const double v : row.values) w = std::fmax(w, v);
    return w;
  };
  std::erase_if(rows, [&](const ComparedRow& row) { return widest(row) < 0.01; });
  std::ranges::stable_sort(rows, [&](const auto& a, const auto& b) { return widest(a) > widest(b); });
  if (rows.empty()) return "";
  const std::size_t left_out = rows.size() > most ? rows.size() - most : 0;
  rows.resize(std::min(rows.size(), most));
  return heading("Largest openings by parts of the bridge") + difference_table(names, rows) +
         (left_out ? note(fmt::format("{}.", counted(left_out, "more part has a smaller opening",
                                                     "more parts have smaller openings")))
                   : std::string());
}

LineChart history_chart(const std::string& title, const std::string& x, const std::string& y) {
  return {.title = title, .x_label = x, .y_label = y, .width = 760.0, .height = 300.0};
}

/// A chart of one channel with a curve for each run.
std::string channel_chart(const Runs& runs, const std::vector<std::string>& names, const std::string& channel) {
  LineChart chart = history_chart(channel.substr(channel.find('/') + 1), "Time, s", "Displacement, mm");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].history.has(channel)) continue;
    ChartCurve curve{.name = names[i], .x = runs[i].history.time(), .y = runs[i].history.values(channel), .width = 1.2};
    for (double& v : curve.y) v *= 1e3;
    chart.curves.push_back(std::move(curve));
  }
  number_curves(chart);
  return figure(line_chart(chart));
}

/// The `count` channels with the largest displacements in any run, among those whose path begins and ends as given.
std::vector<std::string> largest_channels(const Runs& runs, const std::string& begin, const std::string& end,
                                          std::size_t count) {
  std::map<std::string, double> sizes;
  for (const RunFiles& run : runs)
    for (const Channel& channel : run.history.channels())
      if (channel.path.starts_with(begin) && channel.path.ends_with(end))
        for (const double u : run.history.values(channel.path)) {
          double& size = sizes[channel.path];
          size = std::max(size, std::abs(u));
        }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [path, size] : sizes)
    if (size > 1e-6) order.emplace_back(-size, path);
  std::ranges::sort(order);
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) paths.push_back(order[k].second);
  return paths;
}

std::string histories(const Runs& runs, const std::vector<std::string>& names) {
  if (std::ranges::none_of(runs, [](const RunFiles& run) {
        return run.history.rows() > 2 && run.history.time().back() > run.history.time().front();
      }))
    return "";
  std::string text;
  for (const auto& [begin, end] :
       {std::pair{"demand/keystone", " x"}, std::pair{"demand/spandrel", " y"}, std::pair{"sensors/", "/displacement"}})
    for (const std::string& channel : largest_channels(runs, begin, end, 3))
      text += channel_chart(runs, names, channel);
  return text.empty() ? "" : heading("Histories of the largest displacements") + text;
}

/// A chart with the curves of the same chart of each run. The name of the run is put before the name of the curve.
std::string charts_over(const Runs& runs, const std::vector<std::string>& names,
                        const std::function<LineChart(const RunFiles&)>& chart_of) {
  LineChart all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const LineChart one = chart_of(runs[i]);
    if (one.curves.empty()) continue;
    if (all.curves.empty()) all = history_chart(one.title, one.x_label, one.y_label);
    for (ChartCurve curve : one.curves) {
      curve.name = curve.name.empty() ? names[i] : names[i] + ": " + curve.name;
      all.curves.push_back(std::move(curve));
    }
  }
  number_curves(all);
  return figure(line_chart(all));
}

LineChart collapse_chart(const RunFiles& run) {
  LineChart chart =
      history_chart("Load and displacement of the loaded points", "Displacement along the load, mm", "Multiplier");
  ChartCurve curve;
  for (const json& p : run.of("collapse").value("curve", json::array()))
    curve.x.push_back(1e3 * p.value("along", NAN)), curve.y.push_back(p.value("multiplier", NAN));
  curve.dots = true;
  if (curve.x.size() > 1) chart.curves.push_back(curve);
  return chart;
}

std::string curves(const Runs& runs, const std::vector<std::string>& names) {
  std::string text = charts_over(runs, names, collapse_chart);
  for (const auto& chart : {capacity_chart, deck_chart})
    text += charts_over(runs, names, [&](const RunFiles& run) { return chart(run.stages(), run.history); });
  return text.empty() ? "" : heading("Loads and displacements") + text;
}

/// Pictures of the last stored frame of each run, with the same colour scale.
std::string pictures(const CompareRequest& request, const Runs& runs, const std::vector<std::string>& names) {
  std::vector<PictureFiles> frames;
  for (const RunFiles& run : runs) {
    const VtkSeries series(run.directory);
    if (series.blocks().frames().empty()) return note(run.name + " has no stored frame, so there are no pictures.");
    const auto& last = series.blocks().frames().back();
    frames.push_back(
        {series.blocks().file_path(last), series.joints().file_at(last.time), series.fill().file_at(last.time)});
  }
  std::vector<PagePicture> all;
  for (const char* colour : {"opening", "slip"})
    for (const char* view : {"oblique", "front"}) {
      RenderOptions options;
      options.colour = colour, options.view = view;
      for (const PictureFiles& frame : frames) options.range = std::max(options.range, picture_scale(frame, options));
      for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string png = fmt::format("{}/images/{}_{}_{}.png", request.directory, colour, view, i + 1);
        options.title = names[i];
        render_picture(frames[i], options, png);
        all.push_back(
            {fmt::format("{}: {}, {}", names[i], std::string(colour) == "slip" ? "joints slid" : "joints opened", view),
             "largest since the start; all pictures have the same scale", png});
      }
    }
  return pictures_section(all, "Pictures with the same scale");
}

}  // namespace

Comparison compare_runs(const CompareRequest& request, const std::vector<std::string>& names) {
  Runs runs;
  for (const std::string& directory : request.from) runs.push_back(read_run(directory));
  Comparison c;
  c.title = "Comparison of runs";
  c.rows = number_rows(runs);
  c.html = case_differences(runs, names) + heading("Numbers") + difference_table(names, c.rows) +
           part_table(runs, names) + curves(runs, names) + histories(runs, names) +
           (request.pictures ? pictures(request, runs, names) : "");
  return c;
}

}  // namespace voussoir
