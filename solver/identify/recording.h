// A simultaneous recording of a set of instruments.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <string>
#include <vector>

namespace voussoir {

struct Recording {
  std::string name;                   // of the file, for messages
  double dt = 0.0;                    // s
  std::vector<std::string> channels;  // sensor ids, and base_x, base_y, base_z if the motion of the ground was recorded
  Eigen::MatrixXd values;             // samples × channels, m/s2
  double duration() const { return values.rows() > 0 ? dt * double(values.rows() - 1) : 0.0; }  // s
};

/// Column of a channel, or −1 if it was not recorded.
inline Eigen::Index column_of(const Recording& record, const std::string& channel) {
  const auto at = std::find(record.channels.begin(), record.channels.end(), channel);
  return at == record.channels.end() ? -1 : Eigen::Index(at - record.channels.begin());
}

}  // namespace voussoir
