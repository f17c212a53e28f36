// A case: what a user asks for in one TOML file, checked and in SI units.
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

/// A sensor as the case names it; which block it sits on is known once there is an assembly.
struct SensorSpec {
  std::string id;
  Vec3 position = Vec3::Zero();   // m
  Vec3 direction = Vec3::Zero();  // unit
};

/// Where a stage's ground motion comes from. Record texts are kept, so that a run directory can hold its own copies.
struct MotionSource {
  enum class Kind { none, record, pulse, synthetic };
  Kind kind = Kind::none;
  std::array<std::string, 3> files,
      texts;                              // record: paths as opened, and contents; empty for no motion along that axis
  std::string units = "m/s2";             // record: m/s2, g or cm/s2; of plain columns
  double dt = 0.0;                        // s; record without times
  std::vector<std::string> columns = {};  // record: what those of a table are; none: as the file says
  bool correct = false;                   // record: baseline correction
  double begin = 0.0;                     // s, record: what comes before is left out
  double pga = 0.0;                       // m/s2 that the largest acceleration along any axis is scaled to; 0: not
  double scale = 1.0;                     // after that
  PulseSettings pulse;
  SyntheticSettings synthetic;
};

/// A curve from elsewhere beside a plotted one, in the plot's units: two columns of text.
struct MeasuredCurve {
  std::string file, label;
  std::string text;  // the file's; empty when there is no such file
};

/// A picture to draw at the end of a run: one history channel over another.
struct PlotSpec {
  std::string name;                       // of the file in images/, without .png
  std::string title, label = "computed";  // above the chart; in the legend
  std::string x = "time", y;              // channels
  double x_factor = 1.0, y_factor = 1.0;  // to the plot's units
  std::string x_label, y_label;           // empty: the channel and, without a factor, its unit
  std::vector<MeasuredCurve> measured;
};

/// A period from elsewhere, to be shown beside the computed one.
struct ExpectedPeriod {
  std::string direction;  // as ModeWords
  int order = 1;
  double period = 0.0;  // s
  std::string source;
};

/// A threshold of a demand or of damage that a campaign's fragility counts passings of.
struct DemandLimit {
  std::string name, demand;  // demand: a column of a campaign's table, "edp.keystone_x"
  double threshold = 0.0;    // in the column's unit
};

struct Case {
  std::string path, text;          // the file and its contents
  std::string generator;           // name, or empty when the assembly comes from a file
  std::string assembly_file;       // path from the current folder, or empty
  GeneratorInput generator_input;  // also the joint overrides when the assembly comes from a file
  SolverSettings settings;
  std::vector<MotionSource> motions;  // one per stage of settings
  std::vector<SensorSpec> sensors;
  std::vector<EffectSetting> effects;
  std::vector<PlotSpec> plots;
  std::vector<ExpectedPeriod> expected_periods;
  std::vector<DemandLimit> limits;
  std::uint64_t hash =
      0;  // of the resolved text without modes and plots, and the records: equal for a case and its resolved copy
};

/// What a case is read for: a case for geometry or modes may have no [[stage]].
enum class CaseUse { run, geometry };

/// Reads and checks a case file and the records it names (relative to its folder). Throws InputError
/// "FILE:LINE: …" that says what was found, what is right and, for a misspelt word, which one was probably meant.
Case read_case(const std::string& path, CaseUse use = CaseUse::run);
/// The same for a text that is not (or no longer) a file; `path` stands in messages and for relative names.
Case parse_case(const std::string& text, const std::string& path, CaseUse use = CaseUse::run);

/// A TOML text with every key written out. Read in a folder with the case's records as motion_<stage>_<axis>.txt and,
/// for a case that names an assembly file, with that file as assembly.h5, it gives the same case bit for bit.
std::string resolved_text(const Case& c);
/// [[effect]] tables as a case has them.
std::string effects_text(const std::vector<EffectSetting>& effects);
/// Writes DIRECTORY/case.toml = resolved_text() and the records beside it. Throws RunError.
void write_resolved_case(const Case& c, const std::string& directory);
/// Whether a file of that name in a run directory is one of those records.
bool is_copy_for_case(const std::string& name);

/// The case's assembly: generated, or read from its file with the case's joint overrides; with its effects and sensors.
/// Throws InputError.
Assembly make_assembly(const Case& c);
/// Puts each sensor on the block that holds it. Throws InputError naming a sensor more than 0.05 m off every block.
void attach_sensors(Assembly& assembly, const std::vector<SensorSpec>& sensors);

/// Words used in case files, in the order of the enumerations they stand for.
const std::vector<std::string>& stage_kinds();
const std::vector<std::string>& gravity_methods();
const std::vector<std::string>& damping_kinds();
const std::vector<std::string>& modal_states();
const std::vector<std::string>& mode_directions();

}  // namespace voussoir
