#include "io/records/not_read.h"

#include <cctype>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

struct Known {
  const char *mark, *name;  // in capitals, within the first lines
};
constexpr Known others[] = {{"UNCORRECTED ACCELEROGRAM DATA", "CSMIP volume 1 (uncorrected)"},
                            {"RESPONSE AND FOURIER AMPLITUDE SPECTRA", "CSMIP volume 3 (spectra)"},
                            {"WID2", "GSE2"},
                            {"ARCHIVO ESTANDAR DE ACELERACION", "the standard file of UNAM"},
                            {"ISMN BUILDING", "BHRC of Iran"},
                            {"BUILDING & HOUSING RESEARCH", "BHRC of Iran"},
                            {"<?XML", "XML"},
                            {"<!DOCTYPE", "a web page"},
                            {"<HTML", "a web page"}};

/// "000001D ": six figures, a letter, a blank.
bool is_miniseed(std::string_view text) {
  if (text.size() < 48 || std::string_view("DRQM").find(text[6]) == std::string_view::npos) return false;
  for (const char c : text.substr(0, 6))
    if (!std::isdigit(static_cast<unsigned char>(c))) return false;
  return text[7] == ' ' || text[7] == '\0';
}

std::string name_of(std::string_view text) {
  if (text.starts_with("PK\x03\x04")) return "a zip archive; unpack it";
  if (text.starts_with("\x1f\x8b")) return "a gzip archive; unpack it";
  if (is_miniseed(text)) return "miniSEED";
  const std::string head = upper(text.substr(0, 300));
  for (const Known& other : others)
    if (head.find(other.mark) != std::string::npos) return other.name;
  if (text.substr(0, 1000).find('\0') != std::string_view::npos) return "not text";
  return "";
}

std::string formats_text() {
  std::string text;
  for (const RecordFormat& format : record_formats()) text += (text.empty() ? "" : ", ") + format.name;
  return text;
}

/// The printable part of the first line that is not empty.
std::string first_line(std::string_view text) {
  for (const std::string_view line : lines_of(text.substr(0, 2000))) {
    std::string excerpt;
    for (const char c : trimmed(line).substr(0, 60))
      excerpt += std::isprint(static_cast<unsigned char>(c)) || (c & 0x80) ? c : '?';
    if (!excerpt.empty()) return excerpt;
  }
  return "";
}

}  // namespace

void not_read(std::string_view text, const std::string& name) {
  const std::string other = name_of(text);
  throw InputError(
      "{}:1: the format of this file is not known. It begins with '{}'{}. The known formats are: {}. Convert other "
      "files into a table below a line of names and units, such as 'time (s), EW (g), NS (g), UD (g)', or into rows of "
      "time and acceleration.",
      name, other == "not text" || other == "miniSEED" ? "" : first_line(text),
      other.empty() ? "" : ", which is " + other, formats_text());
}

}  // namespace voussoir
