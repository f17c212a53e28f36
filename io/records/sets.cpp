#include "io/records/sets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "io/records/components.h"
#include "io/records/left_out.h"
#include "solver/base/atomic_file.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/motion/filter.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

struct Unit {
  const char* name;
  double size;  // m/s2
};
constexpr Unit units[] = {{"m/s2", 1.0}, {"g", standard_gravity}, {"cm/s2", 0.01}};

/// The channels of a file; its step is replaced where `dt` > 0 (s).
std::vector<RecordComponent> components_of(const std::string& path, const std::string& text, double dt,
                                           const std::vector<std::string>& columns) {
  RecordComponent c{path, "", "", {}, false, false};
  std::vector<RecordComponent> components;
  std::vector<RecordFile> channels = parse_channels(text, path, dt, columns);
  c.alone = channels.size() > 1;
  for (RecordFile& channel : channels) {
    c.file = std::move(channel);
    name_component(c);
    if (c.alone) c.word = component_word(c.file.component), c.set = fs::path(path).filename().string();
    components.push_back(c);
  }
  return components;
}

std::vector<RecordComponent> read_components(const std::string& path, const ColumnsMeaning& meaning) {
  const std::string text = read_text(path);
  const bool step_told =
      meaning.columns.empty() ? columns_without_time(text) : !std::ranges::count(meaning.columns, "t");
  std::vector<RecordComponent> components = components_of(path, text, step_told ? meaning.dt : 0.0, meaning.columns);
  for (RecordComponent& c : components) c.step_told = step_told;
  return components;
}

/// "20090406_0132_AQA" is station AQA in the event 20090406_0132.
void split_name(RecordSet& set) {
  const auto digits = [&](std::size_t at, std::size_t n) { return is_number(set.name.substr(at, n)); };
  if (set.name.size() > 14 && digits(0, 8) && digits(9, 4) &&
      name_separators.find(set.name[13]) != std::string_view::npos) {
    set.event = set.name.substr(0, 13);
    set.station = set.name.substr(14);
  }
}

std::string component_words(const std::vector<const RecordComponent*>& components) {
  std::string words;
  for (const RecordComponent* c : components)
    words += (words.empty() ? "" : ", ") + (c->word.empty() ? std::string("(none)") : c->word);
  return words;
}

/// The components along x, y and z. Throws InputError if their names do not determine them, or if one of two horizontal
/// components is missing and both are needed.
std::array<const RecordComponent*, 3> along_axes(std::vector<const RecordComponent*> components, bool both) {
  std::array<const RecordComponent*, 3> along = {};
  std::vector<const RecordComponent*> silent;
  std::ranges::sort(components, comes_before);
  for (const RecordComponent* c : components) {
    const int axis = component_axis(c->word);
    if (axis < 0) {
      silent.push_back(c);
    } else if (along[std::size_t(axis)]) {
      throw InputError("more than one component has the same direction");
    } else {
      along[std::size_t(axis)] = c;
    }
  }
  if (silent.size() == 3 && silent[2]->word.ends_with('3')) along[2] = silent[2], silent.pop_back();
  for (const RecordComponent* c : silent) {
    if (along[0] && along[1]) throw InputError("it is not known which of the components is vertical");
    along[along[0] ? 1 : 0] = c;
  }
  if (both && (!along[0] || !along[1]))
    throw InputError("two horizontal components are needed; a vertical one is optional");
  return along;
}

using Groups = std::map<std::string, std::vector<const RecordComponent*>>;

std::vector<const RecordComponent*> pointers_to(const std::vector<RecordComponent>& components) {
  std::vector<const RecordComponent*> pointers;
  for (const RecordComponent& c : components) pointers.push_back(&c);
  return pointers;
}

