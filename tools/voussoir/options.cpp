#include "tools/voussoir/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

options::typed_value<double>* real_option(const std::string& name, double low, double high, double* to) {
  return options::value<double>(to)->notifier([=](double value) {
    if (!(value >= low && value <= high))
      throw InputError("--{} is {}. It must be from {:g} to {:g}", name, value, low, high);
  });
}

options::typed_value<int>* whole_option(const std::string& name, int low, int high, int* to) {
  return options::value<int>(to)->notifier([=](int value) {
    if (value < low || value > high) throw InputError("--{} is {}. It must be from {} to {}", name, value, low, high);
  });
}

void check_ending(const std::string& path, const std::vector<std::string>& endings, const char* kind) {
  static const std::vector<std::string> known = {".svg",  ".pdf", ".eps",  ".ps",   ".jpg", ".jpeg", ".gif",
                                                 ".bmp",  ".tif", ".tiff", ".webp", ".png", ".json", ".csv",
                                                 ".xlsx", ".txt", ".html", ".toml", ".vtu", ".vtp",  ".vtk",
                                                 ".obj",  ".stl", ".ply",  ".msh",  ".h5",  ".md",   ".hdf5"};
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (std::ranges::find(known, ending) == known.end() || std::ranges::find(endings, ending) != endings.end()) return;
  throw InputError(
      "-o {}: the program writes {}, but '{}' is the ending of another kind of file. The name must end in {}",
      shown(path, 300), kind, ending, fmt::join(endings, " or "));
}

}  // namespace voussoir
