// Ctrl-C while the libraries are at work.
#pragma once
#include <atomic>

namespace voussoir::python {

/// While an object of this class exists on Python's main thread, Ctrl-C sets `stop`. Python itself could not react to
/// Ctrl-C, because its interpreter does not run in this time. On another thread, or if there is such an object already,
/// the object does nothing.
class InterruptWatch {
 public:
  explicit InterruptWatch(std::atomic<bool>& stop);  // the caller must hold the GIL
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  /// Throws KeyboardInterrupt if Ctrl-C was pressed. The caller must hold the GIL.
  void raise_if_pressed() const;

 private:
  bool watches_ = false;
};

}  // namespace voussoir::python
