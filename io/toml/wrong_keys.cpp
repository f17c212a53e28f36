#include "io/toml/wrong_keys.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/shown.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

/// The keys of a table in columns.
std::string keys_table(const std::vector<KnownKey>& known) {
  std::size_t names = 3, fallbacks = 7;
  for (const KnownKey& k : known) {
    names = std::max(names, k.name.size());
    fallbacks = std::max(fallbacks, k.fallback.size());
  }
  std::string text = fmt::format("  {:<{}}  {:<{}}  expected", "key", names, "default", fallbacks);
  for (const KnownKey& k : known)
    text += fmt::format("\n  {:<{}}  {:<{}}  {}", k.name, names, k.fallback, fallbacks,
                        k.expected.empty() ? "see docs/case-reference.md" : k.expected);
  return text;
}

}  // namespace

void WrongKeys::add(const std::string& where, int line, const std::string& key, const std::string& place,
                    const std::vector<KnownKey>& known) {
  std::vector<std::string> names;
  for (const KnownKey& k : known) names.push_back(k.name);
  const std::string near = nearest_word(key, names);
  Key wrong{line, fmt::format("{}unknown key '{}' in {}", where, shown(key), place), {}, {}};
  if (near.empty()) {
    wrong.text += ": no key of this table has a similar name.";
    wrong.place = place;
    wrong.known = known;
  } else {
    wrong.text += fmt::format(": did you mean '{}'?", near);
  }
  keys_.push_back(std::move(wrong));
}

bool WrongKeys::said(const std::string& text) const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const Key& k) { return k.text == text; });
}

std::string WrongKeys::message(const std::string& file) const {
  std::vector<Key> sorted = keys_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Key& a, const Key& b) { return a.line < b.line; });
  std::string text = sorted.size() > 1 ? fmt::format("{}: {} unknown keys", file, sorted.size()) : "";
  for (const Key& key : sorted) text += (text.empty() ? "" : "\n") + key.text;
  std::vector<std::string> listed;
  for (const Key& key : sorted) {
    if (key.place.empty() || std::find(listed.begin(), listed.end(), key.place) != listed.end()) continue;
    listed.push_back(key.place);
    text += fmt::format("\nkeys of {}:\n{}", key.place, keys_table(key.known));
  }
  return text;
}

}  // namespace voussoir
