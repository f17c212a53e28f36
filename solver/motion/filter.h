// Processing of accelerograms: taper, band-pass, resampling.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// Applies half a cosine at both ends, each over this share (0 to 0.5) of the samples. Throws InputError for another
/// share.
void taper(std::vector<double>& values, double share);

/// Butterworth filter of order `order`, run forward and backward: no phase, amplitudes 1/(1 + (f_low/f)^2n) · 1/(1 +
/// (f/f_high)^2n) (half at each corner). A corner frequency of 0 means no filter on that side. The record is extended
/// with zeros for 1.5 n / f_low s at both ends (after Converse & Brady 1992), which are not returned. Throws InputError
/// for corner frequencies in the wrong order, below 0.001 Hz or above 1/(2 dt), and for an order outside 1 to 16.
std::vector<double> band_pass(const std::vector<double>& values, double dt, double f_low, double f_high, int order = 4);

/// The same curve with another time step (s). For a smaller time step it is linear between the samples, as everywhere
/// in the program. For a larger one a low-pass at 0.4 of the new sampling rate is applied first to prevent aliasing.
/// Throws InputError for a new time step outside 1e-5 s to 1 s, and for more than 1e7 samples.
std::vector<double> resample(const std::vector<double>& values, double dt, double new_dt);

/// Processing options in the order of application: taper, band-pass, baseline, resampling.
struct MotionProcessing {
  double taper = 0.0;            // share at each end
  double low = 0.0, high = 0.0;  // Hz; 0: no filter on this side
  int order = 4;
  bool baseline = false;
  double dt = 0.0;  // s; 0: unchanged
  bool operator==(const MotionProcessing&) const = default;
};
/// All components with these options. Throws InputError as the single functions do.
GroundMotion process(const GroundMotion& motion, const MotionProcessing& asked);

/// The samples of one component (m/s2); axis 0, 1, 2 is x, y, z.
std::vector<double> component(const GroundMotion& motion, int axis);

}  // namespace voussoir
