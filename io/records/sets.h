// Ground motions of three components, found among the files of a folder.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "io/records/format.h"
#include "solver/model/settings.h"

namespace voussoir {

/// What stands between the words of a file's name.
constexpr std::string_view name_separators = "_-. ";

/// What files of plain columns do not say themselves.
struct ColumnsMeaning {
  std::string units = "m/s2";             // m/s2, g or cm/s2
  double dt = 0.005;                      // s, of those without times
  std::vector<std::string> columns = {};  // of a table: "t", "x", "y", "z", ""; none: as its heading says
};
/// m/s2. Throws InputError for another word than m/s2, g, cm/s2.
double acceleration_unit(const std::string& name);
const std::vector<std::string>& acceleration_units();

/// One recording: a station in an event.
struct RecordSet {
  std::string name, event, station;
  std::array<std::string, 3> files;       // along x, y, z; empty where there is none; a file of several channels first
  std::array<std::string, 3> components;  // as the files call them
  std::string format;
  std::string units;    // of plain columns; empty where the format says them
  double dt = 0.0;      // s, of single columns; 0 where the file says it
  GroundMotion motion;  // m/s2; components that end sooner go on with zeros, those of larger steps are resampled
};

struct RecordFolder {
  std::vector<RecordSet> sets;        // by name
  std::vector<std::string> left_out;  // each reason once, with the files and recordings that it is of
};

/// Where a component with this name points: 0 east-west, 1 north-south, 2 vertical; −1: it does not say ("H1", "140").
int component_axis(const std::string& name);

/// Groups the files of a folder by what their names share beside the component, numbers as numbers; what is not
/// complete then by event and station of their headings. A file of several channels is a recording. East-west goes
/// along x, north-south along y; two that do not say where they point in the order of their names, numbers by size.
/// Whatever is no record, or lacks a second horizontal, is left out and said; a damaged file loses its set, not the
/// others. Throws InputError when there is no such folder or no set in it.
RecordFolder read_record_folder(const std::string& folder, const ColumnsMeaning& meaning = {});

/// One set of up to three files for x, y, z ("" for none), or of one file with several channels.
RecordSet read_record_set(const std::array<std::string, 3>& files, const ColumnsMeaning& meaning = {});

/// The motion of such files whose contents are `texts`, m/s2. `meaning.dt` > 0 replaces the step of each of them.
GroundMotion record_motion(const std::array<std::string, 3>& files, const std::array<std::string, 3>& texts,
                           const ColumnsMeaning& meaning);

/// Components on one time grid, that of the smallest step, in m/s2. `unit` (m/s2) holds for files that do not say
/// theirs. Throws InputError for samples beyond 1e4 m/s2.
GroundMotion join_components(const std::array<const RecordFile*, 3>& files, double unit);

}  // namespace voussoir