bool makes_a_set(const std::vector<const RecordComponent*>& members) {
  try {
    along_axes(members, true);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Groups components by name. Groups of less than three components are then grouped by event and station of their
/// headings, which all files of a recording share.
Groups grouped(const std::vector<RecordComponent>& components) {
  Groups groups, shared;
  for (const RecordComponent& c : components) groups[c.set].push_back(&c);
  for (const auto& [name, members] : groups)
    for (const RecordComponent* c : members)
      if (members.size() < 3 && !c->alone && !c->file.event.empty() && !c->file.station.empty())
        shared[c->file.format + "\n" + c->file.event + "\n" + c->file.station].push_back(c);
  for (const auto& [heading, members] : shared) {
    std::set<std::string> names;
    for (const RecordComponent* c : members) names.insert(c->set);
    if (names.size() < 2 || members.size() > 3 || !makes_a_set(members)) continue;
    // Each of the names has all its members here, or the others would be torn apart.
    std::size_t named = 0;
    for (const std::string& name : names) named += groups[name].size();
    if (named != members.size()) continue;
    for (const std::string& name : names) groups.erase(name);
    groups[*names.begin()] = members;
  }
  return groups;
}

std::string without_digits(const std::string& name) {
  std::string rest;
  for (const char c : name)
    if (!std::isdigit(static_cast<unsigned char>(c))) rest += c;
  return rest;
}

std::string files_text(const std::vector<const RecordComponent*>& members) {
  return members.size() == 1 || members.front()->alone ? "one file" : counted(members.size(), "file");
}

/// A hint at another incomplete recording whose name differs by digits only.
std::string near_namesake(const std::string& name, const Groups& groups) {
  for (const auto& [other, members] : groups)
    if (other != name && without_digits(other) == without_digits(name) && !makes_a_set(members))
      return fmt::format(
          " The name '{} ({})' differs by digits only: if both are one recording, give the files the same name.", other,
          component_words(members));
  return "";
}

RecordSet set_of(const std::string& name, const std::array<const RecordComponent*, 3>& along,
                 const ColumnsMeaning& meaning) {
  RecordSet set;
  set.name = name;
  std::array<const RecordFile*, 3> files = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!along[axis]) continue;
    const RecordComponent& c = *along[axis];
    files[axis] = &c.file;
    set.files[c.alone ? 0 : axis] = c.path;
    set.components[axis] = c.word;
    set.format = c.file.format;
    set.event = c.file.event;
    set.station = c.file.station;
    if (c.file.unit == 0.0) set.units = meaning.units;
    if (c.step_told) set.dt = meaning.dt;
  }
  if (set.event.empty()) split_name(set);
  if (set.event.empty()) set.event = set.name;
  set.motion = join_components(files, acceleration_unit(meaning.units));
  return set;
}

}  // namespace

double acceleration_unit(const std::string& name) {
  for (const Unit& unit : units)
    if (name == unit.name) return unit.size;
  throw InputError("the unit is '{}'. It must be m/s2, g or cm/s2.", name);
}

const std::vector<std::string>& acceleration_units() {
  static const std::vector<std::string> names = {units[0].name, units[1].name, units[2].name};
  return names;
}

namespace {

/// Throws InputError for a sample that no ground motion has, so that no square of it overflows.
void check_size(const RecordFile& file, double unit) {
  constexpr double largest = 1e4;  // m/s2
  for (std::size_t k = 0; k < file.record.values.size(); ++k)
    if (const double a = file.record.values[k] * unit; !(std::abs(a) <= largest))
      throw InputError(
          "{}: sample {} is {:.3g} m/s2 ({:g} times {:g} m/s2). It must be at most {:g} m/s2. Check its unit.",
          file.path, k + 1, a, file.record.values[k], unit, largest);
}

}  // namespace

