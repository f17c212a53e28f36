// Mode shapes of the case before and after a diagnosis, for ParaView and voussoir view.
#pragma once
#include "solver/modal/modes.h"
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Computed mode number `computed` of an evaluation, scaled so that the largest displacement of a block is 1. The
/// masses of the mode are not set.
Mode computed_mode(const Evaluation& e, int computed);

/// Writes DIRECTORY/vtk/modes_before.pvd and modes_after.pvd with a file for each measured mode that both models have,
/// in the format of `voussoir modal` (a fill in modes_before_fill.pvd …). The "time" of a shape is the number of the
/// mode in diagnosis.json, from 1. Throws RunError if a file cannot be written.
void write_diagnosis_shapes(const DiagnosisResult& result, const std::string& directory);

}  // namespace voussoir
