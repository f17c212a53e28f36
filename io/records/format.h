// Files of ground motion, recognised by their content. A new format needs one file here and one line in format.cpp.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/records/columns.h"

namespace voussoir {

/// A component as in its file.
struct RecordFile {
  Record record;
  std::string format;                     // "PEER AT2"
  double unit = 0.0;                      // m/s2, unit of its numbers; 0: the file does not state it
  std::string event, station, component;  // names in the file; empty: not stated
  std::string path;                       // name of the file in messages
};

struct RecordFormat {
  std::string name;
  double unit = 0.0;  // m/s2, unit of its numbers; 0: the file does not state it
  bool (*recognises)(std::string_view text) = nullptr;
  /// The channels of a file, in its order. `dt` > 0 (s) replaces the time step of the file, which some files give with
  /// few digits. Throws InputError "NAME:ROW: …" for contents that the format does not allow.
  std::vector<RecordFile> (*read)(const std::string& text, const std::string& name, double dt) = nullptr;
};

/// All formats, in the order in which they are tried; plain columns are the last one.
const std::vector<RecordFormat>& record_formats();
const RecordFormat& recognise(std::string_view text);
/// All channels of a file. `columns` gives the meaning of the columns of a table in their order: "t", "x", "y", "z", ""
/// (skipped); empty: as in the file.
std::vector<RecordFile> parse_channels(const std::string& text, const std::string& name, double dt = 0.0,
                                       const std::vector<std::string>& columns = {});
/// The channel of a file with one channel. Throws InputError if it has several.
RecordFile parse_record(const std::string& text, const std::string& name, double dt = 0.0);
RecordFile read_record(const std::string& path, double dt = 0.0);
/// Whether a text has numbers without times, so that the time step is not known.
bool columns_without_time(std::string_view text);

/// For readers of files with one channel.
template <RecordFile (*read)(const std::string&, const std::string&, double)>
std::vector<RecordFile> one_channel(const std::string& text, const std::string& name, double dt) {
  return {read(text, name, dt)};
}

RecordFormat peer_at2();
RecordFormat dyna();
RecordFormat csmip_v2();
RecordFormat cosmos();
RecordFormat smc();
RecordFormat geonet();
RecordFormat knet();
RecordFormat afad();
RecordFormat cwa();
RecordFormat table_with_units();
RecordFormat headed_table();
RecordFormat plain_columns();

}  // namespace voussoir
