// What a campaign file asks for.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/case/case.h"

namespace voussoir::campaign {

/// A ground motion that all cases are shaken by.
struct Shaking {
  std::string name, event;  // of which earthquake; its name where that is not known
  MotionSource source;      // its `scale` is the record's own factor
};

/// Numbers of the case that are drawn anew for each sample, together: they share one random number.
struct Sampled {
  enum class Distribution { lognormal, normal, uniform };
  std::vector<std::string> keys;  // "materials.masonry.youngs_modulus"; lists of tables count from 1: "effect.1.mass"
  Distribution distribution = Distribution::lognormal;
  double cov = 0.0;                   // standard deviation over mean
  double deviation = 0.0;             // standard deviation, in the key's unit; one of the two is given
  double mean = 0.0;                  // in the key's unit
  bool own_mean = false;              // else it is the case's value
  double low = -1e300, high = 1e300;  // what lies outside is drawn again; the range of a uniform distribution
};
const std::vector<std::string>& distributions();  // in the order of the enumeration

struct PlannedLimit : DemandLimit {
  std::string only;  // name of a case; empty: all
};

struct EngineSettings {
  std::string kind = "local";
  int runs_at_once = 0;     // 0: as many as there are cores; no limit under Slurm
  int threads = 0;          // of each run; 0: what the cores leave, 1 under Slurm
  double time_limit = 0.0;  // s of wall time of a run; 0: none
  double memory = 0.0;      // MB of a run; 0: Slurm's default
  std::string partition, account, qos;
  std::vector<std::string> options;  // further ones of sbatch, each a word of its own
};

/// When a run is ended because the bridge has fallen.
struct FallSettings {
  double displacement = 1.0;  // m, of a block from where it stood under gravity, relative to the ground
  double share = 0.05;        // of the mass that can move, which has gone farther than that; 0: never
};

/// How each run is made.
struct RunSettings {
  double block_scale = 0.0;                         // 0: the case's
  std::vector<std::pair<std::string, double>> set;  // numbers of the cases by their dotted keys, the same in all runs
  double free_after = 0.0;                          // s of free vibration after the motion; 0: what the case has
  FallSettings fall;
  double fields_every = -1.0;  // s; below 0: the case's
  bool pictures = false, keep_checkpoints = false;
};

struct Settings {
  std::string path, text;          // the file and its contents
  std::vector<std::string> cases;  // files as opened
  std::vector<Shaking> records;
  std::vector<std::string> left_out;  // of a folder of records, each reason once
  std::vector<double> scales = {1.0};
  int samples = 0;  // 0: the case as it is
  std::uint64_t seed = 1;
  std::vector<Sampled> sampled;
  double duration = 0.0;        // s, the longest; 0: the record's
  bool significant = false;     // from 2 s before 5 % until 95 % of the Arias intensity have passed
  std::vector<double> periods;  // s, of im.sa_…
  RunSettings run;
  std::vector<PlannedLimit> limit_states;
  EngineSettings engine;
};

/// Reads and checks a campaign file and the records it names (relative to its folder). Throws InputError "FILE:LINE:
/// …".
Settings read_settings(const std::string& path);

/// "records" of a campaign: a selection (JSON) or a folder of record files. `units` and `dt` are of plain columns, as
/// in a motion stage. Throws InputError.
std::vector<Shaking> read_selection(const std::string& path, bool correct);
std::vector<Shaking> read_folder(const std::string& path, const std::string& units, double dt, bool correct,
                                 std::vector<std::string>& left_out);

}  // namespace voussoir::campaign
