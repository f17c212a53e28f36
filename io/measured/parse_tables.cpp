// Sensors, modes, shapes and the texts about them.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "io/case/case.h"
#include "io/measured/parts.h"
#include "io/measured/units.h"
#include "io/toml/table_reader.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double unit_tolerance = 0.01;    // of a direction's length
constexpr double unit_already = 1e-12;     // not normalised again, so that what was written is read bit for bit
constexpr double longest_period = 5.0;     // s; masonry bridges have shorter ones
constexpr double longish_period = 1.0;     // s
constexpr std::size_t fewest_sensors = 2;  // of a shape

Vec3 axis_direction(const std::string& word) {
  Vec3 direction = Vec3::Zero();
  const bool negative = word.starts_with('-');
  const std::string axis = word.substr(negative ? 1 : 0);
  if (axis.size() == 1 && axis[0] >= 'x' && axis[0] <= 'z') direction[axis[0] - 'x'] = negative ? -1.0 : 1.0;
  return direction;
}

/// The three numbers of "a;b;c"; nothing for another text.
std::optional<Vec3> three_numbers(std::string_view text) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(';') : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view word = text.substr(0, end);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (parse_number(word, v[i]) != NumberTrouble::none) return std::nullopt;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return v;
}

Vec3 read_direction(const CsvTable& table, std::size_t i) {
  const std::string word = table.required_text(i, "direction");
  if (const Vec3 axis = axis_direction(word); !axis.isZero(0.0)) return axis;
  const std::optional<Vec3> v = three_numbers(word);
  if (!v)
    table.fail(
        i, fmt::format("direction is '{}'. It must be x, y, z, -x, -y, -z or a unit vector such as 0.7071;0.7071;0.",
                       shown(word)));
  const double length = v->stableNorm();
  if (!(std::abs(length - 1.0) <= unit_tolerance))
    table.fail(i,
               fmt::format("direction '{}' has the length {:.4g}. It must be a unit vector: divide it by its length.",
                           shown(word), length));
  return std::abs(length - 1.0) <= unit_already ? *v : Vec3(*v / length);
}

MeasuredSensor read_sensor(const CsvTable& table, std::size_t i) {
  MeasuredSensor sensor;
  sensor.id = table.required_text(i, "id");
  if (sensor.id == "t" || std::find(base_channels.begin(), base_channels.end(), sensor.id) != base_channels.end())
    table.fail(i, fmt::format("a sensor has the name '{}', which means the {} in recordings. Rename the sensor.",
                              sensor.id, sensor.id == "t" ? "time" : "ground motion"));
  sensor.position = {table.required_number(i, "x"), table.required_number(i, "y"), table.required_number(i, "z")};
  sensor.direction = read_direction(table, i);
  sensor.row = table.row(i);
  if (const std::string& unit = table.text(i, "unit"); !unit.empty()) {
    const ChannelUnit* known = find_unit(unit);
    std::vector<std::string> names;
    for (const ChannelUnit& u : channel_units()) names.push_back(u.name);
    if (!known) table.fail(i, fmt::format("unit '{}'{}", shown(unit), short_suggestion(unit, names)));
    sensor.unit = known->name;
  }
  return sensor;
}

/// Equal for sensors that measure the same motion: place, and direction without its sign.
std::array<double, 6> place_key(const MeasuredSensor& s) {
  Vec3 d = (s.direction * 1e6).array().round();
  const double sign = d.x() != 0.0 ? d.x() : d.y() != 0.0 ? d.y() : d.z();
  if (sign < 0.0) d = -d;
  return {s.position.x(), s.position.y(), s.position.z(), d.x(), d.y(), d.z()};
}

/// Keeps the row of each name, to find repeated names.
template <class Key>
class Rows {
 public:
  /// The row that had the key before, or 0.
  int add(const Key& key, int row) {
    const auto [at, fresh] = rows_.emplace(key, row);
    return fresh ? 0 : at->second;
  }

 private:
  std::map<Key, int> rows_;
};

/// Period and its deviation, from whichever of period and frequency the table has.
void read_period(const CsvTable& table, std::size_t i, MeasuredMode& mode) {
  const bool hertz = table.has("frequency");
  const std::string column = hertz ? "frequency" : "period";
  const double value = table.required_number(i, column), deviation = table.deviation(i, column + "_std");
  if (!(value > 0.0))
    table.fail(i, fmt::format("{} is {} {}. It must be above 0. Remove the row if it is unknown.", column, value,
                              hertz ? "Hz" : "s"));
  mode.period = hertz ? 1.0 / value : value;
  mode.period_std = hertz ? deviation / value / value : deviation;  // to first order
  if (!std::isfinite(mode.period) || !std::isfinite(mode.period_std))
    table.fail(i, fmt::format("frequency is {} Hz. Its period is too large for the program. Correct it.", value));
}

