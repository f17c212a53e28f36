// The progress of a run: on a terminal one line that is updated in place, otherwise a line every few seconds.
#pragma once
#include <chrono>

#include "solver/run/simulation.h"

namespace voussoir {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  void show(const Progress& progress);
  /// Ends the line, so that further output starts on a new one.
  void end();

 private:
  bool quiet_, terminal_, open_ = false;
  std::string last_stage_;
  std::chrono::steady_clock::time_point shown_{};
};

/// 75 s → "1 min 15 s".
std::string duration_text(double seconds);

}  // namespace voussoir
