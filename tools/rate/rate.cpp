#include "tools/rate/rate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/base/timed.h"
#include "tools/rate/rate_report.h"

namespace voussoir {

namespace {

/// Range of the loads of a vehicle in its own frame, m.
std::pair<double, double> reach(const Vehicle& vehicle) {
  std::pair<double, double> reach = {1e300, -1e300};
  const auto take = [&](double from, double to) {
    if (std::isfinite(from)) reach.first = std::min(reach.first, from);
    if (std::isfinite(to)) reach.second = std::max(reach.second, to);
  };
  for (const LoadPatch& p : vehicle.patches) take(p.x, p.x);
  if (vehicle.patches.empty())
    for (const LoadStrip& s : vehicle.strips) take(s.from, s.to);
  return reach.first > reach.second ? std::pair(0.0, 0.0) : reach;
}

/// Whether each member of one list has its equal in the other; the order does not matter.
template <class T>
bool same_members(const std::vector<T>& one, const std::vector<T>& other, const auto& numbers) {
  const auto equal = [&](const T& a, const T& b) {
    const auto p = numbers(a), q = numbers(b);
    return std::ranges::equal(p, q, [](double x, double y) {
      if (!std::isfinite(x) || !std::isfinite(y)) return x == y;  // the ends of an unlimited strip
      return std::abs(x - y) <= 1e-9 * std::max({1.0, std::abs(x), std::abs(y)});
    });
  };
  const auto in = [&](const std::vector<T>& list) {
    return [&](const T& a) { return std::ranges::any_of(list, [&](const T& b) { return equal(a, b); }); };
  };
  return one.size() == other.size() && std::ranges::all_of(one, in(other)) && std::ranges::all_of(other, in(one));
}

/// Whether the vehicle is its own mirror image, so that it need not be rated in both directions.
bool same_both_ways(const Vehicle& vehicle) {
  const Vehicle other = turned(vehicle);
  return same_members(vehicle.axles, other.axles,
                      [](const VehicleAxle& a) {
                        return std::array{a.x, a.load};
                      }) &&
         same_members(vehicle.patches, other.patches,
                      [](const LoadPatch& p) {
                        return std::array{p.x, p.y, p.length, p.width, p.force};
                      }) &&
         same_members(vehicle.strips, other.strips, [](const LoadStrip& s) {
           return std::array{s.from, s.to, s.y, s.width, s.pressure};
         });
}

StageSettings collapse_stage(const RateRequest& request, const Case& c, const RatedPlace& at) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::collapse;
  stage.label = "collapse";
  stage.loads = Loads{};
  stage.loads->road = vehicle_loads(request, c, at.vehicle, at.place);
  stage.collapse.to = request.most;
  stage.collapse.tolerance = request.tolerance;
  stage.collapse.confirm = 0.0;
  return stage;
}

/// The bridge after its stages.
struct AtRest {
  SolverSettings settings;
  State state;
  RunPosition position;
};

/// Nothing if it was stopped.
std::optional<AtRest> bring_to_rest(const Case& c, const Assembly& assembly, int threads,
                                    const RateObservers& observers) {
  AtRest rest;
  rest.settings = before_vehicles(c).settings;
  rest.settings.output.fields_every = 0.0;
  Observers own;
  own.progress = observers.progress, own.stop = observers.stop;
  Simulation run(assembly, rest.settings, threads, own);
  const RunEnd end = run.run();
  if (end == RunEnd::interrupted) return std::nullopt;
  if (end == RunEnd::failed) throw RunError("{}: {}", c.path, run.failure());
  rest.state = run.state(), rest.position = run.position();
  return rest;
}

void note_loss(const Assembly& assembly, const Collapse& collapse, RatedPlace& at) {
  at.found = collapse.found;
  at.factor = collapse.multiplier, at.above = collapse.above;
  at.tries = collapse.tries.size();
  if (!collapse.found) return;
  at.local = collapse.loss.local;
  at.share = collapse.loss.share;
  at.fill_alone = collapse.loss.fill && collapse.loss.blocks.empty();
  at.moving = moving_part(assembly, collapse.loss);
  for (const std::int64_t block : collapse.loss.blocks) {
    const Block& b = assembly.blocks[std::size_t(block)];
    if (b.component == Component::arch) at.spans.push_back(b.part);
  }
  std::sort(at.spans.begin(), at.spans.end());
  at.spans.erase(std::unique(at.spans.begin(), at.spans.end()), at.spans.end());
}

bool is_worse(const RatedPlace& a, const RatedPlace& b) {
  if (a.found != b.found) return a.found;
  return a.factor < b.factor;
}

/// Index of the worst place of a vehicle; the first of equal places.
std::size_t worst_of(const std::vector<RatedPlace>& places, std::size_t vehicle) {
  std::size_t worst = places.size();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].vehicle == vehicle && (worst == places.size() || is_worse(places[i], places[worst]))) worst = i;
  return worst;
}

