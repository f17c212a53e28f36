// "Did you mean …?" for misspelt words.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// The known word nearest to `word` (edit distance with transpositions, at most a third of its length), or empty.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);
/// ": did you mean 'X'?" or ": expected one of: A, B, C".
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

}  // namespace voussoir
