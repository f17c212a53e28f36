// Records out of a selection or a folder.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/case/sections.h"
#include "io/records/sets.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "tools/campaign/settings.h"

namespace voussoir::campaign {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A value of a JSON object, or the fallback where there is none (or null). Throws InputError for one of another type.
template <class T>
T value_of(const json& object, const std::string& key, const T& fallback, const std::string& place, const char* type) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return fallback;
  try {
    return found->get<T>();
  } catch (const json::exception&) {
    throw InputError("{}: '{}' is {}. It must be {}", place, key, found->dump().substr(0, 60), type);
  }
}

MotionSource source_of(const std::array<std::string, 3>& files, const std::string& units, double dt, bool correct) {
  MotionSource source;
  source.kind = MotionSource::Kind::record;
  source.files = files;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!files[axis].empty()) source.texts[axis] = read_text(files[axis]);
  if (!units.empty()) source.units = units;
  source.dt = dt;
  source.correct = correct;
  return source;
}

Shaking read_entry(const json& entry, const std::string& path, const std::string& place, bool correct) {
  if (!entry.is_object()) throw InputError("{} is not an object. It must have name, files, factor …", place);
  Shaking s;
  s.name = value_of<std::string>(entry, "name", "", place, "a text");
  if (s.name.empty()) throw InputError("{} has no 'name'. The table needs a name for each record", place);
  s.event = value_of<std::string>(entry, "event", s.name, place, "a text");
  if (s.event.empty()) s.event = s.name;
  const auto names = value_of<std::vector<std::string>>(entry, "files", {}, place, "a list of texts");
  if (names.empty() || names.size() > 3)
    throw InputError("{} names {}. It must name one, or up to three for x, y, z", place, counted(names.size(), "file"));
  std::array<std::string, 3> files;
  for (std::size_t axis = 0; axis < names.size(); ++axis)
    if (!names[axis].empty()) files[axis] = relative_to(path, names[axis]);
  const auto units = value_of<std::string>(entry, "units", "", place, "a text");
  if (!units.empty()) acceleration_unit(units);
  s.source = source_of(files, units, value_of<double>(entry, "dt", 0.0, place, "a number in s"), correct);
  s.source.scale = value_of<double>(entry, "factor", 1.0, place, "a number");
  return s;
}

}  // namespace

std::vector<Shaking> read_selection(const std::string& path, bool correct) {
  json file;
  try {
    file = read_json(path);
  } catch (const InputError& error) {
    throw InputError("{} Give a selection written by voussoir motion select, or a folder.", error.what());
  }
  if (!file.is_object() || !file.contains("records") || !file["records"].is_array())
    throw InputError("{} has no list 'records'. Give a selection written by voussoir motion select", path);
  std::vector<Shaking> records;
  for (const json& entry : file["records"])
    records.push_back(read_entry(entry, path, fmt::format("{}: record number {}", path, records.size() + 1), correct));
  if (records.empty()) throw InputError("{}: the list 'records' is empty. It must contain at least one record", path);
  return records;
}

std::vector<Shaking> read_folder(const std::string& path, const std::string& units, double dt, bool correct,
                                 std::vector<std::string>& left_out) {
  const RecordFolder folder = read_record_folder(path, {units, dt});
  for (const std::string& reason : folder.left_out)
    if (std::ranges::find(left_out, reason) == left_out.end()) left_out.push_back(reason);
  std::vector<Shaking> records;
  for (const RecordSet& set : folder.sets)
    records.push_back(
        {set.name, set.event.empty() ? set.name : set.event, source_of(set.files, set.units, set.dt, correct)});
  return records;
}

}  // namespace voussoir::campaign