class Sweep {
 public:
  Sweep(const Case& c, const Assembly& assembly, const RateRequest& request, const RateObservers& observers,
        const AtRest& rest, std::size_t planned)
      : case_(c), assembly_(assembly), request_(request), observers_(observers), rest_(rest), planned_(planned) {}

  /// False if it was stopped.
  bool run(std::vector<RatedPlace> places) {
    std::vector<char> complete(places.size(), 0);
    for_all(places.size(), request_.threads, [&](std::size_t i) {
      if (stopped() || !one(places[i])) return;
      complete[i] = 1;
      const std::lock_guard<std::mutex> lock(heard_);
      ++done_;
      if (observers_.rated) observers_.rated(places[i], done_, planned_);
    });
    for (std::size_t i = 0; i < places.size(); ++i)
      if (complete[i]) all.push_back(std::move(places[i]));
    return !stopped();
  }

  std::vector<RatedPlace> all;  // the complete ones

 private:
  bool stopped() const { return observers_.stop && observers_.stop->load(); }

  /// False if it was stopped.
  bool one(RatedPlace& at) const {
    if (observers_.recall && observers_.recall(at)) return true;
    const Timed timed(at.seconds);
    SolverSettings settings = rest_.settings;
    settings.stages.push_back(collapse_stage(request_, case_, at));
    Observers own;
    own.stop = observers_.stop;
    Simulation run(assembly_, settings, 1, own);
    run.state() = rest_.state;
    run.restore(rest_.position);
    const RunEnd end = run.run();
    if (end == RunEnd::failed) throw RunError("{}", run.failure());
    if (end == RunEnd::finished) note_loss(assembly_, run.collapse(), at);
    return end == RunEnd::finished;
  }

  const Case& case_;
  const Assembly& assembly_;
  const RateRequest& request_;
  const RateObservers& observers_;
  const AtRest& rest_;
  std::size_t planned_;
  std::mutex heard_;
  std::size_t done_ = 0;
};

}  // namespace

Case before_vehicles(const Case& c) {
  Case before = c;
  std::vector<StageSettings>& stages = before.settings.stages;
  if (!stages.empty() && stages.back().kind == StageSettings::Kind::collapse) {
    stages.pop_back();
    before.motions.pop_back();
  }
  if (stages.empty())
    throw InputError("{} has no stage that brings the bridge to rest. Add a gravity stage at the beginning", c.path);
  return before;
}

std::vector<RoadLoad> vehicle_loads(const RateRequest& request, const Case& c, std::size_t vehicle,
                                    const VehiclePlace& place) {
  const Vehicle& v = request.vehicles[vehicle];
  if (!request.effective_width) return loads_of(v, place);
  return loads_on_strip(v, place, c.generator_input("strip_width"), *request.effective_width);
}

std::size_t worst_of_all(const Rating& rating) {
  std::size_t worst = rating.worst.front();
  for (const std::size_t index : rating.worst)
    if (is_worse(rating.places[index], rating.places[worst])) worst = index;
  return worst;
}

std::vector<SpanExtent> span_extents(const Assembly& assembly) {
  std::map<std::int32_t, SpanExtent> found;
  for (const Block& block : assembly.blocks) {
    if (block.component != Component::arch) continue;
    const Box box = block_box(block);
    SpanExtent& span = found.try_emplace(block.part, SpanExtent{block.part, 1e300, -1e300}).first->second;
    span.x0 = std::min(span.x0, box.low.x()), span.x1 = std::max(span.x1, box.high.x());
  }
  std::vector<SpanExtent> spans;
  for (const auto& [part, span] : found) spans.push_back(span);
  if (spans.empty())
    throw InputError(
        "there is no vault to load, because no block of the assembly has the component arch. Set this component at the "
        "import");
  std::sort(spans.begin(), spans.end(), [](const SpanExtent& a, const SpanExtent& b) { return a.x0 < b.x0; });
  return spans;
}

std::vector<double> fronts(const Vehicle& vehicle, const std::vector<SpanExtent>& spans, bool towards_right,
                           double step) {
  const auto [first, last] = reach(vehicle);
  const double low = spans.front().x0 + (towards_right ? first : -last);
  const double high = spans.back().x1 + (towards_right ? last : -first);
  const auto count = std::max<std::int64_t>(1, std::llround((high - low) / step));
  std::vector<double> at;
  for (std::int64_t i = 1; i < count; ++i) at.push_back(low + (high - low) * double(i) / double(count));
  if (at.empty()) at.push_back(0.5 * (low + high));
  return at;
}

