// Ctrl-C while the libraries are at work.
#pragma once
#include <atomic>

namespace voussoir::python {

/// While one lives on Python's main thread, Ctrl-C sets `stop` instead of waiting for the interpreter, which does not
/// run meanwhile. On another thread it does nothing: Ctrl-C goes to the main thread then.
class InterruptWatch {
 public:
  explicit InterruptWatch(std::atomic<bool>& stop);  // with the GIL
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  /// Throws KeyboardInterrupt if it was pressed; with the GIL.
  void raise_if_pressed() const;

 private:
  bool watches_ = false;
};

}  // namespace voussoir::python
