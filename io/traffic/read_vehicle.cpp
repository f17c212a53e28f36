#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "io/toml/table_reader.h"
#include "io/traffic/vehicle.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shipped.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

constexpr const char* library = "cases/vehicles";
constexpr double farthest_along = 1e4;  // m
constexpr std::size_t most_axles = 10'000;
const Limits along = {-farthest_along, farthest_along, "m"};
const Limits not_in_front = {0.0, farthest_along, "m"};
const Limits across = {-100.0, 100.0, "m"};
const Limits size = {0.0, 100.0, "m", true};

/// The wheels of an axle.
struct Wheels {
  std::vector<double> y;             // m, their middles
  double length = 0.0, width = 0.0;  // m, contact area of a wheel
};

/// The track below the axles of a train.
struct Track {
  double length = 0.0, width = 0.0;  // m, of a sleeper: across and along the track
  double spacing = 0.0;              // m
  std::vector<double> shares;        // shares of an axle on the sleepers around it
};

/// An axle with its wheels or its track.
struct ReadAxle {
  VehicleAxle axle;
  Wheels wheels;
};

/// `track` as the distance between two wheels, or as the places of all; `wheel` as [length, width].
void read_wheels(TableReader& table, Wheels& wheels) {
  if (table.is_list("track")) {
    wheels.y = table.number_list("track", across);
    std::sort(wheels.y.begin(), wheels.y.end(), std::greater<>());
  } else if (table.has("track")) {
    const double track = table.required_number("track", size);
    wheels.y = {0.5 * track, -0.5 * track};
  }
  if (!table.has("wheel")) return;
  const std::vector<double> wheel = table.numbers("wheel", 2, size);
  wheels.length = wheel[0], wheels.width = wheel[1];
}

/// N, from `load` or `tonnes`.
double read_load(TableReader& table) {
  if (table.has("tonnes")) {
    if (table.has("load")) table.fail("tonnes", "and 'load' are both given. Keep one of them.");
    return standard_gravity * 1e3 * table.required_number("tonnes", {0.0, 1000.0, "t", true});
  }
  return table.required_number("load", {0.0, 1e7, "N", true});
}

/// One [[axle]], as often as it says.
void read_axle(TableReader& table, const Wheels& usual, Vehicle::Kind kind, std::vector<ReadAxle>& axles) {
  ReadAxle one{{table.required_number("x", not_in_front), read_load(table)}, usual};
  if (kind == Vehicle::Kind::rail) {
    for (const char* key : {"track", "wheel"})
      if (table.has(key))
        table.fail(key, "is only for road vehicles. The axles of a train act on the sleepers of [track].");
  } else {
    read_wheels(table, one.wheels);
    if (one.wheels.y.empty()) table.missing("track", "m between the middles of two wheels, or a list of the wheels' y");
    if (one.wheels.length == 0.0) table.missing("wheel", "[length, width] of the contact of a wheel, in m");
  }
  const std::int64_t repeat = table.integer("repeat", 1, 1, 1000);
  if (repeat == 1 && table.has("spacing")) table.fail("spacing", "needs 'repeat' of 2 or more");
  const double spacing = repeat > 1 ? table.required_number("spacing", {0.0, farthest_along, "m", true}) : 0.0;
  table.finish();
  const double first = one.axle.x;
  for (std::int64_t i = 0; i < repeat; ++i) {
    one.axle.x = first + double(i) * spacing;
    axles.push_back(one);
  }
  if (axles.size() > most_axles) table.fail(fmt::format("makes more than {} axles", most_axles));
}

std::vector<ReadAxle> read_axles(TableReader& root, const Wheels& usual, Vehicle::Kind kind) {
  std::vector<ReadAxle> axles;
  double before = -1.0;
  for (TableReader& table : root.tables("axle")) {
    const std::size_t first = axles.size();
    read_axle(table, usual, kind, axles);
    const double x = axles[first].axle.x;
    if (x <= before)
      table.fail("x",
                 fmt::format("is {} m, but that of the previous [[axle]] is {} m. Give axles from the front backwards.",
                             x, before));
    before = x;
  }
  // Repeated axles may be between those of another table, as in the wagons of a train.
  std::stable_sort(axles.begin(), axles.end(),
                   [](const ReadAxle& a, const ReadAxle& b) { return a.axle.x < b.axle.x; });
  return axles;
}

