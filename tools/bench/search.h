// What a diagnosis costs: a bridge that has an effect is measured, and its case searched as voussoir diagnose does.
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
/// The scene of that name; "diagnosis-cs1@2" is diagnosis-cs1 at block_scale = 2. Nothing for others; InputError for a
/// number that is none.
std::optional<SearchScene> find_search(const std::string& name);

struct SearchCost {
  struct Seconds {
    double wall = 0.0, processor = 0.0;  // s
  };
  std::int64_t unknowns = 0;
  std::size_t sensors = 0, modes = 0, screened = 0, fitted = 0, rounds = 0;
  std::string verdict;
  Seconds input, search;  // reading, meshing, first modes and what the mesh does; all that follows
};
SearchCost time_search(const SearchScene& scene, int threads);

}  // namespace voussoir
