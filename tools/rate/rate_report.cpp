#include "tools/rate/rate_report.h"

#include <fmt/format.h>

#include "solver/base/csv.h"

namespace voussoir {

double middle_of(const Vehicle& vehicle, const VehiclePlace& place) {
  if (vehicle.axles.empty()) return place.x;
  const double half = 0.5 * (vehicle.axles.front().x + vehicle.axles.back().x);
  return place.towards_right ? place.x - half : place.x + half;
}

std::string where_on(const Rating& rating, const Vehicle& vehicle, const VehiclePlace& place) {
  const double x = middle_of(vehicle, place);
  for (std::size_t i = 0; i < rating.spans.size(); ++i) {
    const SpanExtent& span = rating.spans[i];
    if (x >= span.x0 && x <= span.x1)
      return fmt::format("span {} at {:.2f}", i + 1, (x - span.x0) / (span.x1 - span.x0));
  }
  return "outside the spans";
}

std::string factor_text(const RatedPlace& at, const RateRequest& request) {
  return at.found ? fmt::format("{:.3g}", at.factor) : fmt::format("at least {:.3g}", request.most);
}

namespace {

/// Spans by their number from the left.
std::string spans_text(const Rating& rating, const RatedPlace& at) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < rating.spans.size(); ++i)
    for (const std::int32_t part : at.spans)
      if (rating.spans[i].part == part) numbers.push_back(i + 1);
  return fmt::format("{}", fmt::join(numbers, " "));
}

std::string moving_text(const Rating& rating, const RatedPlace& at) {
  if (!at.found) return "no collapse";
  const std::string spans = spans_text(rating, at);
  if (at.fill_alone) return "the fill fails under the vehicle; the vaults remain standing";
  if (spans.empty()) return at.moving;
  return fmt::format("{}; {} {}", at.moving,
                     spans.find(' ') == std::string::npos ? "the vault of span" : "vaults of spans", spans);
}

}  // namespace

std::string missing_text(const Rating& rating) {
  if (rating.complete()) return {};
  return fmt::format(
      "The rating is incomplete, because it was interrupted after {} of {} positions. The factor at another position "
      "may be smaller.",
      rating.places.size(), rating.planned);
}

std::string rating_text(const Rating& rating, const RateRequest& request) {
  std::string text;
  for (const std::size_t index : rating.worst) {
    const RatedPlace& at = rating.places[index];
    const Vehicle& vehicle = request.vehicles[at.vehicle];
    text += fmt::format("{:<26} adequacy factor {:<12} front at x = {:.2f} m, y = {:.2f} m, towards {} ({}): {}\n",
                        vehicle.name, factor_text(at, request), at.place.x, at.place.y,
                        at.place.towards_right ? "right" : "left", where_on(rating, vehicle, at.place),
                        moving_text(rating, at));
  }
  if (!rating.complete()) text += missing_text(rating) + "\n";
  return text;
}

std::string rating_csv(const Rating& rating, const RateRequest& request) {
  std::string csv =
      "vehicle,towards,front_x_m,middle_x_m,y_m,factor,above,found,local,spans,moving_mass_share,moving,tries,"
      "seconds\n";
  for (const RatedPlace& at : rating.places) {
    const Vehicle& vehicle = request.vehicles[at.vehicle];
    csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.6g},{},{},{},{},{:.4g},{},{},{:.1f}\n", csv_cell(vehicle.name),
                       at.place.towards_right ? "right" : "left", at.place.x, middle_of(vehicle, at.place), at.place.y,
                       at.factor, at.found ? fmt::format("{:.6g}", at.above) : "", at.found, at.local,
                       spans_text(rating, at), at.share, csv_cell(at.moving), at.tries, at.seconds);
  }
  return csv;
}

nlohmann::json rating_json(const Rating& rating, const RateRequest& request) {
  nlohmann::json json;
  for (const SpanExtent& span : rating.spans) json["spans"].push_back({{"part", span.part}, {"x", {span.x0, span.x1}}});
  json["complete"] = rating.complete();
  json["places_done"] = rating.places.size();
  json["places_planned"] = rating.planned;
  json["looked_for_up_to"] = request.most;
  json["tolerance"] = request.tolerance;
  json["effective_width"] = request.effective_width ? nlohmann::json(*request.effective_width) : nlohmann::json();
  for (const std::size_t index : rating.worst) {
    const RatedPlace& at = rating.places[index];
    const Vehicle& vehicle = request.vehicles[at.vehicle];
    nlohmann::json one = {{"vehicle", vehicle.name},
                          {"title", vehicle.title},
                          {"axle_weight", axle_weight(vehicle)},
                          {"found", at.found},
                          {"adequacy_factor", at.factor},
                          {"above", at.found ? nlohmann::json(at.above) : nlohmann::json()},
                          {"front_x", at.place.x},
                          {"y", at.place.y},
                          {"towards", at.place.towards_right ? "right" : "left"},
                          {"where", where_on(rating, vehicle, at.place)},
                          {"local", at.local},
                          {"spans", spans_text(rating, at)},
                          {"moving", moving_text(rating, at)}};
    json["vehicles"].push_back(one);
  }
  return json;
}

}  // namespace voussoir
