// Ground-motion records as plain text columns.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

/// Samples on a uniform time grid, in the file's own unit. The first sample is taken to be at t = 0.
struct Record {
  double dt = 0.0;  // s
  std::vector<double> values;
  double duration() const { return values.empty() ? 0.0 : dt * double(values.size() - 1); }
};

/// Reads "time value" rows (blanks, commas or semicolons between; # begins a comment; empty rows are skipped), or rows
/// of one value when `dt` > 0 gives the time step in s. Times must increase evenly within 1e-6 s. Throws InputError
/// "NAME:ROW: …" on text that is not a number, wrong columns, numbers that are not finite, uneven times, fewer than two
/// rows.
Record parse_columns(const std::string& text, const std::string& name, double dt = 0.0);

}  // namespace voussoir
