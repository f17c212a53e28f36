#include <algorithm>

#include "io/toml/table_reader.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

/// Looks for nested brackets and for keys with many parts. The parser and the destructor of its tables recurse once for
/// each of them, so a hundred thousand of them would use up the stack.
class NestingCheck {
 public:
  NestingCheck(const std::string& text, const std::string& path) : text_(text), path_(path) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == '"' || c == '\'')
        pass_text(c);
      else
        look(c), ++at_;
    }
  }

 private:
  static constexpr int deepest = 32, most_parts = 32;

  /// Moves past a text in quotes. The parser reports a text without an end.
  void pass_text(char quote) {
    const std::string three(3, quote);
    const bool long_form = text_.compare(at_, 3, three) == 0;
    at_ += long_form ? 3 : 1;
    while (at_ < text_.size()) {
      if (quote == '"' && text_[at_] == '\\') {
        at_ += 2;
      } else if (long_form ? text_.compare(at_, 3, three) == 0 : text_[at_] == quote) {
        at_ += long_form ? 3 : 1;
        return;
      } else if (!long_form && text_[at_] == '\n') {
        return;
      } else {
        ++at_;
      }
    }
  }

  void look(char c) {
    if (c == '.') {
      if (++dots_ >= most_parts) fail(fmt::format("a key has more than {} parts with dots between them", most_parts));
      return;
    }
    if (c == '[' || c == '{') {
      if (++depth_ > deepest) fail(fmt::format("brackets are nested {} deep", depth_));
    } else if (c == ']' || c == '}') {
      depth_ = std::max(0, depth_ - 1);
    }
    if (c == ',' || c == '=' || c == '\n' || c == '[' || c == ']' || c == '{' || c == '}') dots_ = 0;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at_), '\n');
    throw InputError("{}:{}: {}. No case needs that: the file is damaged or is not a case", path_, line, what);
  }

  const std::string &text_, &path_;
  std::size_t at_ = 0;
  int depth_ = 0, dots_ = 0;
};

}  // namespace

toml::table parse_toml(const std::string& text, const std::string& path) {
  NestingCheck(text, path).run();
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw InputError("{}:{}: not valid TOML: {}", path, error.source().begin.line, shown(error.description(), 200));
  }
}

}  // namespace voussoir
