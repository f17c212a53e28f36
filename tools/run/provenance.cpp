#include "tools/run/provenance.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <filesystem>

#include "io/case/case.h"
#include "solver/base/build_info.h"
#include "solver/base/digest.h"
#include "solver/model/kernels.h"

namespace voussoir {

namespace fs = std::filesystem;

nlohmann::json provenance_json(const std::string& directory) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (name == "case.toml" || name == "assembly.h5" || is_copy_for_case(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  nlohmann::json files = nlohmann::json::array();
  for (const std::string& name : names) {
    const std::string path = directory + "/" + name;
    files.push_back({{"name", name}, {"bytes", fs::file_size(path)}, {"sha256", sha256_of_file(path)}});
  }
  return {{"date", fmt::format("{:%Y-%m-%dT%H:%M:%S%z}", fmt::localtime(std::time(nullptr)))},
          {"version", program_version()},
          {"commit", build_commit()},
          {"compiler", build_compiler()},
          {"kernels", kernels().instructions},
          {"files", files}};
}

}  // namespace voussoir
