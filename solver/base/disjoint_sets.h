// Connected components, built by joining pairs.
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace voussoir {

/// Sets of the numbers 0 to count − 1, initially one number each; union with path halving (Tarjan & van Leeuwen 1984).
/// A set is identified by its largest number.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t(0));
  }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::min(a, b)] = std::max(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace voussoir
