#include "io/records/format.h"

#include "io/records/rows.h"
#include "io/records/table.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

const std::vector<RecordFormat>& record_formats() {
  static const std::vector<RecordFormat> list = {
      peer_at2(),          //
      dyna(),              //
      csmip_v2(),          //
      cosmos(),            //
      smc(),               //
      geonet(),            //
      knet(),              //
      afad(),              //
      cwa(),               //
      table_with_units(),  //
      headed_table(),      //
      plain_columns(),
  };
  return list;
}

const RecordFormat& recognise(std::string_view text) {
  for (const RecordFormat& format : record_formats())
    if (format.recognises(text)) return format;
  return record_formats().back();
}

namespace {

/// A table whose columns the user names. Its unit is the heading's where that says one.
std::vector<RecordFile> named_columns(const std::string& text, const std::string& name, double dt,
                                      const std::vector<std::string>& columns) {
  TextTable table = parse_table(text, name);
  const double unit = recognise(text).unit;
  if (unit == 0.0) table.names.clear();
  std::vector<RecordFile> channels = channels_of(table, columns, name, dt);
  for (RecordFile& file : channels) {
    file.format = "columns", file.path = name;
    if (file.unit == 0.0) file.unit = unit;
  }
  return channels;
}

}  // namespace

std::vector<RecordFile> parse_channels(const std::string& text, const std::string& name, double dt,
                                       const std::vector<std::string>& columns) {
  if (!columns.empty()) return named_columns(text, name, dt, columns);
  const RecordFormat& format = recognise(text);
  std::vector<RecordFile> channels = format.read(text, name, dt);
  if (channels.empty()) throw InputError("{}: {} without a channel: fetch it again", name, format.name);
  for (RecordFile& channel : channels) {
    channel.format = format.name, channel.path = name;
    for (std::string* word : {&channel.event, &channel.station, &channel.component})
      *word = std::string(excerpt(*word));
    if (channel.unit == 0.0) channel.unit = format.unit;
  }
  return channels;
}

RecordFile parse_record(const std::string& text, const std::string& name, double dt) {
  std::vector<RecordFile> channels = parse_channels(text, name, dt);
  if (channels.size() > 1)
    throw InputError("{}: {} channels, expected one: give this file alone, for x, y and z together", name,
                     channels.size());
  return channels.front();
}

RecordFile read_record(const std::string& path, double dt) {
  return parse_record(read_text(path), path, dt);
}

bool columns_without_time(std::string_view text) {
  const RecordFormat& format = recognise(text);
  if (format.name == headed_table().name || format.name == table_with_units().name) return !has_times(text);
  if (format.unit > 0.0) return false;
  for (std::string_view line : lines_of(text)) {
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) return line.find_first_of(" \t,;") == std::string_view::npos;
  }
  return false;
}

RecordFormat plain_columns() {
  return {"columns", 0.0, [](std::string_view) { return true; },
          [](const std::string& text, const std::string& name, double dt) {
            RecordFile file;
            file.record = parse_columns(text, name, dt);
            return std::vector{file};
          }};
}

}  // namespace voussoir
