// "Did you mean …?" for misspelt words.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// The known word nearest to `word`, or empty if none is near enough. Its edit distance (with transpositions) is at
/// most a third of the length of `word`; a distance of 1 is always allowed.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);
/// ": did you mean 'X'?" or ": expected one of: A, B, C".
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace voussoir
