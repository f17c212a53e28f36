// Rating of a bridge for vehicles: the collapse multiplier of their loads at one place after the other.
#pragma once
#include <functional>
#include <optional>

#include "io/case/case.h"
#include "io/traffic/place_vehicle.h"
#include "solver/run/simulation.h"
#include "solver/statics/collapse.h"

namespace voussoir {

/// A vault: the range of its stones along the road, m.
struct SpanExtent {
  std::int32_t part = 0;  // of Component::arch
  double x0 = 0.0, x1 = 0.0;
};

struct RateRequest {
  std::vector<Vehicle> vehicles;          // their loads include the factors to be applied
  std::vector<double> lanes = {0.0};      // m, y of the middle lines of the lanes
  bool both_ways = true;                  // also the reverse direction, for unsymmetric vehicles
  double step = 0.0;                      // m, distance between places; 0: a tenth of the shortest span
  double from = -1e300, to = 1e300;       // m; places with the middle of the axles between these x, before refinement
  int refinements = 2;                    // number of refinements about the worst place, each with half the distance
  double most = 30.0;                     // upper limit of the factors that are tried
  double tolerance = 0.05;                // tolerance of the factor
  std::optional<double> effective_width;  // m, of a strip in plane strain; none: the whole bridge
  int threads = 1;
};

/// A vehicle at one place.
struct RatedPlace {
  std::size_t vehicle = 0;  // index into the vehicles of the request
  VehiclePlace place;
  bool found = false;               // the bridge collapsed below RateRequest::most
  double factor = 0.0;              // largest factor with equilibrium
  double above = 0.0;               // smallest factor tried without equilibrium; only if found
  bool local = false;               // CollapseLoss::local
  bool fill_alone = false;          // no stone moves
  std::vector<std::int32_t> spans;  // spans whose vaults move
  double share = 0.0;               // moving share of the movable mass
  std::string moving;               // description of the moving parts
  std::size_t tries = 0;
  double seconds = 0.0;
};

struct Rating {
  std::vector<SpanExtent> spans;
  std::vector<RatedPlace> places;  // by vehicle, lane, direction and x
  std::vector<std::size_t> worst;  // for each vehicle with a place: index into places
  std::size_t planned = 0;         // number of places of a complete rating

  bool complete() const { return places.size() == planned; }
};

/// Functions that rate() calls, and its stop flag. Each may be empty.
struct RateObservers {
  std::function<void(std::size_t planned)> begins;                                      // number of all places
  std::function<void(const Progress&)> progress;                                        // of the stages of the case
  std::function<void(const RatedPlace&, std::size_t done, std::size_t planned)> rated;  // after each place
  std::function<bool(RatedPlace&)> recall;  // fills in a result that is known already; false if it is not
  const std::atomic<bool>* stop = nullptr;  // set by a signal: the rating ends with the places that are complete
};

/// The case without a last collapse stage. Throws InputError if no stage remains.
Case before_vehicles(const Case& c);
/// The loads of a vehicle of the request on the road of the bridge, or on its strip.
std::vector<RoadLoad> vehicle_loads(const RateRequest& request, const Case& c, std::size_t vehicle,
                                    const VehiclePlace& place);

/// Index into places of the worst place of all vehicles. There must be at least one place.
std::size_t worst_of_all(const Rating& rating);

/// All vaults (blocks of the component arch), from left to right. Throws InputError if there is none.
std::vector<SpanExtent> span_extents(const Assembly& assembly);

/// Positions of the front of a vehicle with any of its axles between the first and the last vault, about `step` m
/// apart.
std::vector<double> fronts(const Vehicle& vehicle, const std::vector<SpanExtent>& spans, bool towards_right,
                           double step);

/// Rates the case. Its stages, without a last collapse stage, run once; each place starts from their end. A rating that
/// was stopped has no refined places, or not all; it may have no place at all. Throws InputError and RunError.
Rating rate(const Case& c, const Assembly& assembly, const RateRequest& request, const RateObservers& observers);

/// The case with an additional stage: the loads of a vehicle at a place, raised to collapse or applied in full.
Case with_vehicle(const Case& c, const RateRequest& request, const RatedPlace& at, bool to_collapse);

}  // namespace voussoir
