// Tables of numbers with several columns: times and components side by side.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/records/format.h"

namespace voussoir {

struct TextTable {
  std::vector<std::vector<double>> columns;  // of the same length
  std::vector<std::string> names;            // of the columns, from the line above them; none where it has not as many
  std::string heading;                       // that line
  std::size_t first_row = 0;                 // line of the first numbers, from 1
};

/// The first run of rows with as many numbers each, with blanks, commas or semicolons between. Where semicolons or
/// blanks separate and no number has a point, commas are decimal ones. Throws InputError "NAME:ROW: …".
TextTable parse_table(std::string_view text, const std::string& name);

/// What a column is: "t", "x", "y", "z"; another word for a component that does not say where it points; "" for none.
std::string column_role(const std::string& name);
/// m/s2 of the unit that a name holds ("NS (g)", "UD [cm/s2]"); s of that of a time; 0: it names none. Throws
/// InputError for a unit that is not known.
double column_unit(const std::string& name);

/// The channels of a table with these roles; `dt` > 0 (s) is used for a table without times, and replaces them else.
/// Throws InputError.
std::vector<RecordFile> channels_of(const TextTable& table, const std::vector<std::string>& roles,
                                    const std::string& name, double dt);

/// Whether a table under a heading has a column of times.
bool has_times(std::string_view text);

/// Words that `columns` of a case and --columns may have.
const std::vector<std::string>& column_words();

}  // namespace voussoir
