// Ground motions of three components, found among the files of a folder.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "io/records/format.h"
#include "solver/model/settings.h"

namespace voussoir {

/// Separators of the words in the name of a file.
constexpr std::string_view name_separators = "_-. ";

/// Information that files of plain columns do not contain.
struct ColumnsMeaning {
  std::string units = "m/s2";             // m/s2, g or cm/s2
  double dt = 0.005;                      // s, of files without times
  std::vector<std::string> columns = {};  // of a table: "t", "x", "y", "z", ""; empty: as in its heading
};
/// The size of a unit in m/s2. Throws InputError for other words than m/s2, g, cm/s2.
double acceleration_unit(const std::string& name);
const std::vector<std::string>& acceleration_units();

/// One recording: a station in an event.
struct RecordSet {
  std::string name, event, station;
  std::array<std::string, 3> files;       // along x, y, z; empty: none; a file of several channels is the first
  std::array<std::string, 3> components;  // as named in the files
  std::string format;
  std::string units;    // unit of plain columns; empty if the format states it
  double dt = 0.0;      // s, of single columns; 0 if the file states it
  GroundMotion motion;  // m/s2; shorter components end in zeros, components with larger time steps are resampled
};

struct RecordFolder {
  std::vector<RecordSet> sets;        // by name
  std::vector<std::string> left_out;  // each reason once, with its files and recordings
};

/// Direction of a component by its name: 0 east-west, 1 north-south, 2 vertical; −1: the name does not state it ("H1",
/// "140").
int component_axis(const std::string& name);

/// Groups the files of a folder by their names without the component (numbers are compared as numbers); files of
/// incomplete groups are grouped by event and station of their headings. A file of several channels is a recording.
/// East-west acts along x, north-south along y; two components without direction are used in the order of their names,
/// numbers by value. Files that are not records, and recordings without a second horizontal component, are left out and
/// reported; a damaged file affects only its own recording. Throws InputError if there is no such folder, or no
/// recording in it.
RecordFolder read_record_folder(const std::string& folder, const ColumnsMeaning& meaning = {});

/// One recording from up to three files for x, y, z ("": none), or from one file with several channels.
RecordSet read_record_set(const std::array<std::string, 3>& files, const ColumnsMeaning& meaning = {});

/// The motion of such files with the contents `texts`, m/s2. `meaning.dt` > 0 replaces the time step of each file.
GroundMotion record_motion(const std::array<std::string, 3>& files, const std::array<std::string, 3>& texts,
                           const ColumnsMeaning& meaning);

/// Components with one time step, the smallest of all, in m/s2. `unit` (m/s2) is for files that do not state their
/// unit. Throws InputError for samples above 1e4 m/s2.
GroundMotion join_components(const std::array<const RecordFile*, 3>& files, double unit);

}  // namespace voussoir
