// Sorting a long list whose items belong to many places in order, a few to each.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace voussoir {

/// Sorts as std::sort() does, where `place_of(item)`, below `places`, never falls from an item to one that is not less:
/// by places first, then within each. Its time grows with the list, that of std::sort() faster.
template <class T, class PlaceOf>
void sort_by_place(std::vector<T>& list, std::size_t places, const PlaceOf& place_of) {
  std::vector<std::size_t> next(places + 1, 0);
  for (const T& item : list) ++next[std::size_t(place_of(item)) + 1];
  for (std::size_t i = 0; i < places; ++i) next[i + 1] += next[i];
  std::vector<T> sorted(list.size());
  for (T& item : list) sorted[next[std::size_t(place_of(item))]++] = std::move(item);
  list = std::move(sorted);
  // Each place now begins where the one before it ends.
  for (std::size_t i = 0, begin = 0; i < places; begin = next[i++])
    std::sort(list.begin() + std::ptrdiff_t(begin), list.begin() + std::ptrdiff_t(next[i]));
}

}  // namespace voussoir
