// The source of a ground motion: the keys of a motion stage.
#pragma once
#include <array>
#include <string>

#include "io/case/case.h"
#include "io/toml/table_reader.h"

namespace voussoir {

constexpr double largest_peak = 1e4;  // m/s2; above it the unit or the scale is wrong

/// Reads 'record', 'pulse' or 'synthetic' with their keys, and 'scale'. Names of files are relative to the folder of
/// `path`. A synthetic motion without a duration has that of the stage (s). Throws InputError "FILE:LINE: …".
MotionSource read_motion_source(TableReader& table, const std::string& path, double stage_duration);
/// The same keys as lines of TOML, with these names of files for x, y, z.
std::string motion_source_text(const MotionSource& source, const std::array<std::string, 3>& files);

/// The scaled motion, m/s2. Throws InputError for files that are not records and for motions that are not possible.
GroundMotion ground_motion(const MotionSource& source);

}  // namespace voussoir
