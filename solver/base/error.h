// Errors a person can act on. Programmer's mistakes are assertions; the world's mistakes are these two types.
#pragma once
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace voussoir {

/// The input is wrong (exit status 2). The text says place, value found, value expected and remedy.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
  template <class... Args>
  explicit InputError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
};

/// The input was accepted but the work failed (exit status 1): disk full, energy growing, a file that rotted.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
  template <class... Args>
  explicit RunError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
};

}  // namespace voussoir