std::optional<Track> read_track(TableReader& root, Vehicle::Kind kind) {
  std::optional<TableReader> table = root.table("track", "[track]");
  if (kind == Vehicle::Kind::road) {
    if (table) table->fail("is only for trains, but 'kind' is \"road\". Remove it, or set kind = \"rail\".");
    return std::nullopt;
  }
  if (!table) root.missing("track", "a table [track] with the sleepers of a train");
  const std::vector<double> sleeper = table->numbers("sleeper", 2, size);
  Track track{sleeper[0], sleeper[1], table->required_number("spacing", size), {1.0}};
  if (table->has("shares")) track.shares = table->number_list("shares", {0.0, 1.0, ""});
  if (track.shares.size() % 2 == 0)
    table->fail("shares",
                fmt::format("has {}. It must have an odd number of them; the middle one is the sleeper under the axle.",
                            counted(track.shares.size(), "number")));
  const double sum = std::accumulate(track.shares.begin(), track.shares.end(), 0.0);
  if (std::abs(sum - 1.0) > 1e-6)
    table->fail("shares",
                fmt::format("have the sum {:g}. The sum must be 1, because they are shares of an axle.", sum));
  const double gauge = table->number("gauge", 0.0, size);
  if (gauge > track.length)
    table->fail("gauge",
                fmt::format("is {} m. It must be less than the length of the sleeper, {} m.", gauge, track.length));
  table->finish();
  return track;
}

/// Wheels of an axle of a road vehicle.
void put_wheels(const ReadAxle& axle, std::size_t index, Vehicle& vehicle) {
  const Wheels& wheels = axle.wheels;
  for (const double y : wheels.y)
    vehicle.patches.push_back(
        {axle.axle.x, y, wheels.length, wheels.width, axle.axle.load / double(wheels.y.size()), index});
}

/// The sleepers under an axle of a train; one is taken to lie right under it.
void put_sleepers(const VehicleAxle& axle, const Track& track, std::size_t index, Vehicle& vehicle) {
  const std::size_t middle = track.shares.size() / 2;
  for (std::size_t i = 0; i < track.shares.size(); ++i)
    if (track.shares[i] > 0.0)
      vehicle.patches.push_back({axle.x + (double(i) - double(middle)) * track.spacing, 0.0, track.width, track.length,
                                 track.shares[i] * axle.load, index});
}

LoadStrip read_uniform(TableReader& table, const std::optional<Track>& track) {
  LoadStrip strip;
  if (table.has("from")) strip.from = table.required_number("from", along);
  if (table.has("to")) strip.to = table.required_number("to", along);
  if (!(strip.to > strip.from))
    table.fail("to", fmt::format("is {} m. It must be above 'from', {} m.", strip.to, strip.from));
  strip.y = table.number("y", 0.0, across);
  strip.width = track && !table.has("width") ? track->length : table.required_number("width", size);
  const Limits pressures = {0.0, 1e7, "N/m2", true}, forces = {0.0, 1e7, "N/m", true};
  if (table.has("pressure") && table.has("per_metre"))
    table.fail("per_metre", "and 'pressure' are both given. Keep one of them.");
  strip.pressure = table.has("pressure") ? table.required_number("pressure", pressures)
                                         : table.required_number("per_metre", forces) / strip.width;
  table.finish();
  return strip;
}

DynamicFactor read_factor(TableReader& table) {
  DynamicFactor factor;
  factor.name = table.required_text("name");
  factor.clause = table.required_text("clause");
  if (table.has("formula")) {
    if (table.has("value")) table.fail("value", "and 'formula' are both given. Keep one of them.");
    factor.formula = DynamicFactor::Formula(1 + table.required_word("formula", factor_formulas()));
    factor.determinant = table.number("determinant", factor.determinant, {0.0, 10.0, "", true});
  } else {
    factor.value = table.required_number("value", {0.0, 100.0, "", true});
  }
  factor.critical_axle_only = table.word("axles", {"all", "critical"}, 0) == 1;
  table.finish();
  return factor;
}

