// A folder with measurements on a bridge: places of sensors, periods and shapes of modes, recordings.
//
//   sensors.csv     id,x,y,z,direction: m; x, y, z, -x, -y, -z or a unit vector "0.7071;0.7071;0"; and unit, of its
//                   channels in recordings (default m/s2)
//   modes.csv       mode,period,period_std,damping,damping_std,direction: s, damping ratio; or frequency,frequency_std
//                   in Hz; _std: standard deviation
//   shapes.csv      mode,sensor,value,std: real shapes, any scale per mode
//   records/*.csv   t,<sensor id>,…: s, unit of the sensor; the ground motion as base_x, base_y, base_z in m/s2
//   about.toml      what, when, units ("SI"), notes: texts; other keys are allowed
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/identify/recording.h"

namespace voussoir {

/// An instrument of sensors.csv.
struct MeasuredSensor {
  std::string id;
  Vec3 position = Vec3::Zero();   // m
  Vec3 direction = Vec3::Zero();  // unit
  int row = 0;                    // in sensors.csv
  std::string unit = "m/s2";      // of its channels in files; recordings in memory are m/s2
  bool named = false;             // whether a channel of a recording or a shape names it
};

/// The value of a sensor in a mode.
struct MeasuredValue {
  std::size_t sensor = 0;   // index into Measured::sensors
  double value = 0.0;       // in the scale of its mode
  double std = 0.0;         // in the same scale; 0: not given
  double quadrature = 0.0;  // imaginary part, for modes that were identified from recordings
};

struct MeasuredMode {
  std::string name;
  double period = 0.0;               // s, above 0
  double period_std = 0.0;           // s; 0: not given
  std::optional<double> damping;     // ratio to critical, from 0 to below 1
  double damping_std = 0.0;          // 0: not given
  std::string direction;             // one of mode_directions(), or empty
  std::vector<MeasuredValue> shape;  // in the order of the file, each sensor at most once; empty: none, or set aside
  int row = 0;                       // in modes.csv
  // Only for modes that were identified from recordings, not in files:
  bool phases = false;  // the shape has imaginary parts
  /// Participation of the ground motion along x, y, z, see MeasuredFeature. Not finite: not known.
  Eigen::Vector3cd participation = Eigen::Vector3cd::Constant(std::nan(""));
  Eigen::Vector3d participation_std = Eigen::Vector3d::Zero();
};

/// A further key of about.toml.
struct Note {
  std::string key;   // with the names of its tables: "weather.wind"
  std::string text;  // texts without quotes, other values as TOML writes them
};

/// Data that was found but is not used.
struct SetAside {
  std::string place;  // "shapes.csv:5", "records/wind.csv:1", "photo.jpg"
  std::string what;   // description and reason
};

struct Measured {
  std::string directory;
  std::string what, when, notes;  // from about.toml
  std::vector<Note> more;         // other keys of about.toml, sorted by name
  std::vector<MeasuredSensor> sensors;
  std::vector<MeasuredMode> modes;
  std::vector<Recording> records;    // in the order of their names, "records/wind.csv"; the first sample is at t = 0
  std::vector<SetAside> set_aside;   // not used
  std::vector<std::string> remarks;  // doubts about data that is used: periods that may be frequencies, …
};

/// Reads a folder of measurements. Any part may be missing, but not both modes.csv and records/*.csv; shapes.csv needs
/// modes.csv and sensors.csv. Without sensors.csv the channels of recordings may have any names; a remark says so.
///
/// Tables are UTF-8 with commas between cells (semicolons if the heading has semicolons and no commas). Columns are
/// found by their names, cells may be "quoted" within one line, and lines that begin with # and empty lines are
/// skipped. A standard deviation of 0 means that it is not given.
///
/// Set aside and reported: unknown files, shapes of fewer than two sensors or with only zeros, repeated modes and
/// recordings, sensors without data, channels that are constant throughout or for long times, are cut off at a limit or
/// equal another channel, and recordings without remaining channels. Other faults and contradictions are an InputError
/// "FILE:ROW: …" with the value found, the value expected and the remedy: among them two sensors at the same place
/// along the same axis (also with opposite signs), recordings of fewer than 100 samples or with gaps, time steps that
/// differ by more than 1e-6 s and fit no even grid within half of the last digit written, and a folder without usable
/// data.
///
/// Velocities and displacements are converted into accelerations; their recordings lose 24 and 48 samples at each end.
Measured read_measured(const std::string& directory);

/// Writes a folder from which read_measured() gives the same data bit for bit, except `directory`, rows, units, `more`,
/// data set aside and remarks. Files are written atomically; folders are made. Recordings are written to
/// records/NAME.csv with the last part of their names. Throws InputError, before anything is written, for data that
/// read_measured() would refuse, and if the folder has measurements that would be mixed with these; RunError if writing
/// fails.
void write_measured(const Measured& measured, const std::string& directory);

/// Reads a table of sensors alone, as sensors.csv of a folder. Throws InputError "FILE:ROW: …".
std::vector<MeasuredSensor> read_sensors(const std::string& file);

/// The block of each sensor, in the order of the sensors. If several blocks contain the place, it is the one with the
/// lowest number, as in attach_sensors(). Throws InputError with `file`, row, distance and nearest block for a sensor
/// more than 0.5 m away from every block.
std::vector<std::int64_t> place_sensors(const std::vector<MeasuredSensor>& sensors, const std::string& file,
                                        const Assembly& assembly);
std::vector<std::int64_t> place_sensors(const Measured& measured, const Assembly& assembly);

}  // namespace voussoir
