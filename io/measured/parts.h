// The files of a folder of measurements, one function each. Private to io/measured. All throw InputError "FILE:ROW: …".
#pragma once
#include <array>

#include "io/measured/measured.h"
#include "solver/base/csv.h"

namespace voussoir {

inline const std::array<std::string, 3> base_channels = {"base_x", "base_y", "base_z"};

void parse_sensors(const TextFile& file, Measured& measured);
void parse_modes(const TextFile& file, Measured& measured);
/// Once sensors and modes are known.
void parse_shapes(const TextFile& file, Measured& measured);
void parse_about(const TextFile& file, Measured& measured);
/// Once sensors are known.
void parse_record(const TextFile& file, Measured& measured);

/// Takes out channels that are no signal: see channel_faults.cpp. `rows` are those of the samples in the file, `place`
/// that of its heading.
void drop_faulty(Recording& record, const std::vector<int>& rows, const std::string& place, Measured& measured);

/// Where a file of a folder is.
std::string path_in(const std::string& directory, const std::string& name);
/// Names of what a folder holds, sorted; empty when there is no such folder.
std::vector<std::string> names_in(const std::string& directory);

}  // namespace voussoir
