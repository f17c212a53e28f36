#include "io/records/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace voussoir {

namespace {

constexpr std::size_t most_named = 6;

/// A reason without digits and quoted texts.
std::string kind_of(const std::string& reason) {
  std::string kind;
  bool quoted = false;
  for (const char c : reason) {
    if (c == '\'') quoted = !quoted;
    if (!quoted && !std::isdigit(static_cast<unsigned char>(c))) kind += c;
  }
  return kind;
}

std::string names_text(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most_named) text += fmt::format(" and {} more", names.size() - most_named);
  return text;
}

}  // namespace

LeftOut left_out_file(const std::string& path, const std::string& message) {
  std::string reason = message.starts_with(path) ? message.substr(path.size()) : message;
  reason.erase(0, std::min(reason.find_first_not_of(": "), reason.size()));
  const std::size_t digits = std::min(reason.find_first_not_of("0123456789"), reason.size());
  std::string row;
  if (digits > 0 && reason.substr(digits, 2) == ": ") {
    row = reason.substr(0, digits);
    reason.erase(0, digits + 2);
  }
  return {std::filesystem::path(path).filename().string(), reason, row};
}

std::vector<std::string> said_once(const std::vector<LeftOut>& all) {
  std::vector<std::string> kinds;
  std::vector<LeftOut> first;
  std::vector<std::vector<std::string>> names;
  for (const LeftOut& out : all) {
    const std::string kind = kind_of(out.reason);
    const auto at = std::size_t(std::ranges::find(kinds, kind) - kinds.begin());
    if (at == kinds.size()) kinds.push_back(kind), first.push_back(out), names.emplace_back();
    names[at].push_back(out.name);
  }
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    lines.push_back(
        names[i].size() == 1
            ? fmt::format("{}{}{}: {}", first[i].name, first[i].row.empty() ? "" : ":", first[i].row, first[i].reason)
            : fmt::format("{} files or recordings ({}): {}", names[i].size(), names_text(names[i]), first[i].reason));
  return lines;
}

}  // namespace voussoir
