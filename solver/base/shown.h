// Values of files and options in the form for messages.
#pragma once
#include <string>
#include <string_view>

namespace voussoir {

/// `text` in a form for messages: at most its first `most` bytes, followed by "… (N bytes)" if it is longer, and
/// unprintable bytes as \xNN. Long values and escape codes therefore do not make a message unreadable.
std::string shown(std::string_view text, std::size_t most = 60);

/// A message in which words longer than a few lines are shortened, for values that were inserted unchanged.
std::string without_long_words(std::string_view message);

}  // namespace voussoir
