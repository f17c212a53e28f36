#include <toml++/toml.h>

#include <cassert>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "io/measured/parts.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// The shortest text that is read back as the same number.
std::string number_cell(double value) {
  return fmt::format("{}", value);
}
std::string given_cell(double value) {
  return value == 0.0 ? "" : number_cell(value);
}

std::string direction_cell(const Vec3& d) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(d[i]) == 1.0 && d[(i + 1) % 3] == 0.0 && d[(i + 2) % 3] == 0.0)
      return fmt::format("{}{}", d[i] < 0.0 ? "-" : "", "xyz"[i]);
  return csv_cell(fmt::format("{};{};{}", d.x(), d.y(), d.z()));
}

std::string sensors_text(const Measured& measured) {
  std::string text = "id,x,y,z,direction\n";
  for (const MeasuredSensor& s : measured.sensors)
    text += fmt::format("{},{},{},{},{}\n", csv_cell(s.id), s.position.x(), s.position.y(), s.position.z(),
                        direction_cell(s.direction));
  return text;
}

std::string modes_text(const Measured& measured) {
  std::string text = "mode,period,period_std,damping,damping_std,direction\n";
  for (const MeasuredMode& m : measured.modes)
    text += fmt::format("{},{},{},{},{},{}\n", csv_cell(m.name), m.period, given_cell(m.period_std),
                        m.damping ? number_cell(*m.damping) : "", given_cell(m.damping_std), m.direction);
  return text;
}

/// Empty when no mode has a shape.
std::string shapes_text(const Measured& measured) {
  std::string text;
  for (const MeasuredMode& m : measured.modes)
    for (const MeasuredValue& v : m.shape) {
      assert(v.sensor < measured.sensors.size());
      text += fmt::format("{},{},{},{}\n", csv_cell(m.name), csv_cell(measured.sensors[v.sensor].id), v.value,
                          given_cell(v.std));
    }
  return text.empty() ? text : fmt::format("mode,sensor,value,std\n{}", text);
}

std::string about_text(const Measured& measured) {
  const toml::table table{{"what", measured.what}, {"when", measured.when}, {"units", "SI"}, {"notes", measured.notes}};
  std::ostringstream text;
  text << toml::toml_formatter{table, toml::format_flags::none} << '\n';
  return text.str();
}

std::string record_text(const Recording& record) {
  assert(std::size_t(record.values.cols()) == record.channels.size());
  std::string text = "t";
  for (const std::string& channel : record.channels) text += fmt::format(",{}", csv_cell(channel));
  text += '\n';
  for (Eigen::Index i = 0; i < record.values.rows(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}", record.dt * double(i));
    for (Eigen::Index c = 0; c < record.values.cols(); ++c)
      fmt::format_to(std::back_inserter(text), ",{}", record.values(i, c));
    text += '\n';
  }
  return text;
}

std::string record_name(const Recording& record) {
  const std::string name = std::filesystem::path(record.name).filename().string();
  if (name.empty() || name.starts_with('.'))
    throw InputError("recording '{}' has no name for its file. Give it a name.", record.name);
  return fmt::format("records/{}{}", name, name.ends_with(".csv") ? "" : ".csv");
}

/// The files to be written, in the order in which they are read.
class Files {
 public:
  Files(const Measured& measured, const std::string& directory) : directory_(directory) {
    if (measured.modes.empty() && measured.records.empty())
      throw InputError("{}: there are neither modes nor recordings to write", directory);
    add("about.toml", about_text(measured), parse_about);
    if (!measured.sensors.empty()) add("sensors.csv", sensors_text(measured), parse_sensors);
    if (!measured.modes.empty()) add("modes.csv", modes_text(measured), parse_modes);
    if (const std::string text = shapes_text(measured); !text.empty()) add("shapes.csv", text, parse_shapes);
    for (const Recording& record : measured.records) {
      add(record_name(record), record_text(record), parse_record);
      read_back_.records.clear();
    }
  }

  void write() const {
    for (const TextFile& file : files_) write_atomically(file.path, file.text);
  }

  /// Throws InputError if the folder has old files, which would be read together with the new ones.
  void check_mixing() const {
    for (const char* name : {"sensors.csv", "modes.csv", "shapes.csv"}) check_old(name);
    for (const std::string& name : names_in(path_in(directory_, "records")))
      if (name.ends_with(".csv")) check_old("records/" + name);
  }

 private:
  bool has(const std::string& name) const {
    for (const TextFile& file : files_)
      if (file.name == name) return true;
    return false;
  }

  void check_old(const std::string& name) const {
    const std::string path = path_in(directory_, name);
    if (std::error_code ignored; has(name) || !std::filesystem::exists(path, ignored)) return;
    throw InputError("{}: this old file would be mixed with the new ones. Remove it, or choose another folder.", path);
  }

  /// Reads the text back at once, so that no file is written that could not be read.
  void add(const std::string& name, const std::string& text, void (*parse)(const TextFile&, Measured&)) {
    if (has(name)) throw InputError("{}: two recordings have this name. Rename one of them.", name);
    files_.push_back({path_in(directory_, name), name, text});
    parse(files_.back(), read_back_);
  }

  std::string directory_;
  std::vector<TextFile> files_;
  Measured read_back_;
};

void make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw RunError("cannot make the folder {}: {}", path, error.message());
}

}  // namespace

void write_measured(const Measured& measured, const std::string& directory) {
  const Files files(measured, directory);
  files.check_mixing();
  make_folder(measured.records.empty() ? directory : path_in(directory, "records"));
  files.write();
}

}  // namespace voussoir
