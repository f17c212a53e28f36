// Shapes of the measured modes as the case has them before and after a diagnosis, for ParaView and voussoir view.
#pragma once
#include "solver/modal/modes.h"
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// A computed mode of an evaluation, by its column: the largest displacement of a block is 1. Without masses.
Mode computed_mode(const Evaluation& e, int computed);

/// DIRECTORY/vtk/modes_before.pvd and modes_after.pvd with a file for each measured mode that both have, as
/// `voussoir modal` writes them (a fill in modes_before_fill.pvd …); the "time" is its place among the modes of
/// diagnosis.json, from 1. Throws RunError when one cannot be written.
void write_diagnosis_shapes(const DiagnosisResult& result, const std::string& directory);

}  // namespace voussoir
