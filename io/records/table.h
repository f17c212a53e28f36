// Tables of numbers with several columns: times and components.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "io/records/format.h"

namespace voussoir {

struct TextTable {
  std::vector<std::vector<double>> columns;  // of the same length
  /// Names of the columns, from the line above them; empty if the numbers of names and columns differ.
  std::vector<std::string> names;
  std::string heading;        // the line above the columns
  std::size_t first_row = 0;  // line of the first numbers, from 1
};

/// The first sequence of rows with equal numbers of columns, separated by blanks, commas or semicolons. If semicolons
/// or blanks are the separators and no number has a point, commas are decimal commas. Throws InputError "NAME:ROW: …".
TextTable parse_table(std::string_view text, const std::string& name);

/// Meaning of a column: "t", "x", "y", "z"; another word for a component without a known direction; "": no component.
std::string column_role(const std::string& name);
/// Size of the unit in the name of a column ("NS (g)", "UD [cm/s2]"), in m/s2 or, for times, in s; 0: no unit. Throws
/// InputError for an unknown unit.
double column_unit(const std::string& name);

/// The channels of a table with these meanings of its columns. `dt` > 0 (s) is the time step of a table without times,
/// and replaces times. Throws InputError.
std::vector<RecordFile> channels_of(const TextTable& table, const std::vector<std::string>& roles,
                                    const std::string& name, double dt);

/// Whether a table with a heading has a column of times.
bool has_times(std::string_view text);

/// Allowed words of `columns` of a case and of --columns.
const std::vector<std::string>& column_words();

}  // namespace voussoir
