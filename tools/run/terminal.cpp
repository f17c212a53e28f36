#include "tools/run/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace voussoir {

namespace {
constexpr double line_every = 5.0;  // s between lines if the output is not a terminal
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "?";
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

void ProgressLine::show(const Progress& p) {
  if (quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  const bool new_stage = p.stage != last_stage_;
  if (!terminal_ && !new_stage && std::chrono::duration<double>(now - shown_).count() < line_every) return;
  shown_ = now;
  last_stage_ = p.stage;
  std::string line = p.stage;
  if (p.timed)
    line += fmt::format("  t = {:.2f} of {:.2f} s  {:3.0f} %", p.time, p.end, 100.0 * std::min(p.share, 1.0));
  if (p.speed > 0.0) line += fmt::format("  {:.3g} s/s  {} left", p.speed, duration_text(std::max(p.left, 0.0)));
  if (!p.note.empty()) line += "  " + p.note;
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
    open_ = true;
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
}

void ProgressLine::end() {
  if (open_) fmt::print(stderr, "\n");
  open_ = false;
}

}  // namespace voussoir
