// Shared by the parts of `voussoir motion`: reading of records, target spectra, tables and figures of motions.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "io/records/sets.h"
#include "solver/motion/filter.h"
#include "solver/motion/intensity.h"
#include "solver/motion/target.h"
#include "tools/voussoir/verb.h"
#include "viz/page/line_chart.h"

namespace voussoir {

int motion_info(const std::vector<std::string>& arguments);
int motion_spectrum(const std::vector<std::string>& arguments);
int motion_process(const std::vector<std::string>& arguments);
int motion_select(const std::vector<std::string>& arguments);
int motion_synthesize(const std::vector<std::string>& arguments);

/// Options for files of plain columns: --units, --dt, --columns.
void add_columns_options(CommandLine& line);
ColumnsMeaning columns_asked(const options::variables_map& values);
/// Options of the target spectrum: --target, --ag, --f0, --tc, --soil, --topography, --damping.
void add_target_options(CommandLine& line);
/// The target spectrum; empty without --target. Throws InputError if an option is missing or wrong.
std::optional<TargetSpectrum> target_asked(const options::variables_map& values);
std::string target_text(const TargetSpectrum& target);
nlohmann::json target_json(const TargetSpectrum& target);
/// Spectral accelerations of the target (m/s2) at these periods (s).
std::vector<double> target_values(const TargetSpectrum& target, const std::vector<double>& periods);

/// The record sets of a folder, or one set from up to three files for x, y and z. Unless quiet, prints to the error
/// stream which files were left out and what was assumed.
std::vector<RecordSet> records_asked(const std::vector<std::string>& paths, const ColumnsMeaning& meaning, bool quiet);

/// A remark on spectra that begin at the period `shortest` (s): below ten time steps they may be too low, because peaks
/// between samples are not recorded. Empty if the time steps of all records are short enough.
std::string short_period_remark(const std::vector<RecordSet>& sets, double shortest);

/// Periods for charts and tables of spectra: 0.01 s to 4 s, evenly spaced in the logarithm.
std::vector<double> chart_periods();
/// Spectral accelerations of each component at the periods, m/s2; empty for a component that is zero throughout.
std::array<std::vector<double>, 3> spectra_of(const GroundMotion& motion, const std::vector<double>& periods,
                                              double damping);
std::array<Intensity, 3> intensities_of(const GroundMotion& motion);
/// Whether the component along axis 0, 1 or 2 is not zero throughout.
bool shaken(const GroundMotion& motion, int axis);

nlohmann::json intensity_json(const Intensity& intensity);
nlohmann::json record_json(const RecordSet& set, const std::string& relative_to);
/// Rows of the printed table of measures, and its heading. `factor` multiplies the motion.
std::string measures_heading();
std::string measures_row(const std::string& name, const std::array<Intensity, 3>& of, double factor = 1.0);
/// The same measures as an HTML table.
std::string measures_table(const std::vector<std::string>& names, const std::vector<std::array<Intensity, 3>>& of,
                           const std::vector<double>& factors);
/// Charts of acceleration, velocity and displacement of the three components, one below the other.
std::string histories_figure(const std::string& name, const GroundMotion& motion);

extern const char* const axis_colour[3];
extern const char* const axis_word[3];

/// Writes DIR/NAME_x.txt, _y, _z with columns of time (s) and acceleration (m/s2), and `about` in the heading. Returns
/// the paths of the files. A component that is zero throughout has no file and an empty path.
std::array<std::string, 3> write_motion_files(const std::string& directory, const std::string& name,
                                              const GroundMotion& motion, const std::string& about);

}  // namespace voussoir
