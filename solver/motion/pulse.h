// Elementary pulses of base acceleration, which have known solutions for verification.
#pragma once
#include <string>
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// One pulse along one axis. A value of 0 for `frequency` or `length` means "not given".
struct PulseSettings {
  enum class Kind { rectangular, half_sine, sine };
  Kind kind = Kind::sine;
  int axis = 0;            // 0 x, 1 y, 2 z
  double amplitude = 0.0;  // m/s2, may be negative
  double frequency = 0.0;  // Hz; of the whole wave, also for half_sine
  double length = 0.0;     // s
  double start = 0.0;      // s
  bool operator==(const PulseSettings&) const = default;
};
const std::vector<std::string>& pulse_kinds();  // names in the order of PulseSettings::Kind

/// Length in s: as given, else one period (sine), half a period (half_sine). A rectangular pulse needs a length. A
/// half_sine with both values must have length = 1/(2 frequency). Throws InputError.
double pulse_length(const PulseSettings& pulse);
/// Frequency in Hz: as given, else one wave (sine) or half a wave (half_sine) in the length; 0 for rectangular.
double pulse_frequency(const PulseSettings& pulse);

/// The pulse on a uniform grid that contains its beginning and end. `start` is moved to the nearest grid point, by at
/// most length/2000. At a jump the sample is the mean of both sides, so that the area of the sampled rectangular pulse
/// is exactly amplitude × length. Throws InputError if the pulse is not defined (see pulse_length).
GroundMotion make_pulse(const PulseSettings& pulse);

}  // namespace voussoir
