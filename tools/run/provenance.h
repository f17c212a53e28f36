// Where a run's figures come from: program, day, files.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// `date` (local time, ISO 8601), `version`, `commit`, `compiler`, `kernels`, and of each file that the run of a
/// directory was made from (case, assembly, records, measured curves) `name`, `bytes` and `sha256`.
nlohmann::json provenance_json(const std::string& directory);

}  // namespace voussoir
