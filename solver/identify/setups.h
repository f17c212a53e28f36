// Setups of sensors that were moved between recordings: groups recordings by setup and merges the modes of the setups.
#pragma once
#include "solver/identify/ssi.h"

namespace voussoir {

/// Recordings with the same channels.
struct Setup {
  std::vector<Recording> recordings;
  std::string name;  // names of the recordings, for messages: "records/a.csv, records/b.csv"
};

/// The setups, in the order of their first recordings.
std::vector<Setup> setups_of(const std::vector<Recording>& recordings);

/// Modes over all channels from those of each setup, which share reference channels (post-identification merging, the
/// PoSER of Reynders, Magalhães, De Roeck & Cunha 2009). Modes are paired by frequency and by their shapes at the
/// references; the shape of a setup is scaled to the others there by least squares. Frequencies and damping ratios are
/// means weighted by their standard deviations. The resulting standard deviations include the differences between the
/// setups.
///
/// Modes that fewer than half of the channels measured, and modes that any setup identified as a machine, are set
/// aside. Throws InputError for a setup without a common channel with the others.
///
/// Standard deviations of shapes are those of the merged shape: the replicates of each setup change its shape, and with
/// it the scales, the means and the result (Shao & Wu 1989, for independent samples; Döhler, Lam & Mevel 2013 use
/// covariances). The component that is 1 has no standard deviation.
SsiResult merged(const std::vector<Setup>& setups, const std::vector<SsiResult>& results);

/// Channels, references, duration of all setups, without modes.
SsiResult united(const std::vector<SsiResult>& results);

}  // namespace voussoir
