// Ground motions of three components, found among the files of a folder.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "io/records/format.h"
#include "solver/step/settings.h"

namespace voussoir {

/// What files of plain columns do not say themselves.
struct ColumnsMeaning {
  std::string units = "m/s2";  // m/s2, g or cm/s2
  double dt = 0.005;           // s, of those with one column
};
/// m/s2. Throws InputError for another word than m/s2, g, cm/s2.
double acceleration_unit(const std::string& name);
const std::vector<std::string>& acceleration_units();

/// One recording: a station in an event.
struct RecordSet {
  std::string name, event, station;
  std::array<std::string, 3> files, components;  // along x, y, z; empty where there is none; as the files call them
  std::string format;
  std::string units;    // of plain columns; empty where the format says them
  double dt = 0.0;      // s, of single columns; 0 where the file says it
  GroundMotion motion;  // m/s2; components that end sooner go on with zeros, those of larger steps are resampled
};

struct RecordFolder {
  std::vector<RecordSet> sets;        // by name
  std::vector<std::string> left_out;  // "FILE: why"
};

/// Where a component with this name points: 0 east-west, 1 north-south, 2 vertical; −1: it does not say ("H1", "140").
int component_axis(const std::string& name);

/// Groups the files of a folder by what their names and headings share beside the component. East-west goes along x,
/// north-south along y; two that do not say where they point in the order of their names, numbers by size. Whatever is
/// no record, or lacks a second horizontal, is left out and said; a damaged file loses its set, not the others. Throws
/// InputError when there is no such folder or no set in it.
RecordFolder read_record_folder(const std::string& folder, const ColumnsMeaning& meaning = {});

/// One set of up to three files for x, y, z ("" for none).
RecordSet read_record_set(const std::array<std::string, 3>& files, const ColumnsMeaning& meaning = {});

/// Components on one time grid, that of the smallest step, in m/s2. `units` hold for files that do not say theirs.
GroundMotion join_components(const std::array<const RecordFile*, 3>& files, double unit);

}  // namespace voussoir
