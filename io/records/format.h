// Files of ground motion, one component each, recognised by what they contain. A new format is one file here and one
// line in format.cpp.
#pragma once
#include <string>
#include <string_view>

#include "io/records/columns.h"

namespace voussoir {

/// A component as its file has it.
struct RecordFile {
  Record record;
  std::string format;                     // "PEER AT2"
  double unit = 0.0;                      // m/s2, of the format
  std::string event, station, component;  // as the file names them; empty where it does not
};

struct RecordFormat {
  std::string name;
  double unit = 0.0;  // m/s2 of its numbers; 0: the file does not say
  bool (*recognises)(std::string_view text) = nullptr;
  /// Throws InputError "NAME:ROW: …" for what is not as the format says. `dt` > 0 (s) replaces the file's own step,
  /// which some files give with few digits.
  RecordFile (*read)(const std::string& text, const std::string& name, double dt) = nullptr;
};

/// All of them, in the order in which they are tried; plain columns are the last.
const std::vector<RecordFormat>& record_formats();
const RecordFormat& recognise(std::string_view text);
RecordFile parse_record(const std::string& text, const std::string& name, double dt = 0.0);
RecordFile read_record(const std::string& path, double dt = 0.0);
/// Plain numbers, one a row in the first row that has any.
bool columns_without_time(std::string_view text);

RecordFormat peer_at2();
RecordFormat dyna();
RecordFormat csmip_v2();
RecordFormat plain_columns();

}  // namespace voussoir
