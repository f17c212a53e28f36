// Origin of a run's results: program, date, input files.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// An object with `date` (local time, ISO 8601), `version`, `commit`, `compiler`, `kernels`, and for each input file of
/// the run (case, assembly, records, measured curves) `name`, `bytes` and `sha256`.
nlohmann::json provenance_json(const std::string& directory);

}  // namespace voussoir
