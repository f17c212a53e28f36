// Vibration modes from recorded responses to an unknown, broad excitation (docs/theory/identification.md).
#pragma once
#include "solver/identify/prepare.h"
#include "solver/identify/subspace.h"

namespace voussoir {

struct SsiSettings {
  /// How setups are put together: their modes (PoSER), or their covariances to one model of all (PreGER). Automatic: by
  /// their modes, unless one model finds more of them and the setups agree in their frequencies.
  enum class Merging { automatic, after, before };
  Merging merging = Merging::automatic;
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
  Eigen::VectorXcd shape;          // per channel of the result, the largest component 1; NaN: channel not used
  Eigen::VectorXd shape_std;       // per channel, of the complex component; NaN as above
  Eigen::MatrixXcd shape_changes;  // channels × replicates: their squares add up to the variances; 0: channel not used
  int order = 0;                   // of the model it is taken from
  int hits = 0;                    // orders at which it appears
  double mean_phase = 0.0;         // modal phase collinearity (Pappa et al. 1993): 1 where all move in phase
  double kurtosis = 0.0;           // of the signal about its frequency: 3 of noise, 1.5 of a harmonic
  int stops = 0;                   // times that it stopped faster than its damping allows
  double stopped = 0.0;            // share of the energy lost that went then
  bool intermittent = false;       // a machine that runs now and then
  bool harmonic = false;           // a machine, no mode
};

struct RejectedMode {
  IdentifiedMode mode;
  std::string reason;  // "a harmonic: …"
};

/// A recording that is shorter than what is correlated of it.
struct ShortRecording {
  std::string name, reason;
};

struct SsiResult {
  std::vector<std::string> channels;  // those that all recordings have; of several setups, all
  int setups = 1;                     // that the modes were put together from
  bool joint = false;                 // setups by one model of all (PreGER), not mode by mode (PoSER)
  double apart = 0.0;  // differences of frequencies between setups over their standard deviations, root mean square
  std::vector<PoorChannel> poor;          // left out
  std::vector<ShortRecording> too_short;  // left out
  std::vector<int> references;            // channels
  std::vector<IdentifiedMode> modes;      // ascending in frequency
  std::vector<RejectedMode> set_aside;    // ascending in frequency
  std::vector<Pole> poles;  // of the stabilisation diagram: ascending in order and frequency, shapes over used channels
  SsiSettings settings;     // with what was chosen for zeros, and what the recordings allow
  double dt = 0.0;          // s, after decimation
  double duration = 0.0;    // s, of all recordings after decimation; of the shortest setup where there are several
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
