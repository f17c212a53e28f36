#include "tools/rate/passages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/run/simulation.h"
#include "solver/step/make_snapshot.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

AfterPassage look_at(const Simulation& run, const Snapshot& begun) {
  const Snapshot now = make_snapshot(run.model(), run.state());
  AfterPassage after;
  double area = 0.0;
  for (const PatchSnapshot& patch : now.patches) {
    if (patch.tie || patch.replaced) continue;
    after.opening = std::max(after.opening, patch.opening);
    after.slip = std::max(after.slip, patch.slip);
    after.slips += patch.area * patch.slip, area += patch.area;
  }
  if (area > 0.0) after.slips /= area;
  for (std::size_t i = 0; i < now.displacement.size(); ++i)
    if (!run.assembly().blocks[i].fixed)
      after.largest = std::max(after.largest, (now.displacement[i] - begun.displacement[i]).norm());
  for (const auto& [name, blocks] : run.assembly().groups)
    if (name.starts_with("keystone "))
      for (const std::int64_t block : blocks) {
        const auto i = std::size_t(block);
        const double down = begun.displacement[i].z() - now.displacement[i].z();
        if (std::abs(down) > std::abs(after.crown)) after.crown = down;
      }
  for (const TetSnapshot& tet : now.fill.tets) after.plastic += tet.plastic_shear;
  if (!now.fill.tets.empty()) after.plastic /= double(now.fill.tets.size());
  return after;
}

StageSettings standing(const std::vector<RoadLoad>& loads, const Loads& before) {
  StageSettings stage;
  stage.label = "passage";
  stage.allow_motion = true;
  stage.loads = before;
  stage.loads->road.insert(stage.loads->road.end(), loads.begin(), loads.end());
  return stage;
}

/// The stages of the case that bring it to rest, and the stages of all passages.
std::vector<StageSettings> all_stages(const Case& c, const std::vector<SpanExtent>& spans,
                                      const PassageRequest& request, double factor, std::size_t& first) {
  std::vector<StageSettings> stages = before_vehicles(c).settings.stages;
  first = stages.size();
  const Loads before = loads_after(stages, first - 1);
  const std::vector<double> fronts = fronts_of_passage(spans, request);
  for (int n = 0; n < request.passages; ++n) {
    for (const double front : fronts) {
      const VehiclePlace place = {front, request.rate.lanes.front(), request.towards_right};
      std::vector<RoadLoad> loads = vehicle_loads(request.rate, c, 0, place);
      for (RoadLoad& load : loads) load.pressure *= factor;
      stages.push_back(standing(loads, before));
    }
    stages.push_back(standing({}, before));
  }
  return stages;
}

PassageSeries series_of(const Case& c, const Assembly& assembly, const std::vector<SpanExtent>& spans,
                        const PassageRequest& request, double factor) {
  PassageSeries series;
  series.factor = factor;
  SolverSettings settings = c.settings;
  std::size_t first = 0;
  settings.stages = all_stages(c, spans, request, factor, first);
  settings.output.fields_every = 0.0;
  Snapshot begun;
  Observers observers;
  observers.stop = request.stop;
  observers.ended = [&](const Simulation& run, std::int64_t stage) {
    if (std::size_t(stage) + 1 == first) {
      begun = make_snapshot(run.model(), run.state());
      series.after.push_back(look_at(run, begun));
    }
    const std::ptrdiff_t since = stage - std::ptrdiff_t(first);
    if (since >= 0 && since % (request.places + 1) == request.places) series.after.push_back(look_at(run, begun));
  };
  Simulation run(assembly, settings, 1, observers);
  const RunEnd end = run.run();
  if (end == RunEnd::failed && series.after.empty()) throw RunError("{}: {}", c.path, run.failure());
  series.end = end == RunEnd::failed ? PassageEnd::collapses : judge(series.after, request.settled);
  return series;
}

/// "settles"; "collapses in passage 3".
std::string end_of(const PassageSeries& series) {
  std::string text = passage_word(series.end);
  if (series.end == PassageEnd::collapses) text += fmt::format(" in passage {}", series.after.size());
  return text;
}

}  // namespace

const char* passage_word(PassageEnd end) {
  static constexpr const char* words[] = {"settles", "grows", "collapses", "undecided"};
  return words[std::size_t(end)];
}

