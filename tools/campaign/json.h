// Reads JSON with errors that name the place, the key and the expected value.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>

#include "solver/base/error.h"
#include "solver/base/json_file.h"

namespace voussoir::campaign {

using nlohmann::json;

/// Whether a number is whole and in the range of T if T is a whole-number type, because the conversion does not check
/// this.
template <class T>
bool fits(const json& value) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    if (value.is_number_unsigned()) return std::in_range<T>(value.get<std::uint64_t>());
    if (value.is_number_integer()) return std::in_range<T>(value.get<std::int64_t>());
    const double number = value.is_number() ? value.get<double>() : 0.0;
    return number == std::floor(number) && std::abs(number) < 9e15 && std::in_range<T>(std::int64_t(number));
  }
  return true;
}

/// The value of a key. Throws InputError "PLACE: 'KEY' is missing: …", also for a value of another type.
template <class T>
T need(const json& object, const char* key, const std::string& place) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end()) throw InputError("{}: '{}' is missing", place, key);
  if constexpr (std::is_integral_v<T>)
    if (!fits<T>(*found))
      throw InputError("{}: '{}' is {}. It must be a whole number from {} to {}", place, key, json_excerpt(*found),
                       std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max());
  try {
    return found->template get<T>();
  } catch (const json::exception&) {
    throw InputError("{}: '{}' is {}, which has the wrong type", place, key, json_excerpt(*found));
  }
}

/// The same for a key that may be missing or null.
template <class T>
T value_or(const json& object, const char* key, const T& fallback, const std::string& place) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? fallback : need<T>(object, key, place);
}

/// A number, with null for NaN.
inline json number_json(double value) {
  return std::isfinite(value) ? json(value) : json();
}

}  // namespace voussoir::campaign
