// The settings of a campaign file.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/case/case.h"

namespace voussoir::campaign {

/// A ground motion for all cases.
struct Shaking {
  std::string name, event;  // name, and the earthquake it belongs to (the name if that is not known)
  MotionSource source;      // its `scale` is the factor of the record
};

/// Numbers of the case that are drawn together for each sample: they share one random number.
struct Sampled {
  enum class Distribution { lognormal, normal, uniform };
  std::vector<std::string> keys;  // "materials.masonry.youngs_modulus"; lists of tables count from 1: "effect.1.mass"
  Distribution distribution = Distribution::lognormal;
  double cov = 0.0;                   // standard deviation divided by mean
  double deviation = 0.0;             // standard deviation in the unit of the key; either `cov` or `deviation` is
                                      // given
  double mean = 0.0;                  // in the unit of the key
  bool own_mean = false;              // `mean` is given; otherwise the value of the case is the mean
  double low = -1e300, high = 1e300;  // values outside are drawn again; the range of a uniform distribution
};
const std::vector<std::string>& distributions();  // in the order of the enumeration

struct PlannedLimit : DemandLimit {
  std::string only;  // name of a case; empty: all
};

struct EngineSettings {
  std::string kind = "local";
  int runs_at_once = 0;     // 0: as many as there are cores; no limit under Slurm
  int threads = 0;          // threads of each run; 0: according to the cores; under Slurm 1
  double time_limit = 0.0;  // s, wall-clock limit of a run; 0: none
  double memory = 0.0;      // MB for a run; 0: the default of Slurm
  std::string partition, account, qos;
  std::vector<std::string> options;  // further options of sbatch, one word each
};

/// Condition that ends a run because the bridge has fallen.
struct FallSettings {
  double displacement = 1.0;  // m, displacement of a block from its position under gravity, relative to the ground
  double share = 0.05;        // share of the movable mass that has moved farther than `displacement`; 0: never
};

/// Settings that apply to each run.
struct RunSettings {
  double block_scale = 0.0;                         // 0: the value of the case
  std::vector<std::pair<std::string, double>> set;  // numbers of the cases by their dotted keys, equal in all runs
  double free_after = 0.0;                          // s, free vibration after the motion; 0: as in the case
  FallSettings fall;
  double fields_every = -1.0;  // s; below 0: the value of the case
  bool pictures = false, keep_checkpoints = false;
};

struct Settings {
  std::string path, text;          // the file and its contents
  std::vector<std::string> cases;  // paths of the files
  std::vector<Shaking> records;
  std::vector<std::string> left_out;  // reasons why files of a folder of records are not used, each once
  std::vector<double> scales = {1.0};
  int samples = 0;  // number of samples; 0: the case as it is
  std::uint64_t seed = 1;
  std::vector<Sampled> sampled;
  double duration = 0.0;        // s, largest duration; 0: that of the record
  bool significant = false;     // only the part from 2 s before 5 % to 95 % of the Arias intensity
  std::vector<double> periods;  // s, periods of im.sa_…
  RunSettings run;
  std::vector<PlannedLimit> limit_states;
  EngineSettings engine;
};

/// Reads and checks a campaign file and its records (paths relative to its folder). Throws InputError "FILE:LINE: …".
Settings read_settings(const std::string& path);

/// The records of a campaign from a selection (JSON) or from a folder of record files. `units` and `dt` apply to plain
/// columns, as in a motion stage. Throws InputError.
std::vector<Shaking> read_selection(const std::string& path, bool correct);
std::vector<Shaking> read_folder(const std::string& path, const std::string& units, double dt, bool correct,
                                 std::vector<std::string>& left_out);

}  // namespace voussoir::campaign
