// Charts of responses to a recorded ground motion: transfer functions and histories, measured, before and after.
#pragma once
#include "tools/diagnosis/diagnosis_runs.h"

namespace voussoir {

/// Transfer functions of the base channel and of the sensors with the strongest resonance, one panel each. Empty if
/// there are no transfer functions.
std::string transfer_chart(const DiagnosisInput& input, const RecordedMatch& match);
/// Stabilisation diagram: the poles of each model order and the identified modes, over the first singular value of the
/// spectra.
std::string stabilisation_chart(const SsiResult& ssi, const Fdd& spectra);
/// Accelerations of the sensors with the strongest resonance, around their peak. Empty without channels.
std::string history_chart(const DiagnosisInput& input, const RecordedMatch& match);

}  // namespace voussoir
