// Errors that tell the user what to do. Programming errors are assertions; errors of input or system have these two
// types.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace voussoir {

/// Adds a full stop to the end of a message, unless the message already ends with a punctuation mark or with a list of
/// indented lines.
inline std::string with_full_stop(std::string text) {
  const std::size_t line = text.rfind('\n') + 1;  // 0 where there is one line
  const bool ended = text.empty() || std::string_view(".?!:").find(text.back()) != std::string_view::npos ||
                     text.ends_with("…") || (line > 0 && text.substr(line).starts_with("  "));
  if (!ended) text += '.';
  return text;
}

/// The input is wrong (exit status 2). The text gives place, value found, value expected and remedy, in sentences.
struct InputError : std::runtime_error {
  explicit InputError(const std::string& text) : std::runtime_error(with_full_stop(text)) {}
  template <class... Args>
  explicit InputError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(with_full_stop(fmt::format(text, std::forward<Args>(args)...))) {}
};

/// The input was accepted but the work failed (exit status 1), for example because of a full disk, growing energy or a
/// damaged file.
struct RunError : std::runtime_error {
  explicit RunError(const std::string& text) : std::runtime_error(with_full_stop(text)) {}
  template <class... Args>
  explicit RunError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(with_full_stop(fmt::format(text, std::forward<Args>(args)...))) {}
};

}  // namespace voussoir
