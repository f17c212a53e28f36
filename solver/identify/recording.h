// What a set of instruments recorded together.
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace voussoir {

struct Recording {
  std::string name;                   // of the file, for messages
  double dt = 0.0;                    // s
  std::vector<std::string> channels;  // sensor ids, and base_x, base_y, base_z where the ground's motion was recorded
  Eigen::MatrixXd values;             // samples × channels, m/s2
  double duration() const { return values.rows() > 0 ? dt * double(values.rows() - 1) : 0.0; }  // s
};

}  // namespace voussoir
