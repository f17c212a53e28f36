// A request to stop, by a signal or a time limit. It holds for everything that this process computes.
#pragma once
#include <atomic>

namespace voussoir {

/// True once the process was asked to stop. Observers::stop may point to it.
std::atomic<bool>& stop_request();

/// From now on SIGINT and SIGTERM are requests to stop; they do not end the process.
void stop_on_signals();

}  // namespace voussoir
