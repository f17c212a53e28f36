// Reading TOML tables with errors a person can act on. For the rooms of io that read TOML.
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

/// Allowed values of a number.
struct Limits {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  std::string unit;
  bool above = false;  // low itself is not allowed
};

/// Throws InputError "FILE:LINE: not valid TOML: …".
toml::table parse_toml(const std::string& text, const std::string& path);

/// One table of a case file. It remembers which keys were asked for, so that finish() finds the keys nobody knows. All
/// errors are InputError "FILE:LINE: …".
///
/// Keys nobody knows are gathered over the file and said together, when the outermost table is finished. A required key
/// that is misspelt is read under its wrong name meanwhile.
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
  /// A list of exactly `count` numbers.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Limits& limits = {});
  /// One number or a list of at least one.
  std::vector<double> number_list(const std::string& key, const Limits& limits = {});
  /// One text or a list of texts.
  std::vector<std::string> texts(const std::string& key);
  /// Pairs of numbers in m as (first, 0, second), at least so many; empty where the key is not given. `pair` is what
  /// one is called: "[crown, springing]".
  std::vector<Vec3> pairs(const std::string& key, const std::string& pair, std::size_t least);
  /// Points [[x, z], …] from left to right, y = 0; empty where the key is not given.
  std::vector<Vec3> profile(const std::string& key);
  /// Three numbers. The limits keep sums of their squares finite; a place is within what geometry/extent.h calls far.
  Vec3 vector(const std::string& key, const Vec3& fallback, const Limits& limits = {-1e15, 1e15, ""});
  Vec3 place_in_m(const std::string& key, const Vec3& fallback);
  bool is_list(const std::string& key);
  bool is_text(const std::string& key);

  /// The table under a key; empty when there is none.
  std::optional<TableReader> table(const std::string& key, const std::string& place);
  /// The tables of [[key]].
  std::vector<TableReader> tables(const std::string& key);
  /// Keys of this table, in the file's order; they count as known.
  std::vector<std::string> keys();
  /// The table under one of keys().
  TableReader member(const std::string& key, const std::string& place);

  /// Reads a part of the file. What it throws is kept for finish(), so that wrong keys of later parts are found too; of
  /// several errors the first is kept, for the later ones may come of it.
  void attempt(const std::function<void()>& read);
  /// Whether nothing was found wrong so far.
  bool fine() const { return shared_->error.empty() && !shared_->wrong.any(); }
  /// Notes the keys that were never asked for. Of the outermost table: throws for all that was noted.
  void finish();
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  /// About the table as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void missing(const std::string& key, const std::string& what) const;
  const std::string& place() const { return place_; }

 private:
  struct Shared {
    WrongKeys wrong;
    std::string error;  // of a part that could not be read
  };
  struct Expected {
    std::string fallback, expected;
  };
  TableReader(const toml::table& table, std::string file, std::string place, std::shared_ptr<Shared> shared);
  const toml::node* find(const std::string& key);
  /// The same, noting what belongs there.
  const toml::node* find(const std::string& key, const std::string& expected, const std::string& fallback = "");
  /// Throws when there is no such key, nor one that is likely to be it.
  void need(const std::string& key, const std::string& what);
  /// The key that nobody asked for and that is likely to be `key`; empty: none.
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
  std::map<std::string, std::string> misspelt_;  // required keys, and the wrong names they stand under
};

}  // namespace voussoir
