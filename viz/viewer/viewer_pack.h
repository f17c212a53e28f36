// Compact storage of the numbers of view.html: quantised, as differences, compressed by deflate. unpack.js of the page
// reads this format.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir {

/// Values that change from frame to frame. In each frame, item i has `groups` × `width` numbers, stored as shares of
/// the largest of its group over all frames in integer `steps` (at most 32767). The error is at most 0.51 / steps of
/// that largest value.
struct PackedSeries {
  std::size_t items = 0, groups = 1, width = 1;
  int steps = 2047;
  std::vector<std::vector<double>> frames;  // each items × groups × width
};

/// Consecutive sections of little-endian numbers.
class ViewerPack {
 public:
  void add(const std::string& name, const std::vector<std::uint32_t>& numbers);
  void add(const std::string& name, const std::vector<float>& numbers);
  void add(const std::string& name, const std::vector<std::int16_t>& numbers);
  /// NAME_scale (f4, items × groups) and NAME (bytes: for each of groups × width all frames of all items as differences
  /// to the frame before, modulo 2¹⁶, zigzag; first all low bytes, then all high ones).
  void add(const std::string& name, const PackedSeries& series);

  /// Position of each section: {"name": {"type": "u4", "offset": 0, "count": 12}}; for a series also its sizes.
  const nlohmann::json& sections() const { return sections_; }
  /// All sections, compressed (zlib, RFC 1950). Throws RunError if there is not enough memory.
  std::string compressed() const;

 private:
  void add_bytes(const std::string& name, const char* type, std::size_t count, const void* data, std::size_t size);
  std::string bytes_;
  nlohmann::json sections_ = nlohmann::json::object();
};

/// A scale not smaller than `largest` (finite, not negative), with so few digits that many scales are equal.
float coarse_scale(double largest);

}  // namespace voussoir
