// Values as TOML texts that are read back bit for bit. Angles are in degrees in files and in radians in the program.
// Private to io/case.
#pragma once
#include <string>

namespace voussoir {

double to_radians(double degrees);
/// The shortest decimal number that to_radians() converts into exactly `radians`, or into the nearest possible angle.
std::string degrees_text(double radians);
/// The nearest angle that does not change when it is written and read: at most a unit in the last place away.
double writable_angle(double radians);
/// The shortest text of a TOML float that gives the same bits when it is read.
std::string number_text(double value);
/// A TOML basic string.
std::string quoted(const std::string& text);

}  // namespace voussoir
