// What the parts of `voussoir motion` share: the records asked for, the target, what is said of motions.
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

/// --units, --dt, --columns: of plain columns.
void add_columns_options(CommandLine& line);
ColumnsMeaning columns_asked(const options::variables_map& values);
/// --target, --ag, --f0, --tc, --soil, --topography, --damping.
void add_target_options(CommandLine& line);
/// None without --target. Throws InputError for what is missing or wrong.
std::optional<TargetSpectrum> target_asked(const options::variables_map& values);
std::string target_text(const TargetSpectrum& target);
nlohmann::json target_json(const TargetSpectrum& target);
/// m/s2 at these periods.
std::vector<double> target_values(const TargetSpectrum& target, const std::vector<double>& periods);

/// The sets of a folder, or one of up to three files for x, y, z. What was left out and what was assumed is printed on
/// the error stream unless quiet.
std::vector<RecordSet> records_asked(const std::vector<std::string>& paths, const ColumnsMeaning& meaning, bool quiet);

/// What to mind of spectra that begin at this period (s): between samples peaks are cut off, which shows below ten
/// steps. Empty where all records have shorter steps.
std::string short_period_remark(const std::vector<RecordSet>& sets, double shortest);

/// From 0.01 s to 4 s, evenly in the logarithm: for charts and tables of spectra.
std::vector<double> chart_periods();
/// Of each component (of zeros: none) at the periods, m/s2.
std::array<std::vector<double>, 3> spectra_of(const GroundMotion& motion, const std::vector<double>& periods,
                                              double damping);
std::array<Intensity, 3> intensities_of(const GroundMotion& motion);
bool shaken(const GroundMotion& motion, int axis);

nlohmann::json intensity_json(const Intensity& intensity);
nlohmann::json record_json(const RecordSet& set, const std::string& relative_to);
/// A row of measures for people and its heading; `factor` multiplies the motion.
std::string measures_heading();
std::string measures_row(const std::string& name, const std::array<Intensity, 3>& of, double factor = 1.0);
/// The same as a table of a page.
std::string measures_table(const std::vector<std::string>& names, const std::vector<std::array<Intensity, 3>>& of,
                           const std::vector<double>& factors);
/// Acceleration, velocity and displacement of the three components, one chart below the other.
std::string histories_figure(const std::string& name, const GroundMotion& motion);

extern const char* const axis_colour[3];
extern const char* const axis_word[3];

/// DIR/NAME_x.txt, _y, _z: time and acceleration in columns, m/s2, `about` in their headings. The names of the files.
std::array<std::string, 3> write_motion_files(const std::string& directory, const std::string& name,
                                              const GroundMotion& motion, const std::string& about);

}  // namespace voussoir
