#include "io/hdf5/history_file.h"

#include <algorithm>

#include "io/hdf5/h5.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {
constexpr std::int64_t history_format_version = 1;
}

History::History(std::string path, std::vector<Channel> channels)
    : path_(std::move(path)), channels_(std::move(channels)), columns_(channels_.size()) {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].path.empty()) throw InputError("{}: channel {} has no name", path_, i);
    if (!index_.emplace(channels_[i].path, i).second)
      throw InputError("{}: channel \"{}\" is listed twice. Names must differ.", path_, channels_[i].path);
  }
  if (channels_.empty() || channels_[0].path != "time")
    throw InputError("{}: the first channel must be \"time\"", path_);
}

History History::load(const std::string& path) {
  const h5::File file = h5::File::open(path);
  h5::check_format(file, "voussoir-history", history_format_version);
  std::vector<Channel> channels;
  for (const std::string& name : file.texts("/", "channels")) channels.push_back({name, file.unit(name)});
  History history(path, std::move(channels));
  for (std::size_t i = 0; i < history.channels_.size(); ++i) {
    const std::size_t rows = i == 0 ? h5::any : history.columns_[0].size();
    history.columns_[i] = file.read<double>(history.channels_[i].path, {rows});
  }
  return history;
}

void History::append(std::span<const double> row) {
  if (row.size() != channels_.size())
    throw RunError("{}: a row has {} for {}", path_, counted(row.size(), "value"),
                   counted(channels_.size(), "channel"));
  for (std::size_t i = 0; i < row.size(); ++i) columns_[i].push_back(row[i]);
}

void History::flush() {
  h5::File file = h5::File::create(path_);
  file.set_text("/", "format", "voussoir-history");
  file.set_integer("/", "format_version", history_format_version);
  file.set_text("/", "units", "SI");
  file.set_text("/", "program_version", VOUSSOIR_VERSION);
  std::vector<std::string> names;
  for (const Channel& channel : channels_) names.push_back(channel.path);
  file.set_texts("/", "channels", names);
  for (std::size_t i = 0; i < channels_.size(); ++i)
    file.write<double>(channels_[i].path, columns_[i], {}, channels_[i].unit);
  file.save();
}

void History::keep_first(std::size_t count) {
  for (std::vector<double>& column : columns_) column.resize(std::min(column.size(), count));
}

std::size_t History::index_of(const std::string& channel) const {
  const auto found = index_.find(channel);
  if (found != index_.end()) return found->second;
  std::string known;
  for (const Channel& c : channels_) known += (known.empty() ? "" : ", ") + c.path;
  throw InputError("{}: there is no channel \"{}\"; it has: {}", path_, channel, known);
}

const std::vector<double>& History::values(const std::string& channel) const {
  return columns_[index_of(channel)];
}

}  // namespace voussoir
