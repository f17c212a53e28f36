#include "io/hdf5/checkpoint_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "io/hdf5/h5.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t checkpoint_format_version = 12;
constexpr const char* numbers_group = "header/numbers";
constexpr const char* begin_again = "begin again with voussoir run and --overwrite";

void set_hash(h5::File& file, const std::string& name, std::uint64_t value) {
  file.set_text("/", name, fmt::format("{:016x}", value));
}

std::uint64_t get_hash(const h5::File& file, const std::string& name) {
  const std::string text = file.text("/", name);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size() || text.size() != 16)
    file.fail("/", "the attribute '" + name + "' is \"" + text + "\", expected 16 hexadecimal digits");
  return value;
}

CheckpointHeader get_header(const h5::File& file) {
  CheckpointHeader header;
  header.time = file.number("/", "time");
  header.step = file.integer("/", "step");
  header.stage = file.integer("/", "stage");
  header.stage_time = file.number("/", "stage_time");
  header.assembly_hash = get_hash(file, "assembly_hash");
  header.case_hash = get_hash(file, "case_hash");
  header.state_hash = get_hash(file, "state_hash");
  header.program_version = file.text("/", "program_version");
  for (const std::string& name : file.attributes(numbers_group))
    header.numbers[name] = file.number(numbers_group, name);
  return header;
}

/// Opens a checkpoint and does `work` with it. A file of another kind is wrong input; all else that goes wrong is
/// damage.
template <class Work>
auto with_checkpoint(const std::string& path, Work&& work) {
  if (!fs::exists(path)) throw InputError("cannot read {}: there is no such file", path);
  try {
    const h5::File file = h5::File::open(path);
    h5::check_format(file, "voussoir-checkpoint", checkpoint_format_version);
    return work(file);
  } catch (const h5::ForeignFile&) {
    throw;
  } catch (const InputError& error) {
    throw RunError("checkpoint {} is damaged: {} Use the previous one.", path, error.what());
  }
}

void read_array(const h5::File& file, const NamedArray& array) {
  std::visit(
      [&](auto* values) {
        const h5::Shape shape = file.shape(array.name);
        const bool fits = array.columns > 1 ? shape.size() == 2 && shape[1] == array.columns : shape.size() == 1;
        if (!fits) file.fail(array.name, fmt::format("its rows do not have {} columns", array.columns));
        values->resize(shape[0] * array.columns);
        file.read_to(array.name, std::span(values->data(), values->size()));
      },
      array.data);
}

/// The time in a name such as 00012.500.h5.
std::optional<double> time_in_name(const fs::path& path) {
  const std::string stem = path.stem().string();
  double time = 0.0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), time);
  if (error != std::errc() || end != stem.data() + stem.size()) return std::nullopt;
  return time;
}

bool is_stage_end(const fs::path& path) {
  return path.filename().string().starts_with("stage_");
}

bool readable(const std::string& path) {
  try {
    read_checkpoint_header(path);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

double CheckpointHeader::number(const std::string& name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end())
    throw RunError("the checkpoint of t = {:.4f} s does not have the attribute '{}' of {}: {}", time, name,
                   numbers_group, begin_again);
  return found->second;
}

std::int64_t CheckpointHeader::count(const std::string& name) const {
  constexpr double most = 9e15;  // whole numbers that a double holds
  const double value = number(name);
  if (!(value >= 0.0 && value < most && value == std::floor(value)))
    throw RunError(
        "the checkpoint of t = {:.4f} s has {} for '{}' of {}, which must be a whole number of 0 or more: {}", time,
        value, name, numbers_group, begin_again);
  return std::int64_t(value);
}

std::uint64_t write_checkpoint(const std::string& path, CheckpointHeader header,
                               const std::vector<NamedArray>& arrays) {
  header.state_hash = hash_arrays(arrays);
  if (header.program_version.empty()) header.program_version = VOUSSOIR_VERSION;
  h5::File file = h5::File::create(path);
  file.set_text("/", "format", "voussoir-checkpoint");
  file.set_integer("/", "format_version", checkpoint_format_version);
  file.set_text("/", "units", "SI");
  file.set_text("/", "program_version", header.program_version);
  file.set_number("/", "time", header.time);
  file.set_integer("/", "step", header.step);
  file.set_integer("/", "stage", header.stage);
  file.set_number("/", "stage_time", header.stage_time);
  set_hash(file, "assembly_hash", header.assembly_hash);
  set_hash(file, "case_hash", header.case_hash);
  set_hash(file, "state_hash", header.state_hash);
  file.make_group(numbers_group);
  for (const auto& [name, value] : header.numbers) file.set_number(numbers_group, name, value);
  for (const NamedArray& array : arrays)
    std::visit(
        [&](const auto* values) {
          h5::Shape shape = {values->size() / array.columns};
          if (array.columns > 1) shape.push_back(array.columns);
          file.write(array.name, std::span(values->data(), values->size()), shape, array.unit);
        },
        array.data);
  file.save();
  return header.state_hash;
}

CheckpointHeader read_checkpoint_header(const std::string& path) {
  return with_checkpoint(path, get_header);
}

void read_checkpoint(const std::string& path, CheckpointHeader& header, const std::vector<NamedArray>& arrays) {
  with_checkpoint(path, [&](const h5::File& file) {
    header = get_header(file);
    if (const std::int64_t version = file.integer("/", "format_version"); version != checkpoint_format_version)
      throw h5::ForeignFile(
          "{} was written by voussoir {} and has another format (version {} instead of {}). Continue with that version "
          "of the program, or begin the run again.",
          path, header.program_version, version, checkpoint_format_version);
    for (const NamedArray& array : arrays) read_array(file, array);
    if (const std::size_t found = file.datasets().size(); found != arrays.size())
      file.fail("/", fmt::format("it has {} arrays instead of {}: another version of the program wrote it ({})", found,
                                 arrays.size(), header.program_version));
    if (const std::uint64_t digest = hash_arrays(arrays); digest != header.state_hash)
      file.fail("/", fmt::format("its digest is {:016x} instead of {:016x}", digest, header.state_hash));
  });
}

std::string checkpoint_name(double time) {
  return fmt::format("{:09.3f}.h5", time);
}

std::vector<std::string> list_checkpoints(const std::string& directory) {
  std::vector<std::pair<double, std::string>> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    if (entry.path().extension() != ".h5") continue;
    double time = -1.0;
    if (const auto named = time_in_name(entry.path())) {
      time = *named;
    } else {
      try {
        time = read_checkpoint_header(entry.path().string()).time;
      } catch (const std::runtime_error&) {  // kept at the end of the list: whoever reads it reports it
      }
    }
    found.emplace_back(time, entry.path().string());
  }
  std::sort(found.begin(), found.end(), std::greater<>());
  std::vector<std::string> paths;
  for (auto& [time, path] : found) paths.push_back(std::move(path));
  return paths;
}

int prune_checkpoints(const std::string& directory, int keep) {
  int kept = 0, removed = 0;
  std::error_code ignored;
  for (const std::string& path : list_checkpoints(directory)) {
    if (is_stage_end(path) || !readable(path)) continue;
    if (++kept > keep) removed += fs::remove(path, ignored);
  }
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (entry.path().extension() == unfinished_suffix) leftovers.push_back(entry.path());
  for (const fs::path& path : leftovers) removed += fs::remove(path, ignored);
  return removed;
}

}  // namespace voussoir
