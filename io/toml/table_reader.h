// Reads TOML tables. The errors name the place, the value found and the value expected. For the rooms of io that read
// TOML.
#pragma once
#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "io/toml/wrong_keys.h"
#include "solver/base/suggestion.h"

namespace voussoir {

/// Allowed range of a number.
struct Limits {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  std::string unit;
  bool above = false;  // low itself is not allowed
};

/// Parses a text; `path` names it in messages. Throws InputError "FILE:LINE: not valid TOML: …".
toml::table parse_toml(const std::string& text, const std::string& path);

/// One table of a case file. It records which keys were read, so that finish() finds the unknown ones. All errors are
/// InputError "FILE:LINE: …".
///
/// The unknown keys of a file are collected and reported together when the outermost table is finished. Until then a
/// required key that is misspelt is read under its wrong name.
class TableReader {
 public:
  /// The outermost table of a file; those within it come from table(), tables() and member().
  TableReader(const toml::table& table, std::string file, std::string place);

  bool has(const std::string& key);
  double number(const std::string& key, double fallback, const Limits& limits = {});
  double required_number(const std::string& key, const Limits& limits = {});
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string required_text(const std::string& key);
  /// Index of the word in the list.
  std::size_t word(const std::string& key, const std::vector<std::string>& words, std::size_t fallback);
  std::size_t required_word(const std::string& key, const std::vector<std::string>& words);
  /// A list of exactly `count` numbers. This key and those of the next two functions are required.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Limits& limits = {});
  /// One number or a list of at least one.
  std::vector<double> number_list(const std::string& key, const Limits& limits = {});
  /// One text or a list of texts.
  std::vector<std::string> texts(const std::string& key);
  /// Pairs of numbers in m as (first, 0, second), at least `least` of them; empty if the key is not given. `pair`
  /// describes a pair in messages: "[crown, springing]".
  std::vector<Vec3> pairs(const std::string& key, const std::string& pair, std::size_t least);
  /// Points [[x, z], …] from left to right, y = 0; empty if the key is not given.
  std::vector<Vec3> profile(const std::string& key);
  /// Three numbers. The default limits keep sums of their squares finite. place_in_m() has the limit of
  /// geometry/extent.h.
  Vec3 vector(const std::string& key, const Vec3& fallback, const Limits& limits = {-1e15, 1e15, ""});
  Vec3 place_in_m(const std::string& key, const Vec3& fallback);
  bool is_list(const std::string& key);
  bool is_text(const std::string& key);

  /// The table under a key; empty if there is none.
  std::optional<TableReader> table(const std::string& key, const std::string& place);
  /// The tables of [[key]].
  std::vector<TableReader> tables(const std::string& key);
  /// Keys of this table, in the order of the file; they count as known.
  std::vector<std::string> keys();
  /// The table under one of keys(). The key must exist.
  TableReader member(const std::string& key, const std::string& place);

  /// Reads a part of the file. An error is kept for finish(), so that wrong keys of later parts are found too. If there
  /// are several errors, the first is kept, because it may have caused the others.
  void attempt(const std::function<void()>& read);
  /// Whether no error was found so far.
  bool fine() const { return shared_->error.empty() && !shared_->wrong.any(); }
  /// Notes the keys that were never read. For the outermost table: throws if anything was noted.
  void finish();
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  /// An error about the table as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void missing(const std::string& key, const std::string& what) const;
  const std::string& place() const { return place_; }

 private:
  struct Shared {
    WrongKeys wrong;
    std::string error;  // the first error of attempt()
  };
  struct Expected {
    std::string fallback, expected;
  };
  TableReader(const toml::table& table, std::string file, std::string place, std::shared_ptr<Shared> shared);
  const toml::node* find(const std::string& key);
  /// The same; notes which values and which default the key has.
  const toml::node* find(const std::string& key, const std::string& expected, const std::string& fallback = "");
  /// Throws if there is neither this key nor an unknown key with a similar name.
  void need(const std::string& key, const std::string& what);
  /// The unknown key that is probably meant as `key`; empty: none.
  std::string misspelt(const std::string& key) const;
  void note_wrong(const std::string& key, const std::vector<KnownKey>& known) const;
  double checked(const std::string& key, const toml::node& node, const Limits& limits) const;
  std::vector<double> list(const std::string& key, const Limits& limits);
  std::string at(const toml::source_region& source) const;

  const toml::table* table_;
  std::string file_, place_;
  std::shared_ptr<Shared> shared_;
  bool outermost_ = false;
  std::map<std::string, Expected> known_;
  std::map<std::string, std::string> misspelt_;  // required keys and the wrong names under which they are given
};

}  // namespace voussoir
