// Unknown keys of a TOML file, collected so that one message names them all. Only for table_reader.h.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace voussoir {

/// A key that a table may have, with its default and a description of its values.
struct KnownKey {
  std::string name, fallback, expected;  // fallback: the default as text; empty: no default
};

class WrongKeys {
 public:
  /// `where` is "FILE:LINE: "; `known` are the keys of the table `place` ("[damping]").
  void add(const std::string& where, int line, const std::string& key, const std::string& place,
           const std::vector<KnownKey>& known);
  bool any() const { return !keys_.empty(); }
  /// Whether the text is the message about one of the keys.
  bool said(const std::string& text) const;
  /// The message about the key that was added last.
  const std::string& last() const { return keys_.back().text; }
  /// One line for each key, in the order of the file. If no known key has a similar name, a list of the keys of that
  /// table follows.
  std::string message(const std::string& file) const;

 private:
  struct Key {
    int line = 0;
    std::string text;   // "FILE:LINE: unknown key 'x' in [y]: did you mean 'z'?"
    std::string place;  // if no known key has a similar name: the table whose keys are listed
    std::vector<KnownKey> known;
  };
  std::vector<Key> keys_;
};

}  // namespace voussoir