void read_damping(const CsvTable& table, std::size_t i, MeasuredMode& mode) {
  mode.damping = table.number(i, "damping");
  mode.damping_std = table.deviation(i, "damping_std");
  if (mode.damping && !(*mode.damping >= 0.0 && *mode.damping < 1.0))
    table.fail(
        i, fmt::format("damping is {}. It must be at least 0 and below 1, as the ratio to critical: write 0.02 for 2 %",
                       *mode.damping));
  if (!mode.damping && mode.damping_std > 0.0)
    table.fail(i, fmt::format("damping_std is {}, but there is no damping. Give both, or leave both empty.",
                              mode.damping_std));
}

MeasuredMode read_mode(const CsvTable& table, std::size_t i) {
  MeasuredMode mode;
  mode.name = table.required_text(i, "mode");
  mode.row = table.row(i);
  read_period(table, i, mode);
  read_damping(table, i, mode);
  mode.direction = table.text(i, "direction");
  const auto& words = mode_directions();
  if (!mode.direction.empty() && std::find(words.begin(), words.end(), mode.direction) == words.end())
    table.fail(i, fmt::format("direction '{}'{}", shown(mode.direction), short_suggestion(mode.direction, words)));
  return mode;
}

void check_mode_columns(const CsvTable& table) {
  if (table.has("period") && table.has("frequency"))
    table.fail_heading("the table has both 'period' and 'frequency'. Remove one of them.");
  if (!table.has("period") && !table.has("frequency"))
    table.fail_heading("the table has neither a column 'period' (s) nor a column 'frequency' (Hz). Add one of them.");
  const std::string strange = table.has("period") ? "frequency_std" : "period_std";
  if (table.has(strange))
    table.fail_heading(
        fmt::format("the table has '{}' but not '{}'. Give the standard deviation of the quantity in the table.",
                    strange, table.has("period") ? "frequency" : "period"));
}

/// Frequencies in the column of periods are larger than periods of masonry, and rise from mode to mode.
void remark_periods(const CsvTable& table, Measured& measured) {
  const auto& modes = measured.modes;
  const auto all_above = [&](double limit) {
    return std::all_of(modes.begin(), modes.end(), [&](const MeasuredMode& m) { return m.period > limit; });
  };
  const bool rising = modes.size() >= 3 && std::is_sorted(modes.begin(), modes.end(), [](const auto& a, const auto& b) {
                        return a.period < b.period;
                      });
  if (!all_above(longest_period) && !(rising && all_above(longish_period))) return;
  measured.remarks.push_back(
      table.has("period")
          ? fmt::format(
                "modes.csv: the periods, from {:.4g} s, are long for masonry. If they are frequencies, name the "
                "column 'frequency'; if they are in milliseconds, convert them to s.",
                modes[0].period)
          : fmt::format(
                "modes.csv: the frequencies give periods from {:.4g} s, which are long for masonry. If they are "
                "periods, name the column 'period'.",
                modes[0].period));
}

/// Index of a name in a list by a map, or an error with a suggestion.
std::size_t find_named(const CsvTable& table, std::size_t i, const std::string& column, const std::string& file,
                       const std::map<std::string, std::size_t>& known) {
  const std::string name = table.required_text(i, column);
  if (const auto found = known.find(name); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [k, index] : known) names.push_back(k);
  table.fail(i, fmt::format("{} '{}' is not in {}{}", column, shown(name), file, short_suggestion(name, names)));
}

/// Sets shapes aside that have one sensor or only zeros.
void drop_empty_shape(MeasuredMode& mode, int row, const std::string& file, Measured& measured) {
  const bool zeros =
      std::all_of(mode.shape.begin(), mode.shape.end(), [](const MeasuredValue& v) { return v.value == 0.0; });
  if (mode.shape.empty() || (mode.shape.size() >= fewest_sensors && !zeros)) return;
  const std::string why =
      zeros ? "has only zeros" : fmt::format("has 1 sensor; at least {} are needed", fewest_sensors);
  measured.set_aside.push_back(
      {fmt::format("{}:{}", file, row), fmt::format("the shape of mode '{}' {}", mode.name, why)});
  mode.shape.clear();
}

/// A text, or a date as TOML writes dates.
std::string when_of(const toml::table& root, TableReader& table) {
  const toml::node* node = root.get("when");
  std::ostringstream text;
  if (node && node->is_date()) return text << *node->value<toml::date>(), text.str();
  if (node && node->is_date_time()) return text << *node->value<toml::date_time>(), text.str();
  return table.text("when", "");
}

