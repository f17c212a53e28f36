// Measured curves in text files: two columns.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct Curve {
  std::vector<double> x, y;  // same length, at least two points; in the units of the file
};

/// The first two columns of a text of numbers, separated by blanks, commas or semicolons. Lines before the first line
/// that begins with two numbers are headings; empty lines and lines that begin with # are skipped. `name` is used in
/// messages. Throws InputError "NAME:ROW: …" for a later line that does not begin with two numbers, and "NAME: …" for
/// fewer than two points.
Curve parse_curve(const std::string& text, const std::string& name);

}  // namespace voussoir
