// Vibration modes from recorded responses to an unknown, broad excitation (docs/theory/identification.md).
#pragma once
#include "solver/identify/prepare.h"
#include "solver/identify/subspace.h"

namespace voussoir {

struct SsiSettings {
  /// Merging of setups: their modes (PoSER), or their covariances in one joint model (PreGER). Automatic: their modes,
  /// unless the joint model finds more modes and the setups agree in their frequencies.
  enum class Merging { automatic, after, before };
  Merging merging = Merging::automatic;
  double highest_frequency = 0.0;  // Hz; 0: 20, or 0.4 of the sampling frequency if that is less
  double lowest_frequency = 0.0;   // Hz; 0: a fortieth of the highest
  int largest_order = 0;           // of the models, even: twice the number of modes; 0: 60, or 40 with fewer than four
                                   // channels
  int block_rows = 0;  // of the Hankel matrix; 0: half a period of the lowest frequency, and enough for the order
  int references = 8;  // largest number of reference channels; those with the largest and least collinear motion are
                       // taken
  int segments = 20;   // number of segments for the standard deviations
  double frequency_tolerance = 0.01;  // of the frequency of a stable pole
  double damping_tolerance = 0.05;    // of the damping ratio of a stable pole
  double shape_tolerance = 0.02;      // 1 − MAC
  double cluster_radius = 0.05;       // largest distance() of poles of one mode
  double least_hits = 0.25;           // share of the orders at which a mode must be stable
  double least_mean_phase = 0.5;      // modal phase collinearity
  double least_damping = 0.001;       // masonry has 0.005 and more; smaller values belong to machines
  double largest_damping = 0.2;
};

struct IdentifiedMode {
  double frequency = 0.0, frequency_std = 0.0;  // Hz
  double damping = 0.0, damping_std = 0.0;      // ratio
  Eigen::VectorXcd shape;          // for each channel of the result, largest component 1; NaN: channel not used
  Eigen::VectorXd shape_std;       // for each channel, of the complex component; NaN as above
  Eigen::MatrixXcd shape_changes;  // channels × replicates: their squares add up to the variances; 0: channel not used
  int order = 0;                   // order of its model
  int hits = 0;                    // number of orders at which it is stable
  double mean_phase = 0.0;         // modal phase collinearity (Pappa et al. 1993): 1 if all points move in phase
  double kurtosis = 0.0;           // of the signal about its frequency: 3 for noise, 1.5 for a harmonic
  int stops = 0;                   // number of times it stopped faster than its damping ratio allows
  double stopped = 0.0;            // share of the lost energy that was lost in these stops
  bool intermittent = false;       // an intermittent machine
  bool harmonic = false;           // a machine and not a mode
};

struct RejectedMode {
  IdentifiedMode mode;
  std::string reason;  // "a harmonic: …"
};

/// A recording that is too short for the correlations.
struct ShortRecording {
  std::string name, reason;
};

struct SsiResult {
  std::vector<std::string> channels;  // channels of all recordings; with several setups, all channels
  int setups = 1;                     // number of setups
  bool joint = false;                 // whether setups were merged in one joint model (PreGER) and not by their modes
                                      // (PoSER)
  double apart = 0.0;  // differences of frequencies between setups over their standard deviations, root mean square
  std::vector<PoorChannel> poor;          // left out
  std::vector<ShortRecording> too_short;  // left out
  std::vector<int> references;            // channels
  std::vector<IdentifiedMode> modes;      // ascending in frequency
  std::vector<RejectedMode> set_aside;    // ascending in frequency
  std::vector<Pole> poles;  // of the stabilisation diagram: ascending in order and frequency; shapes over the used
                            // channels
  SsiSettings settings;     // with the values chosen for settings of 0 and limited by the recordings
  double dt = 0.0;          // s, after decimation
  double duration = 0.0;    // s, of all recordings after decimation; with several setups, of the shortest
};

/// Throws InputError as prepare(), for settings outside their range, and for recordings too short for the lowest
/// frequency. It uses one thread and gives the same bits for the same input.
///
/// Recordings with three quarters of all channels in common are evaluated together with these channels. Other
/// recordings form setups: each setup is identified separately and their modes are merged (setups.h).
SsiResult identify_modes(const std::vector<Recording>& recordings, const SsiSettings& settings = {});

/// Modal phase collinearity of a shape (Pappa, Elliott & Schenk 1993), without NaN components.
double phase_collinearity(const Eigen::VectorXcd& shape);

}  // namespace voussoir
