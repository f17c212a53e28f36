#include "solver/motion/pulse.h"

#include <cmath>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

const std::vector<std::string>& pulse_kinds() {
  static const std::vector<std::string> names = {"rectangular", "half-sine", "sine"};
  return names;
}

namespace {

/// Value at time t after the pulse began; 0 outside [0, length].
double value(const PulseSettings& pulse, double frequency, double t) {
  if (pulse.kind == PulseSettings::Kind::rectangular) return pulse.amplitude;
  return pulse.amplitude * std::sin(2.0 * pi * frequency * t);
}

}  // namespace

double pulse_length(const PulseSettings& pulse) {
  const std::string& kind = pulse_kinds()[std::size_t(pulse.kind)];
  if (pulse.length > 0.0) {
    const bool half = pulse.kind == PulseSettings::Kind::half_sine && pulse.frequency > 0.0;
    if (half && std::abs(2.0 * pulse.frequency * pulse.length - 1.0) > 1e-6)
      throw InputError(
          "the half-sine pulse has length {} s and frequency {} Hz, which contradict each other: the length is 1/(2 "
          "frequency) = {} s. Give only one of the two.",
          pulse.length, pulse.frequency, 0.5 / pulse.frequency);
    return pulse.length;
  }
  if (pulse.kind == PulseSettings::Kind::rectangular) throw InputError("the rectangular pulse needs 'length' in s");
  if (!(pulse.frequency > 0.0)) throw InputError("the {} pulse needs 'frequency' in Hz or 'length' in s", kind);
  return (pulse.kind == PulseSettings::Kind::sine ? 1.0 : 0.5) / pulse.frequency;
}

double pulse_frequency(const PulseSettings& pulse) {
  if (pulse.kind == PulseSettings::Kind::rectangular) return 0.0;
  if (pulse.frequency > 0.0) return pulse.frequency;
  return (pulse.kind == PulseSettings::Kind::sine ? 1.0 : 0.5) / pulse_length(pulse);
}

GroundMotion make_pulse(const PulseSettings& pulse) {
  const double length = pulse_length(pulse), frequency = pulse_frequency(pulse);
  // 400 points a wave keep linear interpolation within 3.1e-5 of the amplitude.
  const double finest = frequency > 0.0 ? std::min(length / 1000.0, 1.0 / (400.0 * frequency)) : length / 1000.0;
  // In doubles first: what is asked for may be more than any whole number holds.
  if (!((pulse.start + length) / finest < 5e7))
    throw InputError("the pulse of {} s at {} Hz that starts at {} s needs more than 50 million samples. Shorten it.",
                     length, frequency, pulse.start);
  const auto cells = std::int64_t(std::ceil(length / finest - 1e-9));
  const double dt = length / double(cells);
  const auto first = std::int64_t(std::llround(pulse.start / dt));

  GroundMotion motion;
  motion.dt = dt;
  motion.acceleration.assign(std::size_t(first + cells + 2), Vec3::Zero());
  for (std::int64_t i = 0; i <= cells; ++i) {
    double a = value(pulse, frequency, double(i) * dt);
    const bool jump = (i == 0 && first > 0) || i == cells;  // before t = 0 there is nothing to take the mean with
    if (jump) a *= 0.5;
    motion.acceleration[std::size_t(first + i)][pulse.axis] = a;
  }
  return motion;
}

}  // namespace voussoir