VehicleVariant read_variant(TableReader& table, std::size_t axles) {
  VehicleVariant variant{table.required_text("name"), table.required_text("clause"),
                         table.numbers("shares", axles, {0.0, 100.0, ""})};
  table.finish();
  return variant;
}

/// Names are asked for, so that no two may be the same.
template <class Named>
void check_new(const TableReader& table, const std::vector<Named>& list, const std::string& name) {
  for (const Named& other : list)
    if (other.name == name)
      table.fail("name", fmt::format("is \"{}\", which another one has. Give each its own name.", shown(name)));
}

/// [vehicle], with the wheels that axles have unless they say otherwise.
Wheels read_head(TableReader& root, Vehicle& vehicle) {
  std::optional<TableReader> head = root.table("vehicle", "[vehicle]");
  if (!head) root.missing("vehicle", "a table [vehicle] with title, source and kind");
  vehicle.title = head->required_text("title");
  vehicle.source = head->required_text("source");
  vehicle.kind = Vehicle::Kind(head->required_word("kind", vehicle_kinds()));
  if (head->has("not_checked")) vehicle.not_checked = head->texts("not_checked");
  Wheels usual;
  if (vehicle.kind == Vehicle::Kind::road) read_wheels(*head, usual);
  head->finish();
  return usual;
}

void lay_out(const std::vector<ReadAxle>& axles, const std::optional<Track>& track, Vehicle& vehicle) {
  for (const ReadAxle& axle : axles) {
    const std::size_t index = vehicle.axles.size();
    vehicle.axles.push_back(axle.axle);
    if (track)
      put_sleepers(axle.axle, *track, index, vehicle);
    else
      put_wheels(axle, index, vehicle);
  }
}

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".toml");
}

}  // namespace

Vehicle parse_vehicle(const std::string& text, const std::string& file) {
  const toml::table parsed = parse_toml(text, file);
  TableReader root(parsed, file, "the file");
  Vehicle vehicle;
  vehicle.name = fs::path(file).stem().string();
  root.attempt([&] {
    const Wheels usual = read_head(root, vehicle);
    const std::optional<Track> track = read_track(root, vehicle.kind);
    lay_out(read_axles(root, usual, vehicle.kind), track, vehicle);
    for (TableReader& table : root.tables("uniform")) vehicle.strips.push_back(read_uniform(table, track));
    for (TableReader& table : root.tables("factor")) {
      const DynamicFactor factor = read_factor(table);
      check_new(table, vehicle.factors, factor.name);
      vehicle.factors.push_back(factor);
    }
    for (TableReader& table : root.tables("variant")) {
      const VehicleVariant variant = read_variant(table, vehicle.axles.size());
      check_new(table, vehicle.variants, variant.name);
      vehicle.variants.push_back(variant);
    }
    if (vehicle.axles.empty() && vehicle.strips.empty())
      root.fail("has no load. Give at least one [[axle]] or [[uniform]].");
  });
  root.finish();
  return vehicle;
}

std::vector<std::string> shipped_vehicles() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(shipped(library)))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Vehicle read_vehicle(const std::string& name_or_path) {
  if (is_path(name_or_path)) return parse_vehicle(read_text(name_or_path), name_or_path);
  const std::vector<std::string> names = shipped_vehicles();
  if (std::find(names.begin(), names.end(), name_or_path) == names.end())
    throw InputError("the program has no vehicle '{}'{} (for your own file give its ending, too, as in {}.toml)",
                     shown(name_or_path), suggestion(name_or_path, names), shown(name_or_path));
  const std::string file = shipped(fmt::format("{}/{}.toml", library, name_or_path));
  return parse_vehicle(read_text(file), file);
}

}  // namespace voussoir
