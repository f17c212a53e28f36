// The folder as a whole.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/measured/parts.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

constexpr const char* expected_parts =
    "modes.csv or records/*.csv or both, and optionally sensors.csv, shapes.csv and about.toml";
const std::vector<std::string>& known_parts() {
  static const std::vector<std::string> names = {"sensors.csv", "modes.csv", "shapes.csv", "records", "about.toml"};
  return names;
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TextFile open_text(const std::string& path, const std::string& name) {
  TextFile file{path, name, {}};
  std::error_code ignored;
  // A pipe would keep the reader waiting.
  if (!std::filesystem::is_regular_file(file.path, ignored))
    throw InputError("{}: is not a text file. Remove or rename it.", file.path);
  file.text = read_text(file.path);
  return file;
}
TextFile open_part(const std::string& directory, const std::string& name) {
  return open_text(path_in(directory, name), name);
}

bool is_record(const std::string& name) {
  return name.size() > 4 && name.ends_with(".csv") && !name.starts_with('.');
}

void set_aside_strangers(const std::vector<std::string>& names, Measured& measured) {
  for (const std::string& name : names) {
    if (contains(known_parts(), name)) continue;
    const std::string near = nearest_word(shown(name), known_parts());
    measured.set_aside.push_back({name, near.empty() ? "not read" : fmt::format("not read: did you mean '{}'?", near)});
  }
}

void read_records(const std::string& directory, Measured& measured) {
  const std::string folder = path_in(directory, "records");
  if (!is_folder(folder)) throw InputError("{}: is a file. It must be a folder with recordings.", folder);
  for (const std::string& name : names_in(folder)) {
    const std::string inside = "records/" + name;
    if (is_record(name))
      parse_record(open_part(directory, inside), measured);
    else
      measured.set_aside.push_back({inside, "not read: names of recordings end in .csv"});
  }
}

void check_folder(const std::string& directory, const std::vector<std::string>& names) {
  if (!is_folder(directory))
    throw InputError("{}: there is no such folder. Give a folder with {}.", directory, expected_parts);
  if (contains(names, "modes.csv") || contains(names, "records")) return;
  const std::size_t listed = std::min<std::size_t>(names.size(), 10);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < listed; ++i) found.push_back(shown(names[i]));
  throw InputError("{}: the folder has {}{}. It must have {}. Add the measurements.", directory,
                   names.empty() ? "nothing" : fmt::format("{}", fmt::join(found, ", ")),
                   listed < names.size() ? ", …" : "", expected_parts);
}

bool same_shape(const MeasuredMode& a, const MeasuredMode& b) {
  if (a.shape.size() != b.shape.size()) return false;
  if (a.shape.empty()) return true;
  const auto largest = [](const MeasuredMode& m) {
    return *std::max_element(m.shape.begin(), m.shape.end(),
                             [](const auto& p, const auto& q) { return std::abs(p.value) < std::abs(q.value); });
  };
  const double factor = largest(b).value / largest(a).value;
  for (std::size_t i = 0; i < a.shape.size(); ++i)
    if (a.shape[i].sensor != b.shape[i].sensor ||
        std::abs(factor * a.shape[i].value - b.shape[i].value) > 1e-9 * std::abs(largest(b).value))
      return false;
  return true;
}

/// Sets repeated modes aside, because a copied row would count twice.
void set_aside_repeats(Measured& measured) {
  std::vector<MeasuredMode> kept;
  for (const MeasuredMode& mode : measured.modes) {
    const auto first = std::find_if(kept.begin(), kept.end(), [&](const MeasuredMode& m) {
      return m.period == mode.period && m.direction == mode.direction && m.damping == mode.damping &&
             same_shape(m, mode);
    });
    if (first == kept.end())
      kept.push_back(mode);
    else
      measured.set_aside.push_back(
          {fmt::format("modes.csv:{}", mode.row),
           fmt::format("mode '{}' repeats mode '{}' of row {}: period, direction, damping and shape are the same",
                       shown(mode.name), shown(first->name), first->row)});
  }
  measured.modes = std::move(kept);
}

/// Sets sensors aside that no recording and no shape names.
void set_aside_unnamed(Measured& measured) {
  const auto& sensors = measured.sensors;
  if (!sensors.empty() && std::none_of(sensors.begin(), sensors.end(), [](const auto& s) { return s.named; }))
    return measured.set_aside.push_back(
        {"sensors.csv", fmt::format("no recording and no shape names any of the {} sensors", sensors.size())});
  for (const MeasuredSensor& s : sensors)
    if (!s.named)
      measured.set_aside.push_back({fmt::format("sensors.csv:{}", s.row),
                                    fmt::format("no recording and no shape names sensor '{}'", shown(s.id))});
}

/// Throws InputError if no modes and no recordings are left.
void check_left(const Measured& measured) {
  if (!measured.modes.empty() || !measured.records.empty()) return;
  std::string why;
  if (!measured.set_aside.empty())
    why = fmt::format(" ({}: {})", measured.set_aside.back().place, measured.set_aside.back().what);
  throw InputError(
      "{}: there is no usable recording{} and no modes.csv. The folder must have {}. Add the measurements.",
      measured.directory, why, expected_parts);
}

}  // namespace

std::string path_in(const std::string& directory, const std::string& name) {
  return (std::filesystem::path(directory) / name).string();
}

std::vector<std::string> names_in(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code error;
  if (!std::filesystem::exists(directory, error)) return names;
  auto entry = std::filesystem::directory_iterator(directory, error);
  while (!error && entry != std::filesystem::directory_iterator()) {
    names.push_back(entry->path().filename().string());
    entry.increment(error);
  }
  if (error) throw InputError("{}: cannot read the folder: {}", directory, error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<MeasuredSensor> read_sensors(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw InputError("{}: there is no such file. Give a table with the columns id,x,y,z,direction.", file);
  Measured measured;
  parse_sensors(open_text(file, file), measured);
  return measured.sensors;
}

Measured read_measured(const std::string& directory) {
  Measured measured;
  measured.directory = directory;
  const std::vector<std::string> names = is_folder(directory) ? names_in(directory) : std::vector<std::string>{};
  check_folder(directory, names);
  if (contains(names, "about.toml")) parse_about(open_part(directory, "about.toml"), measured);
  if (contains(names, "sensors.csv")) parse_sensors(open_part(directory, "sensors.csv"), measured);
  if (contains(names, "modes.csv")) parse_modes(open_part(directory, "modes.csv"), measured);
  if (contains(names, "shapes.csv")) parse_shapes(open_part(directory, "shapes.csv"), measured);
  set_aside_repeats(measured);
  if (contains(names, "records")) read_records(directory, measured);
  set_aside_strangers(names, measured);
  check_left(measured);
  set_aside_unnamed(measured);
  if (measured.sensors.empty() && !measured.records.empty())
    measured.remarks.emplace_back("no sensors.csv: the places of the channels on the bridge are not known");
  return measured;
}

}  // namespace voussoir
