// Measurement of wall-clock time.
#pragma once
#include <chrono>

namespace voussoir {

/// Adds the wall-clock time between its construction and destruction to a sum.
class Timed {
  using Clock = std::chrono::steady_clock;

 public:
  explicit Timed(double& sum) : sum_(sum) {}
  ~Timed() { sum_ += std::chrono::duration<double>(Clock::now() - begun_).count(); }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  Clock::time_point begun_ = Clock::now();
};

}  // namespace voussoir