GroundMotion join_components(const std::array<const RecordFile*, 3>& files, double unit) {
  GroundMotion motion;
  for (const RecordFile* file : files)
    if (file && (motion.dt == 0.0 || file->record.dt < motion.dt)) motion.dt = file->record.dt;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!files[axis]) continue;
    const Record& record = files[axis]->record;
    const double size = files[axis]->unit > 0.0 ? files[axis]->unit : unit;
    const bool same = std::abs(record.dt - motion.dt) <= 1e-6 * motion.dt;
    const std::vector<double> values = same ? record.values : resample(record.values, record.dt, motion.dt);
    if (values.size() > motion.acceleration.size()) motion.acceleration.resize(values.size(), Vec3::Zero());
    for (std::size_t k = 0; k < values.size(); ++k) motion.acceleration[k][int(axis)] = values[k] * size;
    check_size(*files[axis], size);
  }
  return motion;
}

namespace {

/// The components along x, y and z from up to three files, or from one file with several channels. `read` returns the
/// channels of a file, and `kept` stores them.
template <class Read>
std::array<const RecordComponent*, 3> along_files(const std::array<std::string, 3>& files,
                                                  std::array<std::vector<RecordComponent>, 3>& kept, const Read& read) {
  std::array<const RecordComponent*, 3> along = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (files[axis].empty()) continue;
    kept[axis] = read(axis);
    along[axis] = &kept[axis].front();
    const std::size_t channels = kept[axis].size();
    if (channels < 2) continue;
    if (std::ranges::count(files, "") < 2)
      throw InputError("{}: the file has {} channels. Give it alone; it contains all axes.", files[axis], channels);
    try {
      return along_axes(pointers_to(kept[axis]), false);
    } catch (const InputError& error) {
      throw InputError("{}: channels {}: {}", files[axis], component_words(pointers_to(kept[axis])), error.what());
    }
  }
  return along;
}

}  // namespace

GroundMotion record_motion(const std::array<std::string, 3>& files, const std::array<std::string, 3>& texts,
                           const ColumnsMeaning& meaning) {
  std::array<std::vector<RecordComponent>, 3> kept;
  const auto along = along_files(files, kept, [&](std::size_t axis) {
    return components_of(files[axis], texts[axis], meaning.dt, meaning.columns);
  });
  std::array<const RecordFile*, 3> records = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (along[axis]) records[axis] = &along[axis]->file;
  return join_components(records, acceleration_unit(meaning.units));
}

RecordSet read_record_set(const std::array<std::string, 3>& files, const ColumnsMeaning& meaning) {
  std::array<std::vector<RecordComponent>, 3> kept;
  const auto along = along_files(files, kept, [&](std::size_t axis) { return read_components(files[axis], meaning); });
  for (const RecordComponent* c : along)
    if (c) return set_of(c->set, along, meaning);
  throw InputError("there is no record. Give one file, or up to three for x, y and z.");
}

RecordFolder read_record_folder(const std::string& folder, const ColumnsMeaning& meaning) {
  std::error_code trouble;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder, trouble))
    if (entry.is_regular_file() && !entry.path().filename().string().starts_with('.'))
      paths.push_back(entry.path().string());
  if (trouble) throw InputError("{}: {}. Give a folder of record files.", folder, trouble.message());
  std::ranges::sort(paths);

  RecordFolder found;
  std::vector<LeftOut> left_out;
  std::vector<RecordComponent> components;
  for (const std::string& path : paths) try {
      std::ranges::move(read_components(path, meaning), std::back_inserter(components));
    } catch (const std::exception& error) {
      left_out.push_back(left_out_file(path, error.what()));
    }
  const Groups groups = grouped(components);
  for (const auto& [name, members] : groups) try {
      found.sets.push_back(set_of(name, along_axes(members, true), meaning));
    } catch (const std::exception& error) {
      left_out.push_back({fmt::format("{} ({} of {})", name, component_words(members), files_text(members)),
                          error.what() + near_namesake(name, groups), ""});
    }
  found.left_out = said_once(left_out);
  if (found.sets.empty())
    throw InputError("{}: no record with two horizontal components among {}{}{}", folder, counted(paths.size(), "file"),
                     found.left_out.empty() ? "" : ". The first file that was left out: ",
                     found.left_out.empty() ? "" : found.left_out.front());
  return found;
}

}  // namespace voussoir