/// Text of a value: a table's keys one by one, an array as a whole.
void take_notes(const toml::node& node, const std::string& key, std::vector<Note>& notes) {
  if (const toml::table* table = node.as_table(); table && !table->empty()) {
    for (const auto& [name, inner] : *table) take_notes(inner, key + "." + std::string(name.str()), notes);
    return;
  }
  if (const auto text = node.value<std::string>(); node.is_string()) return notes.push_back({key, *text});
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  notes.push_back({key, text.str()});
}

/// about.toml may have any keys; only misspelt ones are reported.
void keep_notes(const toml::table& root, const std::string& file, Measured& measured) {
  static const std::vector<std::string> known = {"what", "when", "units", "notes"};
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    take_notes(node, name, measured.more);
    if (const std::string near = nearest_word(shown(name), known); !near.empty())
      measured.set_aside.push_back({fmt::format("{}:{}", file, key.source().begin.line),
                                    fmt::format("key '{}' is kept as a note: did you mean '{}'?", shown(name), near)});
  }
}

}  // namespace

void parse_sensors(const TextFile& file, Measured& measured) {
  const CsvTable table(file, {"id", "x", "y", "z", "direction"}, {"unit"});
  Rows<std::string> ids;
  Rows<std::array<double, 6>> places;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const MeasuredSensor sensor = read_sensor(table, i);
    if (const int before = ids.add(sensor.id, sensor.row))
      table.fail(
          i, fmt::format("sensor '{}' is already in row {}. Rename or remove one of them.", shown(sensor.id), before));
    if (const int before = places.add(place_key(sensor), sensor.row))
      table.fail(
          i,
          fmt::format("sensor '{}' has the same place and axis as the one in row {}. Correct its place, or remove one "
                      "of them with its measurements.",
                      shown(sensor.id), before));
    measured.sensors.push_back(sensor);
  }
}

void parse_modes(const TextFile& file, Measured& measured) {
  const CsvTable table(file, {"mode"},
                       {"period", "period_std", "damping", "damping_std", "direction", "frequency", "frequency_std"});
  check_mode_columns(table);
  Rows<std::string> names;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const MeasuredMode mode = read_mode(table, i);
    if (const int before = names.add(mode.name, mode.row))
      table.fail(
          i, fmt::format("mode '{}' is already in row {}. Rename or remove one of them.", shown(mode.name), before));
    measured.modes.push_back(mode);
  }
  remark_periods(table, measured);
}

void parse_shapes(const TextFile& file, Measured& measured) {
  const CsvTable table(file, {"mode", "sensor", "value"}, {"std"});
  if (measured.modes.empty())
    table.fail_heading("there are shapes, but no modes.csv. Give the periods of these modes in modes.csv.");
  if (measured.sensors.empty())
    table.fail_heading("there are shapes, but no sensors.csv. Give the places of these sensors in sensors.csv.");
  std::map<std::string, std::size_t> modes, sensors;
  for (std::size_t i = 0; i < measured.modes.size(); ++i) modes.emplace(measured.modes[i].name, i);
  for (std::size_t i = 0; i < measured.sensors.size(); ++i) sensors.emplace(measured.sensors[i].id, i);
  Rows<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<int> first_row(modes.size(), 0);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::size_t mode = find_named(table, i, "mode", "modes.csv", modes);
    const std::size_t sensor = find_named(table, i, "sensor", "sensors.csv", sensors);
    if (const int before = pairs.add({mode, sensor}, table.row(i)))
      table.fail(i, fmt::format("sensor '{}' of mode '{}' is already in row {}. Remove one of them.",
                                shown(measured.sensors[sensor].id), shown(measured.modes[mode].name), before));
    if (first_row[mode] == 0) first_row[mode] = table.row(i);
    measured.sensors[sensor].named = true;
    measured.modes[mode].shape.push_back({sensor, table.required_number(i, "value"), table.deviation(i, "std")});
  }
  for (std::size_t i = 0; i < measured.modes.size(); ++i)
    drop_empty_shape(measured.modes[i], first_row[i], file.name, measured);
}

void parse_about(const TextFile& file, Measured& measured) {
  const toml::table root = parse_toml(file.text, file.path);
  TableReader table(root, file.path, "the file");
  measured.what = table.text("what", "");
  measured.when = when_of(root, table);
  measured.notes = table.text("notes", "");
  if (const std::string units = table.text("units", "SI"); units != "SI")
    table.fail("units",
               fmt::format(
                   "is \"{}\". It must be \"SI\" (m, s, m/s2). Convert the tables, and give the units of recordings in "
                   "a column 'unit' of sensors.csv.",
                   shown(units)));
  keep_notes(root, file.name, measured);
}

}  // namespace voussoir
