// Values as TOML texts, read back without losing a bit; angles are degrees in files and radians inside. Private to
// io/case.
#pragma once
#include <string>

namespace voussoir {

double to_radians(double degrees);
/// The shortest decimal number that to_radians() turns into exactly `radians`, or the nearest there is.
std::string degrees_text(double radians);
/// The angle that survives being written and read: at most a unit in the last place away.
double writable_angle(double radians);
/// The shortest text of a TOML float that is read back to the same bits.
std::string number_text(double value);
/// A TOML basic string.
std::string quoted(const std::string& text);

}  // namespace voussoir
