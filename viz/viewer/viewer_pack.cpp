#include "viz/viewer/viewer_pack.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

namespace {

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

/// Small differences of either sign as small numbers: 0, −1, 1, −2 … are 0, 1, 2, 3 …
std::uint16_t zigzag(std::uint16_t difference) {
  const auto d = std::int16_t(difference);
  return std::uint16_t((d << 1) ^ (d >> 15));
}

}  // namespace

float coarse_scale(double largest) {
  if (!(largest > 0.0)) return 0.0F;
  constexpr std::uint32_t rest = 0xffff;  // a sign, an exponent and seven digits stay
  const float above = std::nextafter(float(largest), INFINITY);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(above) + rest) & ~rest);
}

void ViewerPack::add_bytes(const std::string& name, const char* type, std::size_t count, const void* data,
                           std::size_t size) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);  // the page looks at sections as arrays of numbers
  sections_[name] = {{"type", type}, {"offset", bytes_.size()}, {"count", count}};
  bytes_.append(static_cast<const char*>(data), size);
}

void ViewerPack::add(const std::string& name, const std::vector<std::uint32_t>& numbers) {
  add_bytes(name, "u4", numbers.size(), numbers.data(), 4 * numbers.size());
}

void ViewerPack::add(const std::string& name, const std::vector<float>& numbers) {
  add_bytes(name, "f4", numbers.size(), numbers.data(), 4 * numbers.size());
}

void ViewerPack::add(const std::string& name, const std::vector<std::int16_t>& numbers) {
  add_bytes(name, "i2", numbers.size(), numbers.data(), 2 * numbers.size());
}

void ViewerPack::add(const std::string& name, const PackedSeries& series) {
  const std::size_t columns = series.groups * series.width;
  std::vector<float> scale(series.items * series.groups, 0.0F);
  for (std::size_t k = 0; k < scale.size(); ++k) {
    double largest = 0.0;
    for (const std::vector<double>& frame : series.frames)
      for (std::size_t c = 0; c < series.width; ++c) {
        const double value = std::abs(frame[k * series.width + c]);
        if (value < 1e30) largest = std::max(largest, value);  // a failed run may contain any value
      }
    scale[k] = coarse_scale(largest);
  }
  const std::size_t per_column = series.frames.size() * series.items, all = columns * per_column;
  std::string planes(2 * all, '\0');
  std::size_t at = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    std::vector<std::uint16_t> before(series.items, 0);
    for (const std::vector<double>& frame : series.frames)
      for (std::size_t i = 0; i < series.items; ++i, ++at) {
        const double top = scale[i * series.groups + c / series.width];
        const double share = top > 0.0 ? frame[i * columns + c] / top : 0.0;
        const double step = std::isfinite(share) ? std::round(series.steps * std::clamp(share, -1.0, 1.0)) : 0.0;
        const auto now = std::uint16_t(std::int16_t(step));
        const std::uint16_t code = zigzag(std::uint16_t(now - before[i]));
        planes[at] = char(code & 0xff), planes[all + at] = char(code >> 8);
        before[i] = now;
      }
  }
  add(name + "_scale", scale);
  add_bytes(name, "series", planes.size(), planes.data(), planes.size());
  sections_[name].update({{"items", series.items},
                          {"groups", series.groups},
                          {"width", series.width},
                          {"frames", series.frames.size()},
                          {"steps", series.steps}});
}

std::string ViewerPack::compressed() const {
  uLongf size = compressBound(uLong(bytes_.size()));
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes_.data()),
                uLong(bytes_.size()), Z_BEST_COMPRESSION) != Z_OK)
    throw RunError("the data of the page ({} bytes) cannot be compressed. Use fewer frames with --frames",
                   bytes_.size());
  out.resize(size);
  return out;
}

}  // namespace voussoir
