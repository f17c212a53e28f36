#include "io/records/sets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "io/hdf5/atomic_file.h"
#include "solver/base/error.h"
#include "solver/motion/filter.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

struct Unit {
  const char* name;
  double size;  // m/s2
};
constexpr Unit units[] = {{"m/s2", 1.0}, {"g", 9.80665}, {"cm/s2", 0.01}};
constexpr std::string_view separators = "_-. ";

std::string upper(std::string_view text) {
  std::string word(text);
  for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

bool is_number(const std::string& word) {
  return !word.empty() && std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c); });
}

std::string without_ends(std::string text) {
  const std::size_t begin = text.find_first_not_of(separators);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(separators) - begin + 1);
}

/// A file, what it says of its direction, and the name that it shares with its companions.
struct Component {
  std::string path, word, set;
  RecordFile file;
  bool step_told = false;  // a single column
};

/// "1: UP" and "UP  DEG" are "UP".
std::string component_word(const std::string& component) {
  const std::size_t colon = component.find(':');
  std::string word = colon == std::string::npos ? component : component.substr(colon + 1);
  word = without_ends(word);
  return upper(word.substr(0, word.find(' ')));
}

void name_component(Component& c) {
  const std::string stem = fs::path(c.path).stem().string();
  c.word = component_word(c.file.component);
  if (const std::size_t at = c.word.empty() ? std::string::npos : upper(stem).rfind(c.word); at != std::string::npos) {
    // "BCR140" and "BCR-UP" are of one set: what stands around the word goes with it.
    const std::string before = without_ends(stem.substr(0, at)), after = without_ends(stem.substr(at + c.word.size()));
    c.set = without_ends(before + (after.empty() ? "" : "." + after));
  } else if (!c.word.empty()) {
    c.set = without_ends(c.file.event + " " + c.file.station);
  } else {
    const std::size_t cut = stem.find_last_of(separators);
    c.word = cut == std::string::npos ? "" : upper(stem.substr(cut + 1));
    c.set = cut == std::string::npos ? stem : without_ends(stem.substr(0, cut));
  }
}

Component read_component(const std::string& path, const ColumnsMeaning& meaning) {
  const std::string text = read_text(path);
  Component c{path, "", "", {}, columns_without_time(text)};
  c.file = parse_record(text, path, c.step_told ? meaning.dt : 0.0);
  name_component(c);
  return c;
}

/// "20090406_0132_AQA" is station AQA in the event 20090406_0132.
void split_name(RecordSet& set) {
  const auto digits = [&](std::size_t at, std::size_t n) { return is_number(set.name.substr(at, n)); };
  if (set.name.size() > 14 && digits(0, 8) && digits(9, 4) && separators.find(set.name[13]) != std::string_view::npos) {
    set.event = set.name.substr(0, 13);
    set.station = set.name.substr(14);
  }
}

/// Numbers by size, other words by letters.
bool comes_before(const Component* a, const Component* b) {
  if (is_number(a->word) && is_number(b->word)) return std::stol(a->word) < std::stol(b->word);
  return a->word < b->word;
}

std::string words_of(const std::vector<const Component*>& components) {
  std::string words;
  for (const Component* c : components)
    words += (words.empty() ? "" : ", ") + (c->word.empty() ? std::string("(none)") : c->word);
  return words;
}

/// Which of the components goes along x, y and z. Throws InputError when that does not follow from their names.
std::array<const Component*, 3> along_axes(std::vector<const Component*> components) {
  std::array<const Component*, 3> along = {};
  std::vector<const Component*> silent;
  std::ranges::sort(components, comes_before);
  for (const Component* c : components) {
    const int axis = component_axis(c->word);
    if (axis < 0) {
      silent.push_back(c);
    } else if (along[std::size_t(axis)]) {
      throw InputError("components {}: more than one of the same direction", words_of(components));
    } else {
      along[std::size_t(axis)] = c;
    }
  }
  if (silent.size() == 3 && silent[2]->word.ends_with('3')) along[2] = silent[2], silent.pop_back();
  for (const Component* c : silent) {
    if (along[0] && along[1]) throw InputError("components {}: which one is vertical?", words_of(components));
    along[along[0] ? 1 : 0] = c;
  }
  if (!along[0] || !along[1])
    throw InputError("components {}: expected two horizontal ones and perhaps a vertical one", words_of(components));
  return along;
}

