// A faulty channel: a reversed, wrong or zero gain, a wrong axis, a late clock, or two exchanged channels at one place.
#include <fmt/format.h>

#include <algorithm>

#include "solver/base/constants.h"
#include "solver/base/error.h"
#include "solver/effects/effect.h"

namespace voussoir {

namespace {

std::vector<std::string> places_of_sensor_fault(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const Sensor& sensor : assembly.sensors) names.push_back("channel " + sensor.id);
  for (std::size_t i = 0; i < assembly.sensors.size(); ++i)
    for (std::size_t j = i + 1; j < assembly.sensors.size(); ++j)
      if ((assembly.sensors[i].position - assembly.sensors[j].position).norm() < sensor_housing)
        names.push_back(fmt::format("channels {} {}", assembly.sensors[i].id, assembly.sensors[j].id));
  return names;
}

Sensor& channel(std::vector<Sensor>& sensors, const std::string& id) {
  const auto at = std::find_if(sensors.begin(), sensors.end(), [&](const Sensor& s) { return s.id == id; });
  if (at == sensors.end())
    throw InputError("effect sensor_fault: there is no sensor '{}'. Name one of [[sensor]] as \"channel ID\".", id);
  return *at;
}

void apply_sensor_fault(std::vector<Sensor>& sensors, const std::string& where, const std::vector<double>& values) {
  const std::size_t gap = where.find(' '), next = where.find(' ', gap + 1);
  if (gap == std::string::npos)
    throw InputError("effect sensor_fault: '{}' names no channel. Give \"channel ID\" or \"channels ID ID\".", where);
  Sensor& first = channel(sensors, where.substr(gap + 1, next == std::string::npos ? next : next - gap - 1));
  if (where.starts_with("channels ") && next != std::string::npos)
    std::swap(first.direction, channel(sensors, where.substr(next + 1)).direction);
  else
    first.direction =
        values[0] *
        (values[2] == 0.0 && values[3] == 0.0 ? first.direction : mounted(first.direction, values[2], values[3]));
}

}  // namespace

Vec3 mounted(const Vec3& axis, double turn, double tilt) {
  const Vec3 flat(axis.x(), axis.y(), 0.0);
  const Vec3 heading = flat.norm() > 1e-9 * axis.norm() ? Vec3(flat.normalized()) : Vec3::UnitX();
  const Eigen::AngleAxisd raise(radians(tilt), heading.cross(Vec3::UnitZ())), about(radians(turn), Vec3::UnitZ());
  return about * (raise * axis);
}

Effect sensor_fault() {
  return {
      "sensor_fault",
      "a channel has a wrong gain, sign or axis or a late clock, or two channels at one place are exchanged",
      "Check the cable, the axis, the polarity and the calibration of that channel, and record again.",
      {{"gain", "-", "factor on the true value: −1 is a reversed channel, 0 a dead channel", -20.0, 20.0, 1.0, 1.0,
        0.5},
       {"delay", "s", "delay of its clock in recordings; the histories of a run are not shifted", -0.2, 0.2, 0.0, 0.0,
        0.02},
       {"turn", "deg", "rotation of its axis about the vertical, from x to y, after tilt", -180.0, 180.0, 0.0, 0.0,
        45.0},
       {"tilt", "deg", "rotation of its axis upwards; −90 turns a vertical axis to x", -180.0, 180.0, 0.0, 0.0, 45.0}},
      places_of_sensor_fault,
      nullptr,
      nullptr,
      apply_sensor_fault};
}

}  // namespace voussoir
