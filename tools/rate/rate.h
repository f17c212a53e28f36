// What a bridge bears of vehicles: the collapse multiplier of their loads at one place after the other.
#pragma once
#include <functional>
#include <optional>

#include "io/case/case.h"
#include "io/traffic/place_vehicle.h"
#include "solver/statics/collapse.h"

namespace voussoir {

/// A vault over the road, by what its stones reach from and to, m.
struct SpanExtent {
  std::int32_t part = 0;  // of Component::arch
  double x0 = 0.0, x1 = 0.0;
};

struct RateRequest {
  std::vector<Vehicle> vehicles;          // with the factors that are to act in their loads
  std::vector<double> lanes = {0.0};      // m, y of their middle lines
  bool both_ways = true;                  // of vehicles that are not the same the other way round
  double step = 0.0;                      // m, from place to place; 0: a tenth of the shortest span
  double from = -1e300, to = 1e300;       // m: only places with the middle of the axles between these x
  int refinements = 2;                    // halvings of the step about the worst place
  double most = 30.0;                     // the factor is looked for up to here
  double tolerance = 0.05;                // of the factor
  std::optional<double> effective_width;  // m: of a strip in plane strain; none: the bridge is whole
  int threads = 1;
};

/// A vehicle at one place.
struct RatedPlace {
  std::size_t vehicle = 0;  // of the request
  VehiclePlace place;
  bool found = false;               // the bridge failed below RateRequest::most
  double factor = 0.0;              // the largest at which equilibrium was found
  double above = 0.0;               // the least tried at which it was lost; where found
  bool local = false;               // CollapseLoss::local
  bool fill_alone = false;          // no stone moves
  std::vector<std::int32_t> spans;  // whose vault moves
  double share = 0.0;               // of the mass that can move, which does
  std::string moving;               // what moves, in words
  std::size_t tries = 0;
  double seconds = 0.0;
};

struct Rating {
  std::vector<SpanExtent> spans;
  std::vector<RatedPlace> places;  // by vehicle, lane, direction and x
  std::vector<std::size_t> worst;  // of each vehicle: index into places
};

/// The case without what must not act before a vehicle: a last stage of collapse. Throws InputError when no stage is
/// left that brings the bridge to rest.
Case before_vehicles(const Case& c);
/// What a vehicle of the request puts on the road of the case's bridge, or on its strip.
std::vector<RoadLoad> vehicle_loads(const RateRequest& request, const Case& c, std::size_t vehicle,
                                    const VehiclePlace& place);

/// Index into places of the worst of all vehicles.
std::size_t worst_of_all(const Rating& rating);

/// The vaults over which a load may stand, from left to right. Throws InputError where there is none.
std::vector<SpanExtent> span_extents(const Assembly& assembly);

/// Where the front of a vehicle is when any of its axles is over a vault, every `step` m.
std::vector<double> fronts(const Vehicle& vehicle, const std::vector<SpanExtent>& spans, bool towards_right,
                           double step);

/// The case's stages but a last one of collapse come first and once; each place begins where they end. `progress` hears
/// of each place that is done. Throws InputError and RunError.
Rating rate(const Case& c, const Assembly& assembly, const RateRequest& request,
            const std::function<void(const RatedPlace&, std::size_t done, std::size_t all)>& progress);

/// The case with one more stage: the loads of a vehicle at a place, raised to collapse or standing there in full.
Case with_vehicle(const Case& c, const RateRequest& request, const RatedPlace& at, bool to_collapse);

}  // namespace voussoir