RecordSet set_of(const std::string& name, const std::array<const Component*, 3>& along, const ColumnsMeaning& meaning) {
  RecordSet set;
  set.name = name;
  std::array<const RecordFile*, 3> files = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!along[axis]) continue;
    const Component& c = *along[axis];
    files[axis] = &c.file;
    set.files[axis] = c.path;
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
  throw InputError("units are '{}': expected m/s2, g or cm/s2", name);
}

const std::vector<std::string>& acceleration_units() {
  static const std::vector<std::string> names = {units[0].name, units[1].name, units[2].name};
  return names;
}

int component_axis(const std::string& name) {
  const std::string word = upper(name);
  static const std::map<std::string, int> known = {
      {"X", 0},  {"Y", 1},  {"EW", 0},  {"WE", 0},   {"E", 0},    {"W", 0},        {"NS", 1},
      {"SN", 1}, {"N", 1},  {"S", 1},   {"UD", 2},   {"UP", 2},   {"Z", 2},        {"V", 2},
      {"DN", 2}, {"DU", 2}, {"DWN", 2}, {"DOWN", 2}, {"VERT", 2}, {"VERTICAL", 2}, {"VER", 2}};
  if (const auto at = known.find(word); at != known.end()) return at->second;
  // SEED channels: band, instrument, direction.
  if (word.size() == 3 && (word[1] == 'N' || word[1] == 'G' || word[1] == 'L')) {
    if (word[2] == 'E') return 0;
    if (word[2] == 'N') return 1;
    if (word[2] == 'Z') return 2;
  }
  return -1;
}

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
  }
  return motion;
}

RecordSet read_record_set(const std::array<std::string, 3>& files, const ColumnsMeaning& meaning) {
  std::array<Component, 3> components;
  std::array<const Component*, 3> along = {};
  std::string name;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (files[axis].empty()) continue;
    components[axis] = read_component(files[axis], meaning);
    along[axis] = &components[axis];
    if (name.empty()) name = components[axis].set;
  }
  if (name.empty()) throw InputError("no record: give one file, or up to three for x, y, z");
  return set_of(name, along, meaning);
}

RecordFolder read_record_folder(const std::string& folder, const ColumnsMeaning& meaning) {
  std::error_code trouble;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder, trouble))
    if (entry.is_regular_file() && !entry.path().filename().string().starts_with('.'))
      paths.push_back(entry.path().string());
  if (trouble) throw InputError("{}: {}: give a folder of record files", folder, trouble.message());
  std::ranges::sort(paths);

  RecordFolder found;
  std::vector<Component> components;
  for (const std::string& path : paths) try {
      components.push_back(read_component(path, meaning));
    } catch (const std::exception& error) {
      found.left_out.emplace_back(error.what());
    }
  std::map<std::string, std::vector<const Component*>> sets;
  for (const Component& c : components) sets[c.set].push_back(&c);
  for (const auto& [name, members] : sets) try {
      found.sets.push_back(set_of(name, along_axes(members), meaning));
    } catch (const std::exception& error) {
      found.left_out.push_back(fmt::format("{} ({} files): {}", name, members.size(), error.what()));
    }
  if (found.sets.empty())
    throw InputError("{}: no record with two horizontal components among {} files{}{}", folder, paths.size(),
                     found.left_out.empty() ? "" : "; the first that was left out: ",
                     found.left_out.empty() ? "" : found.left_out.front());
  return found;
}

}  // namespace voussoir
