// Texts of cases with changed numbers.
#pragma once
#include <toml++/toml.h>

#include <string>

#include "io/case/case.h"

namespace voussoir::campaign {

/// The text of the case with the lists of a generator written out, so that entries behind `repeat` can be set one by
/// one.
toml::table written_out(const Case& c);

/// The text of the case in a form that can be read in a folder to which write_resolved_case() has written: without
/// [[check]] and with the names of the copies there.
toml::table portable(const Case& c);

/// The number with a dotted key of a case, also if the file uses the default. Throws InputError for a key that is not
/// a number of the case, with the nearest such key.
double number_at(const Case& c, const std::string& key);
/// Sets a number, and creates the tables of its key.
void set_number(toml::table& table, const std::string& key, double value);

std::string text_of(const toml::table& table);

/// Index of the motion stage of the case. Throws InputError unless there is exactly one.
std::size_t motion_stage(const Case& c);

}  // namespace voussoir::campaign
