// Sorts a long list whose items belong to many ordered places, with a few items for each place.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace voussoir {

/// Gives the same result as std::sort() if `place_of(item)`, below `places`, is consistent with the order of the items.
/// It sorts by place first, then within each place. Its time is in proportion to the length of the list.
template <class T, class PlaceOf>
void sort_by_place(std::vector<T>& list, std::size_t places, const PlaceOf& place_of) {
  std::vector<std::size_t> next(places + 1, 0);
  for (const T& item : list) ++next[std::size_t(place_of(item)) + 1];
  for (std::size_t i = 0; i < places; ++i) next[i + 1] += next[i];
  std::vector<T> sorted(list.size());
  for (T& item : list) sorted[next[std::size_t(place_of(item))]++] = std::move(item);
  list = std::move(sorted);
  // Each place now begins at the end of the previous one.
  for (std::size_t i = 0, begin = 0; i < places; begin = next[i++])
    std::sort(list.begin() + std::ptrdiff_t(begin), list.begin() + std::ptrdiff_t(next[i]));
}

}  // namespace voussoir
