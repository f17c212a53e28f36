#include "tools/rate/rate_page.h"

#include <fmt/format.h>

#include "solver/base/constants.h"
#include "tools/rate/rate_report.h"
#include "viz/page/line_chart.h"

namespace voussoir {

namespace {

/// Places of one vehicle, lane and direction follow one another.
bool same_sweep(const RatedPlace& a, const RatedPlace& b) {
  return a.vehicle == b.vehicle && a.place.y == b.place.y && a.place.towards_right == b.place.towards_right;
}

std::string sweep_name(const RatedPlace& at, const RateRequest& request) {
  std::string name = request.vehicles[at.vehicle].name;
  if (request.lanes.size() > 1) name += fmt::format(", y = {:g} m", at.place.y);
  return name + (at.place.towards_right ? "" : ", to the left");
}

/// Grey lines where the spans begin and end.
void mark_spans(LineChart& chart, const Rating& rating, double high) {
  for (std::size_t i = 0; i < rating.spans.size(); ++i) {
    ChartBand band;
    if (i == 0) band.name = "spans";
    band.x = {rating.spans[i].x0, rating.spans[i].x1};
    band.low = {0.0, 0.0};
    band.high = {high, high};
    band.colour = i % 2 == 0 ? "#eef2f5" : "#e2e9ee";
    chart.bands.push_back(band);
  }
}

std::string table(const Rating& rating, const RateRequest& request) {
  std::string text = "<table>\n" + table_row({{"vehicle"},
                                              {"weight of the axles, t", true},
                                              {"adequacy factor", true},
                                              {"smallest factor without equilibrium", true},
                                              {"front at x, m", true},
                                              {"y, m", true},
                                              {"direction"},
                                              {"middle of the axles, share of the span"},
                                              {"what moves at collapse"}},
                                             "th");
  for (const std::size_t index : rating.worst) {
    const RatedPlace& at = rating.places[index];
    const Vehicle& vehicle = request.vehicles[at.vehicle];
    const nlohmann::json row = rating_json({rating.spans, rating.places, {index}}, request)["vehicles"][0];
    text += table_row({words_cell(vehicle.name),
                       {fmt::format("{:.1f}", axle_weight(vehicle) / (1e3 * standard_gravity)), true},
                       {factor_text(at, request), true},
                       {at.found ? fmt::format("{:.3g}", at.above) : "–", true},
                       {fmt::format("{:.2f}", at.place.x), true},
                       {fmt::format("{:.2f}", at.place.y), true},
                       words_cell(row["towards"].get<std::string>()),
                       words_cell(row["where"].get<std::string>()),
                       words_cell(row["moving"].get<std::string>())},
                      "td");
  }
  return text + "</table>\n";
}

std::string first_sentence(const Rating& rating, const RateRequest& request) {
  const RatedPlace& at = rating.places[worst_of_all(rating)];
  const Vehicle& vehicle = request.vehicles[at.vehicle];
  if (!at.found)
    return fmt::format("The bridge carries each vehicle, multiplied by {:g}, at every computed position.",
                       request.most);
  return fmt::format("The least adequacy factor is {}, for {} with the middle of its axles over {}.",
                     factor_text(at, request), vehicle.name, where_on(rating, vehicle, at.place));
}

}  // namespace

std::string influence_chart(const Rating& rating, const RateRequest& request) {
  LineChart chart;
  chart.title = "Adequacy factor";
  chart.x_label = "middle of the axles, x, m";
  chart.y_label = "adequacy factor";
  chart.y_low = 0.0;
  double high = 0.0;
  ChartDots bounds;
  bounds.marker = Marker::triangle;
  for (std::size_t i = 0; i < rating.places.size(); ++i) {
    const RatedPlace& at = rating.places[i];
    if (i == 0 || !same_sweep(rating.places[i - 1], at)) {
      chart.curves.push_back({.name = sweep_name(at, request)});
      chart.dots.emplace_back();
    }
    const auto add = [x = middle_of(request.vehicles[at.vehicle], at.place), y = at.factor](auto& to) {
      to.x.push_back(x), to.y.push_back(y);
    };
    add(chart.curves.back());
    add(at.found ? chart.dots.back() : bounds);
    high = std::max(high, at.factor);
  }
  number_curves(chart);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) chart.dots[i].colour = chart.curves[i].colour;
  if (!bounds.x.empty()) {
    bounds.name = "lower bound: no limit found up to this factor";
    chart.dots.push_back(bounds);
  }
  mark_spans(chart, rating, 1.05 * high);
  return line_chart(chart);
}

std::string rate_page(const Rating& rating, const RateRequest& request, const RatePageWords& words) {
  std::string body = rating.complete() ? "" : paragraph(missing_text(rating));
  body += paragraph(first_sentence(rating, request));
  body += paragraph(
      "The factor multiplies all loads of a vehicle at one position, with the dynamic factors given below. The weight "
      "of the bridge is not multiplied. The adequacy factor is the largest factor at which the program found "
      "equilibrium.");
  body += figure(influence_chart(rating, request));
  body += heading("Worst positions") + table(rating, request);
  if (!words.passages.empty())
    body += heading("Repeated passages") + figure(ratchet_chart(words.passages)) +
            paragraph(passages_text(words.passages, rating.places[rating.worst.front()].factor));
  if (!words.beside.empty()) body += heading("Comparison with other methods") + paragraph(words.beside);
  if (!words.remarks.empty()) body += heading("Assumptions") + list(words.remarks);
  body += pictures_section(words.pictures, "The worst position");
  if (!words.thrust.empty())
    body += heading("Thrust lines at the worst position") + figure(words.thrust) +
            note(
                "One line for each ring: the resultant over the whole width of the vault, seen along y. The forces of "
                "the joints are in worst/joints.csv and working/joints.csv.");
  return html_page(words.title, body);
}

}  // namespace voussoir
