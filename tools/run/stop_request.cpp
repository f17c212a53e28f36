#include "tools/run/stop_request.h"

#include <csignal>

namespace voussoir {

namespace {

std::atomic<bool> requested{false};

void ask_to_stop(int) {
  requested.store(true);
}

}  // namespace

std::atomic<bool>& stop_request() {
  return requested;
}

void stop_on_signals() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

}  // namespace voussoir
