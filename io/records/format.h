// Files of ground motion, recognised by what they contain. A new format is one file here and one line in format.cpp.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/records/columns.h"

namespace voussoir {

/// A component as its file has it.
struct RecordFile {
  Record record;
  std::string format;                     // "PEER AT2"
  double unit = 0.0;                      // m/s2, of its numbers; 0: the file does not say
  std::string event, station, component;  // as the file names them; empty where it does not
  std::string path;                       // what messages call it
};

struct RecordFormat {
  std::string name;
  double unit = 0.0;  // m/s2 of its numbers; 0: the file does not say
  bool (*recognises)(std::string_view text) = nullptr;
  /// The channels of a file, in its order. Throws InputError "NAME:ROW: …" for what is not as the format says. `dt` > 0
  /// (s) replaces the file's own step, which some files give with few digits.
  std::vector<RecordFile> (*read)(const std::string& text, const std::string& name, double dt) = nullptr;
};

/// All of them, in the order in which they are tried; plain columns are the last.
const std::vector<RecordFormat>& record_formats();
const RecordFormat& recognise(std::string_view text);
/// All channels of a file. `columns` name those of a table in their order: "t", "x", "y", "z", "" for one that is
/// passed over; none: as the file says.
std::vector<RecordFile> parse_channels(const std::string& text, const std::string& name, double dt = 0.0,
                                       const std::vector<std::string>& columns = {});
/// The channel of a file that has one. Throws InputError for one with several.
RecordFile parse_record(const std::string& text, const std::string& name, double dt = 0.0);
RecordFile read_record(const std::string& path, double dt = 0.0);
/// Numbers without times, whose step the file does not say.
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
