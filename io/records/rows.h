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
bool is_digit(char c);
/// What stands between the columns of a table.
constexpr std::string_view column_separators = " \t,;\r";
/// What a message shows of a text from a file.
std::string_view excerpt(std::string_view text);
std::string upper(std::string_view text);
/// Throws InputError "NAME:ROW: …" for a word that is no number, not finite or beyond 1e12 (no sample and no heading
/// is that large); `rule` says what rows must be.
double number_in(std::string_view word, const std::string& name, std::size_t row, std::string_view rule);
/// Appends the numbers of a line, with any of `separators` between them.
void append_numbers(std::string_view line, std::string_view separators, const std::string& name, std::size_t row,
                    std::string_view rule, std::vector<double>& values);
/// The first number in a text ("at .0050 sec" holds 0.005); none: NaN.
double first_number(std::string_view text);
/// Whether rows of numbers can be told from words: every word between `separators` is a number, and there is one.
bool all_numbers(std::string_view line, std::string_view separators);

/// Fields of a fixed width, as Fortran writes them; they may touch each other.
struct FixedRows {
  std::size_t width = 10, per_row = 8;
};
/// `count` numbers in rows that begin with lines[at]; `at` becomes the line after the last of them. Rows whose numbers
/// stand apart by blanks are read as well. Throws InputError for a file that ends too soon.
std::vector<double> fixed_numbers(const std::vector<std::string_view>& lines, std::size_t& at, std::size_t count,
                                  const FixedRows& rows, const std::string& name);

/// A step (s) and a number of samples as a heading at NAME:ROW says them. Throw InputError with what is expected.
double checked_step(double step, const std::string& name, std::size_t row);
std::size_t checked_samples(double samples, const std::string& name, std::size_t row);
/// "NAME: 5 of 19 samples: the file is incomplete; download it again"
[[noreturn]] void not_whole(const std::string& name, std::size_t samples, std::size_t expected);

}  // namespace voussoir
