// Charts of runs under a recorded motion of the ground: transfer functions and histories, measured, before and after.
#pragma once
#include "tools/diagnosis/diagnosis_runs.h"

namespace voussoir {

/// The base channel and the sensors that resonate most, a panel each; empty where there are no transfer functions.
std::string transfer_chart(const DiagnosisInput& input, const RecordedMatch& match);
/// Poles of each order and the modes that were taken, over the first singular value of the spectra.
std::string stabilisation_chart(const SsiResult& ssi, const Fdd& spectra);
/// Accelerations of the sensors that resonate most, about their largest; empty without channels.
std::string history_chart(const DiagnosisInput& input, const RecordedMatch& match);

}  // namespace voussoir
