// What a person sees while a run goes on: one line that keeps changing on a terminal, a line every few seconds
// elsewhere.
#pragma once
#include <chrono>

#include "solver/run/simulation.h"

namespace voussoir {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  void show(const Progress& progress);
  /// Ends the changing line, so that what follows starts on its own.
  void end();

 private:
  bool quiet_, terminal_, open_ = false;
  std::string last_stage_;
  std::chrono::steady_clock::time_point shown_{};
};

/// 75 s → "1 min 15 s".
std::string duration_text(double seconds);

}  // namespace voussoir
