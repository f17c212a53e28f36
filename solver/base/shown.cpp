#include "solver/base/shown.h"

#include <fmt/format.h>

#include <algorithm>

namespace voussoir {

namespace {

/// Bytes of the UTF-8 character that begins here; 0 where none does.
std::size_t character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? (unsigned char)(text[i]) : 0u; };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 && first != 0x7f;
  const std::size_t length = first >= 0xf0 && first <= 0xf4  ? 4
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xc2 && first < 0xe0 ? 2
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xc0u) != 0x80u) return 0;
  if (first == 0xc2 && byte(at + 1) < 0xa0) return 0;  // control characters
  return length;
}

}  // namespace

std::string shown(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size() && at < most) {
    const std::size_t length = character_at(text, at);
    if (length == 0)
      out += fmt::format("\\x{:02x}", (unsigned char)(text[at]));
    else
      out += text.substr(at, length);
    at += length > 0 ? length : 1;
  }
  if (at < text.size()) out += fmt::format("… ({} bytes)", text.size());
  return out;
}

std::string without_long_words(std::string_view message) {
  constexpr std::size_t longest = 400, kept = 100;
  std::string out;
  while (!message.empty()) {
    const std::size_t end = std::min(message.find_first_of(" \n"), message.size());
    out += end > longest ? shown(message.substr(0, end), kept) : std::string(message.substr(0, end));
    out += message.substr(end, 1);
    message.remove_prefix(std::min(end + 1, message.size()));
  }
  return out;
}

}  // namespace voussoir
