// Reads rows and numbers of text files. The errors have the place.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

/// The lines of a text without their ends (\n or \r\n).
std::vector<std::string_view> lines_of(std::string_view text);
/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);
bool is_digit(char c);
/// Separators of the columns of a table.
constexpr std::string_view column_separators = " \t,;\r";
/// The part of a text of a file that a message shows.
std::string_view excerpt(std::string_view text);
std::string upper(std::string_view text);
/// Reads a number. Throws InputError "NAME:ROW: …" if the word is not a number, not finite or larger than 1e12, which
/// no file needs. `rule` describes the expected rows.
double number_in(std::string_view word, const std::string& name, std::size_t row, std::string_view rule);
/// Appends the numbers of a line, with any of `separators` between them.
void append_numbers(std::string_view line, std::string_view separators, const std::string& name, std::size_t row,
                    std::string_view rule, std::vector<double>& values);
/// The first number in a text (0.005 in "at .0050 sec"); NaN if there is none.
double first_number(std::string_view text);
/// Whether a line has at least one word and all its words between `separators` are numbers.
bool all_numbers(std::string_view line, std::string_view separators);

/// Fields of a fixed width, as written by Fortran; there may be no blanks between them.
struct FixedRows {
  std::size_t width = 10, per_row = 8;
};
/// Reads `count` numbers in rows that begin with lines[at]; `at` becomes the line after the last row. Rows with blanks
/// between the numbers are read as well. Throws InputError if the file ends too soon.
std::vector<double> fixed_numbers(const std::vector<std::string_view>& lines, std::size_t& at, std::size_t count,
                                  const FixedRows& rows, const std::string& name);

/// Check a time step (s) and a number of samples in a heading at NAME:ROW. Throw InputError with the allowed range.
double checked_step(double step, const std::string& name, std::size_t row);
std::size_t checked_samples(double samples, const std::string& name, std::size_t row);
/// Throws InputError "NAME: only 5 of 19 samples: the file is incomplete; download it again".
[[noreturn]] void not_whole(const std::string& name, std::size_t samples, std::size_t expected);

}  // namespace voussoir
