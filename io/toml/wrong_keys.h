// Keys of a TOML file that nobody knows, gathered so that one message names them all. Of table_reader.h alone.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace voussoir {

/// A key that a table may have, and what belongs there.
struct KnownKey {
  std::string name, fallback, expected;  // fallback: the default as text; empty: none
};

class WrongKeys {
 public:
  /// `where` is "FILE:LINE: "; `known` are the keys of the table `place` ("[damping]").
  void add(const std::string& where, int line, const std::string& key, const std::string& place,
           const std::vector<KnownKey>& known);
  bool any() const { return !keys_.empty(); }
  /// Whether the text is what was said about one of them.
  bool said(const std::string& text) const;
  /// What is said about the last one that was added.
  const std::string& last() const { return keys_.back().text; }
  /// A line for each, in the order of the file, and as a table the keys of every table that holds one without a likely
  /// spelling.
  std::string message(const std::string& file) const;

 private:
  struct Key {
    int line = 0;
    std::string text;   // "FILE:LINE: unknown key 'x' in [y]: did you mean 'z'?"
    std::string place;  // of a key without a likely spelling: whose keys are listed
    std::vector<KnownKey> known;
  };
  std::vector<Key> keys_;
};

}  // namespace voussoir
