// Ground-motion records in plain text columns.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// Samples with a uniform time step, in the unit of the file. The first sample is at t = 0.
struct Record {
  double dt = 0.0;  // s
  std::vector<double> values;
  double duration() const { return values.empty() ? 0.0 : dt * double(values.size() - 1); }
};

/// Reads "time value" rows (blanks, commas or semicolons between; # begins a comment; empty rows are skipped), or rows
/// of one value when `dt` > 0 gives the time step in s. Time steps must be equal within 1e-6 s. Throws InputError
/// "NAME:ROW: …" for text that is not a number, wrong columns, numbers that are not finite, unequal time steps, and
/// fewer than two rows.
Record parse_columns(const std::string& text, const std::string& name, double dt = 0.0);

}  // namespace voussoir
