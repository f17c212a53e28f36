// Recordings whose sensors were moved between them: which belong together, and modes of the whole from those of each.
#pragma once
#include "solver/identify/ssi.h"

namespace voussoir {

/// Recordings with the same channels.
struct Setup {
  std::vector<Recording> recordings;
  std::string name;  // of the recordings, for messages: "records/a.csv, records/b.csv"
};

/// In the order of their first recordings.
std::vector<Setup> setups_of(const std::vector<Recording>& recordings);

/// Modes over all channels from those of each setup, which share reference channels (post-identification merging, the
/// PoSER of Reynders, Magalhães, De Roeck & Cunha 2009). Modes are paired by frequency and by their shapes at the
/// references; a setup's shape is scaled to the others by least squares there. Frequencies and dampings are means
/// weighted by their standard deviations, which grow by how far the setups differ.
///
/// Set aside: what fewer than half of the channels know of, and what any setup takes for a machine. Throws InputError
/// for a setup that shares no channel with the others.
///
/// Standard deviations of shapes are those of what is put together: each setup's replicates move its own shape, and
/// with it the scales, the means and the result (Shao & Wu 1989, of independent samples; Döhler, Lam & Mevel 2013 do so
/// with covariances). The component that is 1 has none.
SsiResult merged(const std::vector<Setup>& setups, const std::vector<SsiResult>& results);

/// Channels, references, duration of all setups, without modes.
SsiResult united(const std::vector<SsiResult>& results);

}  // namespace voussoir
