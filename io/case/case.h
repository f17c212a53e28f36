// A case: the contents of one TOML file, checked and in SI units.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/generator.h"
#include "solver/effects/effect.h"
#include "solver/model/settings.h"
#include "solver/motion/pulse.h"
#include "solver/motion/synthesis.h"

namespace voussoir {

/// A sensor of the case. attach_sensors() finds its block.
struct SensorSpec {
  std::string id;
  Vec3 position = Vec3::Zero();   // m
  Vec3 direction = Vec3::Zero();  // unit
};

/// The source of the ground motion of a stage. Texts of records are kept for the copies in a run directory.
struct MotionSource {
  enum class Kind { none, record, pulse, synthetic };
  Kind kind = Kind::none;
  /// record: paths as opened, and contents, for x, y, z; empty: no motion along that axis. A file with several channels
  /// must be the only one; it contains all axes.
  std::array<std::string, 3> files, texts;
  std::string units = "m/s2";             // record: unit of plain columns: m/s2, g or cm/s2
  double dt = 0.0;                        // s, record: time step; 0: as in the file
  std::vector<std::string> columns = {};  // record: meaning of the columns of a table; empty: as in the file
  bool correct = false;                   // record: baseline correction
  double begin = 0.0;                     // s, record: samples before this time are left out
  double pga = 0.0;    // m/s2: the largest acceleration along any axis is scaled to this; 0: no scaling
  double scale = 1.0;  // factor on the acceleration, applied after pga
  PulseSettings pulse;
  SyntheticSettings synthetic;
};

/// A measured curve that is drawn with a computed one, in the units of the plot: two columns of text.
struct MeasuredCurve {
  std::string file, label;
  std::string text;  // contents of the file; empty if there is no such file
};

/// A picture that is drawn at the end of a run: one channel of the history plotted against another.
struct PlotSpec {
  std::string name;                       // name of the file in images/, without .png
  std::string title, label = "computed";  // text above the chart; name in the legend
  std::string x = "time", y;              // channels
  double x_factor = 1.0, y_factor = 1.0;  // factors to the units of the plot
  std::string x_label, y_label;           // empty: the channel and, without a factor, its unit
  std::vector<MeasuredCurve> measured;
};

/// A period from a measurement or another program, shown with the computed one.
struct ExpectedPeriod {
  std::string direction;  // as ModeWords
  int order = 1;
  double period = 0.0;  // s
  std::string source;
};

/// A threshold of a demand or of damage, for the fragility of a campaign.
struct DemandLimit {
  std::string name, demand;  // demand: a column of the table of a campaign, "edp.keystone_x"
  double threshold = 0.0;    // in the unit of the column
};

struct Case {
  std::string path, text;          // the file and its contents
  std::string generator;           // name; empty if the assembly comes from a file
  std::string assembly_file;       // path relative to the current folder, or empty
  GeneratorInput generator_input;  // has the joint overrides also if the assembly comes from a file
  SolverSettings settings;
  std::vector<MotionSource> motions;  // one per stage of settings
  std::vector<SensorSpec> sensors;
  std::vector<EffectSetting> effects;
  std::vector<PlotSpec> plots;
  std::vector<ExpectedPeriod> expected_periods;
  std::vector<DemandLimit> limits;
  /// Hash of the resolved text without modes, plots and limit states, and of the records. It is equal for a case and
  /// its resolved copy. It does not cover the contents of an assembly file; see assembly_hash().
  std::uint64_t hash = 0;
};

/// Purpose for which a case is read: a case for geometry or modes may have no [[stage]].
enum class CaseUse { run, geometry };

/// Reads and checks a case file and the records it names (relative to its folder). Throws InputError "FILE:LINE: …"
/// with the value found, the value expected and, for a misspelt word, the word that was probably meant.
Case read_case(const std::string& path, CaseUse use = CaseUse::run);
/// The same for a text. `path` is used in messages, and relative names begin at its folder.
Case parse_case(const std::string& text, const std::string& path, CaseUse use = CaseUse::run);

/// A TOML text with every key written out. It gives the same case bit for bit if it is read in a folder that has the
/// records of the case as motion_<stage>_<axis>.txt, the measured curves of its plots as measured_<plot>_<curve>.txt
/// and, if the case names an assembly file, that file as assembly.h5.
std::string resolved_text(const Case& c);
/// The [[effect]] tables of a case file.
std::string effects_text(const std::vector<EffectSetting>& effects);
/// Writes DIRECTORY/case.toml with resolved_text(), and records and measured curves into the same folder. Throws
/// RunError.
void write_resolved_case(const Case& c, const std::string& directory);
/// The same with a copy of the assembly file, if the case has one, as DIRECTORY/assembly.h5.
void write_self_contained_case(const Case& c, const std::string& directory);
/// Whether a file with that name in a run directory is one of those records or curves.
bool is_copy_for_case(const std::string& name);

/// The assembly of the case: generated, or read from its file with the joint overrides; with its effects and sensors.
/// Throws InputError, and RunError if a deformable fill cannot be meshed.
Assembly make_assembly(const Case& c);
/// Attaches each sensor to its nearest block. Throws InputError for a sensor more than 0.05 m away from every block.
void attach_sensors(Assembly& assembly, const std::vector<SensorSpec>& sensors);

/// Words of case files, in the order of their enumerations.
const std::vector<std::string>& stage_kinds();
const std::vector<std::string>& gravity_methods();
const std::vector<std::string>& damping_kinds();
const std::vector<std::string>& modal_states();
const std::vector<std::string>& mode_directions();

}  // namespace voussoir
