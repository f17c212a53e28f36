// Rows and numbers of text files, with messages that say where.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

/// The lines of a text without their ends (\n or \r\n).
std::vector<std::string_view> lines_of(std::string_view text);
/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);
/// Throws InputError "NAME:ROW: …" for a word that is no number or not finite; `rule` says what rows must be.
double number_in(std::string_view word, const std::string& name, std::size_t row, std::string_view rule);
/// Appends the numbers of a line, with any of `separators` between them.
void append_numbers(std::string_view line, std::string_view separators, const std::string& name, std::size_t row,
                    std::string_view rule, std::vector<double>& values);

}  // namespace voussoir
