#include "io/records/format.h"

#include "io/hdf5/atomic_file.h"
#include "io/records/rows.h"

namespace voussoir {

const std::vector<RecordFormat>& record_formats() {
  static const std::vector<RecordFormat> list = {
      peer_at2(),  //
      dyna(),      //
      csmip_v2(),  //
      plain_columns(),
  };
  return list;
}

const RecordFormat& recognise(std::string_view text) {
  for (const RecordFormat& format : record_formats())
    if (format.recognises(text)) return format;
  return record_formats().back();
}

RecordFile parse_record(const std::string& text, const std::string& name, double dt) {
  const RecordFormat& format = recognise(text);
  RecordFile file = format.read(text, name, dt);
  file.format = format.name, file.unit = format.unit;
  return file;
}

RecordFile read_record(const std::string& path, double dt) {
  return parse_record(read_text(path), path, dt);
}

bool columns_without_time(std::string_view text) {
  if (recognise(text).unit > 0.0) return false;
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
            return file;
          }};
}

}  // namespace voussoir
