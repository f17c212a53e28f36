// Texts of cases with some numbers changed.
#pragma once
#include <toml++/toml.h>

#include <string>

#include "io/case/case.h"

namespace voussoir::campaign {

/// The case's own text, with lists of a generator written out: what `repeat` stands for can be set one by one.
toml::table written_out(const Case& c);

/// The case's own text in a form that can be read in a folder where write_resolved_case() has been: without [[check]],
/// and with the names of the copies there.
toml::table portable(const Case& c);

/// The number under a dotted key of a case, also where the file leaves it to the default. Throws InputError for a key
/// that is no number of the case, with the nearest that is.
double number_at(const Case& c, const std::string& key);
/// Sets it, with the tables on the way.
void set_number(toml::table& table, const std::string& key, double value);

std::string text_of(const toml::table& table);

/// Which of the case's stages is its motion. Throws InputError unless there is exactly one.
std::size_t motion_stage(const Case& c);

}  // namespace voussoir::campaign
