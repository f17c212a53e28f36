#include <atomic>
#include <csignal>

#include "tools/campaign/engine.h"

namespace voussoir::campaign {

namespace {
std::atomic<int> signal_seen{0};
void note_signal(int number) {
  signal_seen.store(number);
}
}  // namespace

const std::vector<Engine>& engines() {
  static const std::vector<Engine> list = {local_engine(), slurm_engine()};
  return list;
}

int stop_signal() {
  return signal_seen.load();
}

void watch_signals() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

}  // namespace voussoir::campaign
