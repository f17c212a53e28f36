// Values of files and options as messages show them.
#pragma once
#include <string>
#include <string_view>

namespace voussoir {

/// `text` as it may stand in a message: its first `most` bytes with "… (N bytes)" behind when it is longer, and bytes
/// that are not printable as \xNN, so that a value of megabytes or one with escape codes leaves the message readable.
std::string shown(std::string_view text, std::size_t most = 60);

/// A whole message in which no word is longer than a few lines, for values that went in as they are.
std::string without_long_words(std::string_view message);

}  // namespace voussoir
