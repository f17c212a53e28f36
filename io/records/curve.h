// Measured curves as text: two columns, whatever they are.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct Curve {
  std::vector<double> x, y;  // same length, two points at least; in the file's units
};

/// The first two columns of a text of numbers, apart by blanks, commas or semicolons. Lines before the first that
/// begins with two numbers are headings; `name` stands in messages. Throws InputError "NAME:ROW: …" on a later line
/// that does not, InputError "NAME: …" on fewer than two points.
Curve parse_curve(const std::string& text, const std::string& name);

}  // namespace voussoir
