#include "io/msh/msh_values.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

static_assert(std::endian::native == std::endian::little);

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

template <class Number>
Number value_of(std::string_view raw, bool swapped) {
  char bytes[sizeof(Number)];
  std::copy(raw.begin(), raw.end(), bytes);
  if (swapped) std::reverse(std::begin(bytes), std::end(bytes));
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

void MshValues::fail(const std::string& what) const {
  if (binary_) throw InputError("{}, byte {}: {}", file_, token_, what);
  const auto line = 1 + std::count(bytes_.begin(), bytes_.begin() + std::ptrdiff_t(token_), '\n');
  throw InputError("{}:{}: {}", file_, line, what);
}

void MshValues::skip_blanks() {
  while (at_ < bytes_.size() && blank(bytes_[at_])) ++at_;
}

std::string_view MshValues::word() {
  skip_blanks();
  token_ = at_;
  while (at_ < bytes_.size() && !blank(bytes_[at_])) ++at_;
  return bytes_.substr(token_, at_ - token_);
}

std::int64_t MshValues::whole_word(const char* what) {
  const std::string_view text = word();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty()) fail(fmt::format("the file ends where {} is expected: it is cut off, save it again", what));
  if (error == std::errc::result_out_of_range) fail(fmt::format("{} is {}, which is too large", what, shown(text)));
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("found \"{}\", expected a whole number ({})", shown(text), what));
  return value;
}

std::string MshValues::section() {
  const std::string_view text = word();
  if (text.empty()) return "";
  if (text[0] != '$' || text.size() < 2)
    fail(fmt::format("found \"{}\", expected the beginning of a section such as $Nodes", shown(text)));
  return std::string(text.substr(1));
}

void MshValues::end_section(const std::string& name) {
  const std::string_view text = word();
  if (text == "$End" + name) return;
  if (text.empty()) fail(fmt::format("the file ends before $End{}: it is cut off, save it again", name));
  fail(fmt::format("found \"{}\", expected $End{}: the section is longer than it states", shown(text), name));
}

void MshValues::skip_section(const std::string& name) {
  const std::string end = "$End" + name;
  const std::size_t found = bytes_.find(end, at_);
  if (found == std::string_view::npos)
    fail(fmt::format("the section ${} has no {}: it is cut off", shown(name), shown(end)));
  at_ = found + end.size();
}

void MshValues::end_line() {
  while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
  at_ += at_ < bytes_.size();
}

std::string_view MshValues::take(std::size_t width, const char* what) {
  token_ = at_;
  if (bytes_.size() - at_ < width)
    fail(fmt::format("the file ends where {} is expected: it is cut off, save it again", what));
  at_ += width;
  return bytes_.substr(token_, width);
}

std::int64_t MshValues::integer(std::size_t width, const char* what) {
  if (!binary_) return whole_word(what);
  const std::string_view raw = take(width, what);
  return width == 4 ? value_of<std::int32_t>(raw, swapped_) : value_of<std::int64_t>(raw, swapped_);
}

double MshValues::real(const char* what) {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (binary_) {
    value = value_of<double>(take(8, what), swapped_);
  } else {
    std::string_view text = word();
    const std::string_view whole = text;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range && end == text.data() + text.size() && std::abs(value) < 1.0)
      return 0.0;
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("found \"{}\", expected a number ({})", shown(whole), what));
  }
  if (!std::isfinite(value)) fail(fmt::format("{} is {}, expected a finite number", what, value));
  return value;
}

Vec3 MshValues::point() {
  const double x = real("x of a node"), y = real("y of a node"), z = real("z of a node");
  return {x, y, z};
}

std::size_t MshValues::count(std::int64_t found, std::size_t least_text, std::size_t least_binary,
                             const char* what) const {
  const std::size_t left = bytes_.size() - at_, least = binary_ ? least_binary : least_text;
  if (found < 0 || std::uint64_t(found) > left / least)
    fail(fmt::format("the file states {} {}, but only {} bytes of it are left: save it again", found, what, left));
  return std::size_t(found);
}

void MshValues::end_record(const char* what) {
  if (binary_) return;
  while (at_ < bytes_.size() && bytes_[at_] != '\n' && blank(bytes_[at_])) ++at_;
  if (at_ == bytes_.size() || bytes_[at_] == '\n') return;
  token_ = at_;
  fail(fmt::format("the line of {} has a wrong length: this line, or the one before, has a number too few or too many",
                   what));
}

void MshValues::skip(std::size_t numbers, std::size_t width) {
  for (std::size_t i = 0; i < numbers; ++i) {
    if (binary_)
      take(width, "a number");
    else
      word();
  }
}

}  // namespace voussoir
