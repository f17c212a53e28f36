// A folder with what was measured on a bridge: where the sensors were, periods and shapes of modes, recordings.
//
//   sensors.csv     id,x,y,z,direction: m; x, y, z, -x, -y, -z or a unit vector "0.7071;0.7071;0"; and unit, of its
//                   channels in recordings (m/s2 where there is none)
//   modes.csv       mode,period,period_std,damping,damping_std,direction: s; or frequency,frequency_std in Hz
//   shapes.csv      mode,sensor,value,std: real shapes, any scale per mode
//   records/*.csv   t,<sensor id>,…: s, the sensor's unit; the ground's motion as base_x, base_y, base_z in m/s2
//   about.toml      what, when, units ("SI"), notes: texts; anything else may stand there
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/identify/recording.h"

namespace voussoir {

/// An instrument as sensors.csv names it.
struct MeasuredSensor {
  std::string id;
  Vec3 position = Vec3::Zero();   // m
  Vec3 direction = Vec3::Zero();  // unit
  int row = 0;                    // in sensors.csv
  std::string unit = "m/s2";      // of its channels in files; recordings in memory are m/s2
  bool named = false;             // by a channel of a recording or by a shape
};

/// What one sensor showed in a mode.
struct MeasuredValue {
  std::size_t sensor = 0;   // index into Measured::sensors
  double value = 0.0;       // in the scale of its mode
  double std = 0.0;         // in the same scale; 0: not given
  double quadrature = 0.0;  // imaginary part, of modes that were identified from recordings
};

struct MeasuredMode {
  std::string name;
  double period = 0.0;               // s, above 0
  double period_std = 0.0;           // s; 0: not given
  std::optional<double> damping;     // ratio to critical, from 0 to below 1
  double damping_std = 0.0;          // 0: not given
  std::string direction;             // one of mode_directions(), or empty
  std::vector<MeasuredValue> shape;  // in the file's order, each sensor at most once; empty: none (or set aside)
  int row = 0;                       // in modes.csv
  // Of modes that were identified from recordings, never in files:
  bool phases = false;  // the shape has imaginary parts
  /// What the ground's motion along x, y, z does: see MeasuredFeature. Not finite: not known.
  Eigen::Vector3cd participation = Eigen::Vector3cd::Constant(std::nan(""));
  Eigen::Vector3d participation_std = Eigen::Vector3d::Zero();
};

/// What people noted in about.toml beside what is read there.
struct Note {
  std::string key;   // with those of the tables that it is in: "weather.wind"
  std::string text;  // texts without quotes, all else as TOML writes it
};

/// Something that was found and is not used.
struct SetAside {
  std::string place;  // "shapes.csv:5", "records/wind.csv:1", "photo.jpg"
  std::string what;   // what it is and why
};

struct Measured {
  std::string directory;
  std::string what, when, notes;  // of about.toml, as written there
  std::vector<Note> more;         // its other keys, in the order of their names
  std::vector<MeasuredSensor> sensors;
  std::vector<MeasuredMode> modes;
  std::vector<Recording> records;    // in the order of their names, "records/wind.csv"; the first sample is at t = 0
  std::vector<SetAside> set_aside;   // not used
  std::vector<std::string> remarks;  // used, but worth a look: periods that look like frequencies, …
};

/// Reads a folder of measurements. Any part may be missing, but not both modes.csv and records/*.csv; shapes.csv needs
/// modes.csv and sensors.csv. Without sensors.csv the channels of recordings may have any name, which is remarked.
///
/// Tables are UTF-8 with commas between cells (semicolons when the heading has semicolons and no commas); columns are
/// found by their names, cells may be "quoted" within one line, lines that begin with # and empty ones are skipped.
/// A standard deviation of 0 is one that is not given.
///
/// Set aside and reported: files nobody knows, shapes of fewer than two sensors or all zeros, modes that repeat
/// another, sensors that nothing names, recordings that repeat another, and channels that are constant throughout,
/// stand still, are cut off at a limit or are the same as another (and recordings of which no channel is left).
/// Everything else that is wrong or contradicts itself is an InputError "FILE:ROW: …" that says what was found, what is
/// expected and what to do: among them two sensors at the same place along the same axis (also with opposite signs),
/// recordings of fewer than 100 samples or with gaps, time steps that differ by more than 1e-6 s and fit no even grid
/// within half of the last digit written, and a folder of which nothing is left to use.
///
/// Velocities and displacements become accelerations: their recordings lose 24 and 48 samples at either end.
Measured read_measured(const std::string& directory);

/// Writes a folder that read_measured() gives back bit for bit, but for `directory`, rows, units, `more`, what was set
/// aside and remarks. Each file is written atomically; folders are made. Recordings are written to records/NAME.csv,
/// NAME being the last part of theirs. Throws InputError, before anything is written, for what read_measured() would
/// refuse and when the folder holds measurements that would be mixed with these; RunError when writing fails.
void write_measured(const Measured& measured, const std::string& directory);

/// A table of sensors alone, as sensors.csv of a folder. Throws InputError "FILE:ROW: …".
std::vector<MeasuredSensor> read_sensors(const std::string& file);

/// The block that holds each sensor, in the order of the sensors; of blocks that share a place, the one with the lowest
/// number, as attach_sensors() does. Throws InputError naming `file`, row and distance of a sensor more than 0.5 m off
/// every block, and the nearest block.
std::vector<std::int64_t> place_sensors(const std::vector<MeasuredSensor>& sensors, const std::string& file,
                                        const Assembly& assembly);
std::vector<std::int64_t> place_sensors(const Measured& measured, const Assembly& assembly);

}  // namespace voussoir