namespace {

/// Places of the vehicles of a request, `step` m apart.
std::vector<RatedPlace> places_of(const RateRequest& request, const std::vector<SpanExtent>& spans, double step) {
  std::vector<RatedPlace> places;
  for (std::size_t v = 0; v < request.vehicles.size(); ++v)
    for (const double lane : request.lanes)
      for (const bool right : {true, false}) {
        if (!right && (!request.both_ways || same_both_ways(request.vehicles[v]))) continue;
        for (const double x : fronts(request.vehicles[v], spans, right, step)) {
          RatedPlace at;
          at.vehicle = v;
          at.place = {x, lane, right};
          const double middle = middle_of(request.vehicles[v], at.place);
          if (middle >= request.from && middle <= request.to) places.push_back(at);
        }
      }
  for (std::size_t v = 0; v < request.vehicles.size(); ++v)
    if (std::none_of(places.begin(), places.end(), [v](const RatedPlace& at) { return at.vehicle == v; }))
      throw InputError(
          "--from and --to leave no position for {}. The vaults extend from x = {:.2f} to {:.2f} m, and the positions "
          "are {:.2f} m apart. Widen the range, or give a smaller --step",
          request.vehicles[v].name, spans.front().x0, spans.back().x1, step);
  return places;
}

/// Two places for each vehicle, at this distance on both sides of its worst place.
std::vector<RatedPlace> about_the_worst(const std::vector<RatedPlace>& places, const RateRequest& request,
                                        double distance) {
  std::vector<RatedPlace> nearer;
  for (std::size_t v = 0; v < request.vehicles.size(); ++v)
    for (const double side : {-1.0, 1.0}) {
      RatedPlace at;
      at.vehicle = v, at.place = places[worst_of(places, v)].place;
      at.place.x += side * distance;
      nearer.push_back(at);
    }
  return nearer;
}

}  // namespace

Rating rate(const Case& c, const Assembly& assembly, const RateRequest& request, const RateObservers& observers) {
  Rating rating;
  rating.spans = span_extents(assembly);
  double step = request.step;
  if (step <= 0.0) {
    step = 1e300;
    for (const SpanExtent& span : rating.spans) step = std::min(step, 0.1 * (span.x1 - span.x0));
  }
  const std::vector<RatedPlace> places = places_of(request, rating.spans, step);
  rating.planned = places.size() + 2 * request.vehicles.size() * std::size_t(request.refinements);
  if (observers.begins) observers.begins(rating.planned);
  const std::optional<AtRest> rest = bring_to_rest(c, assembly, request.threads, observers);
  if (!rest) return rating;
  Sweep sweep(c, assembly, request, observers, *rest, rating.planned);
  bool goes_on = sweep.run(places);
  for (int round = 1; round <= request.refinements && goes_on; ++round)
    goes_on = sweep.run(about_the_worst(sweep.all, request, step * std::pow(0.5, round)));
  rating.places = std::move(sweep.all);
  std::stable_sort(rating.places.begin(), rating.places.end(), [](const RatedPlace& a, const RatedPlace& b) {
    return std::tuple(a.vehicle, a.place.y, !a.place.towards_right, a.place.x) <
           std::tuple(b.vehicle, b.place.y, !b.place.towards_right, b.place.x);
  });
  for (std::size_t v = 0; v < request.vehicles.size(); ++v)
    if (const std::size_t worst = worst_of(rating.places, v); worst < rating.places.size())
      rating.worst.push_back(worst);
  return rating;
}

Case with_vehicle(const Case& c, const RateRequest& request, const RatedPlace& at, bool to_collapse) {
  Case more = before_vehicles(c);
  std::vector<StageSettings>& stages = more.settings.stages;
  StageSettings stage = collapse_stage(request, c, at);
  if (to_collapse) {
    stage.collapse.confirm = CollapseSettings{}.confirm;
    if (at.found) stage.collapse.to = std::min(request.most, 1.3 * at.above);
    stage.collapse.tolerance = std::min(request.tolerance, 0.25 * stage.collapse.to);
  } else {
    stage.kind = StageSettings::Kind::gravity;
    stage.label = "vehicle";
    Loads all = loads_after(stages, stages.size());
    all.road.insert(all.road.end(), stage.loads->road.begin(), stage.loads->road.end());
    stage.loads = all;
    stage.collapse = {};
  }
  stages.push_back(stage);
  more.motions.emplace_back();
  more.text = resolved_text(more);
  return more;
}

}  // namespace voussoir
