// One axis of a chart: its range, its round ticks, and where a value lies along it.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct Axis {
  double low = 0.0, high = 1.0;  // values at the two ends
  bool logarithmic = false;
  std::vector<double> ticks;  // labelled
  std::vector<double> minor;  // grid lines without a label; logarithmic only
  /// 0 at `low` … 1 at `high`.
  double share(double value) const;
};

/// An axis for values between `low` and `high` with about `count` ticks. `widen` moves the ends out to ticks. A
/// logarithmic one needs 0 < low. A range of no length is widened about its value.
Axis make_axis(double low, double high, bool logarithmic, bool widen, int count);

/// The tick's value in words, without trailing noise: "0.5", "20", "1e-06".
std::string tick_label(const Axis& axis, double tick);

}  // namespace voussoir
