// Vibration modes from recorded responses to an unknown, broad excitation (docs/theory/identification.md).
#pragma once
#include "solver/identify/prepare.h"
#include "solver/identify/subspace.h"

namespace voussoir {

struct SsiSettings {
  double highest_frequency = 0.0;  // Hz; 0: 20, or 0.4 of the sampling frequency where that is less
  double lowest_frequency = 0.0;   // Hz; 0: a fortieth of the highest
  int largest_order = 0;           // of the models, even: twice the modes they can hold; 0: 60, below four channels 40
  int block_rows = 0;  // of the Hankel matrix; 0: half a period of the lowest frequency, and enough for the order
  int references = 8;  // channels, at most; the greatest and least collinear are taken
  int segments = 20;   // that the standard deviations are found from
  double frequency_tolerance = 0.01;  // of a stable pole, of its frequency
  double damping_tolerance = 0.05;    // of its damping
  double shape_tolerance = 0.02;      // 1 − MAC
  double cluster_radius = 0.05;       // distance() of poles that are one mode
  double least_hits = 0.25;           // share of the orders at which a mode must appear
  double least_mean_phase = 0.5;      // MPC
  double least_damping = 0.001;       // of masonry 0.005 and more is known: what has less is a machine
  double largest_damping = 0.2;
};

struct IdentifiedMode {
  double frequency = 0.0, frequency_std = 0.0;  // Hz
  double damping = 0.0, damping_std = 0.0;      // ratio
  Eigen::VectorXcd shape;     // per channel of the result, the largest component 1; NaN: channel not used
  Eigen::VectorXd shape_std;  // per channel, of the complex component; NaN as above
  int order = 0;              // of the model it is taken from
  int hits = 0;               // orders at which it appears
  double mean_phase = 0.0;    // modal phase collinearity (Pappa et al. 1993): 1 where all move in phase
  double kurtosis = 0.0;      // of the signal about its frequency: 3 of noise, 1.5 of a harmonic
  int stops = 0;              // times that it stopped faster than its damping allows
  double stopped = 0.0;       // share of the energy lost that went then
  bool intermittent = false;  // a machine that runs now and then
  bool harmonic = false;      // a machine, no mode
};

struct RejectedMode {
  IdentifiedMode mode;
  std::string reason;  // "a harmonic: …"
};

struct SsiResult {
  std::vector<std::string> channels;    // those that all recordings have; of several setups, all
  int setups = 1;                       // that the modes were put together from
  std::vector<PoorChannel> poor;        // left out
  std::vector<int> references;          // channels
  std::vector<IdentifiedMode> modes;    // ascending in frequency
  std::vector<RejectedMode> set_aside;  // ascending in frequency
  std::vector<Pole> poles;  // of the stabilisation diagram: ascending in order and frequency, shapes over used channels
  SsiSettings settings;     // with what was chosen for zeros, and what the recordings allow
  double dt = 0.0;          // s, after decimation
  double duration = 0.0;    // s, of all recordings after decimation
};

/// Throws InputError as prepare() does, for settings out of their range, and for recordings too short for the lowest
/// frequency. Single-threaded, and the same bits for the same input.
///
/// Recordings that have three quarters of all channels in common are taken together, by these channels. Others are
/// setups: each is identified by itself and their modes are merged (setups.h).
SsiResult identify_modes(const std::vector<Recording>& recordings, const SsiSettings& settings = {});

/// Modal phase collinearity of a shape (Pappa, Elliott & Schenk 1993), NaN components left out.
double phase_collinearity(const Eigen::VectorXcd& shape);

}  // namespace voussoir
