// Errors that tell the user what to do. Programming errors are assertions; errors of input or system have these two
// types.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace voussoir {

/// The input is wrong (exit status 2). The text gives place, value found, value expected and remedy.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
  template <class... Args>
  explicit InputError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
};

/// The input was accepted but the work failed (exit status 1), for example because of a full disk, growing energy or a
/// damaged file.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
  template <class... Args>
  explicit RunError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
};

}  // namespace voussoir
