// The cost of a diagnosis: measurements are made of a bridge that has an effect, and voussoir diagnose is run on its
// case.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voussoir {

struct SearchScene {
  std::string name, help, generator;
  double scale = 1.0;  // block_scale
};

const std::vector<SearchScene>& search_scenes();
/// The scene of that name; "diagnosis-cs1@2" is diagnosis-cs1 with block_scale = 2. Empty for other names. Throws
/// InputError if the text after "@" is not a positive number.
std::optional<SearchScene> find_search(const std::string& name);

struct SearchCost {
  struct Seconds {
    double wall = 0.0, processor = 0.0;  // s
  };
  std::int64_t unknowns = 0;
  std::size_t sensors = 0, modes = 0, screened = 0, fitted = 0, rounds = 0;
  std::string verdict;
  Seconds input, search;  // input: reading, meshing, first modes, error of the mesh; search: the rest
};
SearchCost time_search(const SearchScene& scene, int threads);

}  // namespace voussoir
