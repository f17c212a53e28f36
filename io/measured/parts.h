// Readers of the files of a folder of measurements. Private to io/measured. All throw InputError "FILE:ROW: …".
#pragma once
#include <array>

#include "io/measured/measured.h"
#include "solver/base/csv.h"

namespace voussoir {

inline const std::array<std::string, 3> base_channels = {"base_x", "base_y", "base_z"};

void parse_sensors(const TextFile& file, Measured& measured);
void parse_modes(const TextFile& file, Measured& measured);
/// Needs sensors and modes.
void parse_shapes(const TextFile& file, Measured& measured);
void parse_about(const TextFile& file, Measured& measured);
/// Needs sensors.
void parse_record(const TextFile& file, Measured& measured);

/// Removes channels without a signal, see channel_faults.cpp. `rows` are the rows of the samples in the file, `place`
/// is the place of its heading.
void drop_faulty(Recording& record, const std::vector<int>& rows, const std::string& place, Measured& measured);

/// Path of a file in a folder.
std::string path_in(const std::string& directory, const std::string& name);
/// Names of the files and folders in a folder, sorted; empty if there is no such folder.
std::vector<std::string> names_in(const std::string& directory);

}  // namespace voussoir
