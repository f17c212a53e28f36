// Numbers of view.html in few bytes: quantised, as differences, compressed by deflate. The page's unpack.js
// reads what this writes.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir {

/// Values that change from frame to frame. Item i has in each frame `groups` × `width` numbers, kept as shares of the
/// largest of its group over all frames in whole `steps` (at most 32767): an error of at most 0.51 / steps of that.
struct PackedSeries {
  std::size_t items = 0, groups = 1, width = 1;
  int steps = 2047;
  std::vector<std::vector<double>> frames;  // each items × groups × width
};

/// Sections of little-endian numbers one after the other.
class ViewerPack {
 public:
  void add(const std::string& name, const std::vector<std::uint32_t>& numbers);
  void add(const std::string& name, const std::vector<float>& numbers);
  void add(const std::string& name, const std::vector<std::int16_t>& numbers);
  /// NAME_scale (f4, items × groups) and NAME (bytes: for each of groups × width all frames of all items as differences
  /// to the frame before, modulo 2¹⁶, zigzag; first all low bytes, then all high ones).
  void add(const std::string& name, const PackedSeries& series);

  /// Where each section lies: {"name": {"type": "u4", "offset": 0, "count": 12}}; of a series also its sizes.
  const nlohmann::json& sections() const { return sections_; }
  /// All sections, compressed (zlib, RFC 1950). Throws RunError when memory does not suffice.
  std::string compressed() const;

 private:
  void add_bytes(const std::string& name, const char* type, std::size_t count, const void* data, std::size_t size);
  std::string bytes_;
  nlohmann::json sections_ = nlohmann::json::object();
};

/// Bits of a scale that is no less than `largest` (finite, not negative), with so few digits that many are alike.
float coarse_scale(double largest);

}  // namespace voussoir