/// The end state of the increments d(n) of the largest displacement in passage n. They settle if the last is below
/// `settled`, or if those of the last third are at most half of those of the third before. They grow if they are at
/// least nine tenths of them.
PassageEnd judge(const std::vector<AfterPassage>& after, double settled) {
  const std::size_t passages = after.empty() ? 0 : after.size() - 1;
  if (passages < 3) return PassageEnd::undecided;
  const std::size_t third = passages / 3;
  const auto grown = [&](std::size_t from, std::size_t to) {
    return std::max(std::abs(after[to].largest - after[from].largest), std::abs(after[to].slips - after[from].slips)) /
           double(to - from);
  };
  const double before = grown(passages - 2 * third, passages - third), last = grown(passages - third, passages);
  if (last <= settled || last <= 0.5 * before) return PassageEnd::settles;
  return last >= 0.9 * before ? PassageEnd::grows : PassageEnd::undecided;
}

std::vector<double> fronts_of_passage(const std::vector<SpanExtent>& spans, const PassageRequest& request) {
  std::vector<double> way = fronts(request.rate.vehicles.front(), spans, request.towards_right, 1e-3);
  if (!request.towards_right) std::ranges::reverse(way);
  std::vector<double> at;
  for (int k = 0; k < request.places; ++k)
    at.push_back(way.front() + (k + 0.5) / request.places * (way.back() - way.front()));
  return at;
}

std::vector<PassageSeries> passages(const Case& c, const Assembly& assembly, const PassageRequest& request,
                                    const std::function<void(const std::string&)>& say) {
  const std::vector<SpanExtent> spans = span_extents(assembly);
  const auto stopped = [&] { return request.stop && request.stop->load(); };
  std::vector<PassageSeries> all(request.factors.size());
  for_all(all.size(), request.rate.threads, [&](std::size_t i) {
    if (stopped()) return;
    all[i] = series_of(c, assembly, spans, request, request.factors[i]);
    if (stopped()) return;
    say(fmt::format("passages with factor {:.3g}: {}", all[i].factor, end_of(all[i])));
  });
  if (stopped()) all.clear();
  return all;
}

std::string passages_text(const std::vector<PassageSeries>& all, double adequacy) {
  std::size_t count = 0;
  for (const PassageSeries& series : all)  // the passage in which it collapses counts as well
    count = std::max(count, series.after.size() - (series.end == PassageEnd::collapses ? 0 : 1));
  const auto first =
      std::find_if(all.begin(), all.end(), [](const PassageSeries& s) { return s.end != PassageEnd::settles; });
  std::string text = fmt::format("Over {}, displacements settle with ", counted(count, "passage"));
  if (first == all.begin()) {
    text += "none of the factors";
  } else {
    const double settles = std::prev(first)->factor;
    text += fmt::format("factors up to {:.3g} ({:.0f} % of the adequacy factor)", settles, 100.0 * settles / adequacy);
  }
  if (first != all.end()) text += fmt::format("; with {:.3g} they do not", first->factor);
  return text + fmt::format(
                    ". Half of the adequacy factor, the usual rule, is {:.3g}. Displacements settle when the last "
                    "third of the passages adds at most half as much as the third before. They grow when it adds at "
                    "least nine tenths as much.",
                    0.5 * adequacy);
}

std::string passages_csv(const std::vector<PassageSeries>& all) {
  std::string csv =
      "factor,passage,largest_displacement_m,crown_down_m,opening_m,largest_slip_m,mean_slip_m,fill_plastic_shear,"
      "end\n";
  for (const PassageSeries& series : all)
    for (std::size_t n = 0; n < series.after.size(); ++n) {
      const AfterPassage& a = series.after[n];
      csv += fmt::format("{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n", series.factor, n, a.largest,
                         a.crown, a.opening, a.slip, a.slips, a.plastic, passage_word(series.end));
    }
  return csv;
}

std::string ratchet_chart(const std::vector<PassageSeries>& all) {
  LineChart chart;
  chart.title = "Repeated passages";
  chart.x_label = "passages";
  chart.y_label = "largest displacement since gravity, without the vehicle, mm";
  for (const PassageSeries& series : all) {
    ChartCurve curve;
    curve.name = fmt::format("factor {:.3g}: {}", series.factor, end_of(series));
    curve.dots = true;
    for (std::size_t n = 0; n < series.after.size(); ++n)
      curve.x.push_back(double(n)), curve.y.push_back(1e3 * series.after[n].largest);
    chart.curves.push_back(curve);
  }
  number_curves(chart);
  return line_chart(chart);
}

}  // namespace voussoir
