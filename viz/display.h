// A virtual display for drawing. VTK 9.1 of Debian draws through X11 only, so on a machine without a screen the
// program starts its own X server and ends it again.
#pragma once
#include <sys/types.h>

#include <string>

namespace voussoir {

/// Whether the environment names a local X display that answers and can draw with OpenGL (GLX).
bool display_is_usable();

/// Guarantees a display during the lifetime of the object. With a usable DISPLAY it does nothing. Otherwise it starts
/// Xvfb with a free number and sets DISPLAY; the destructor ends Xvfb and restores DISPLAY. The server also ends if
/// this process ends in any other way. Create the object in the main thread (the server ends with the thread that
/// started it), before other threads read the environment, and destroy it after all render windows. Throws InputError
/// if Xvfb is not installed and RunError if it does not start.
class Display {
 public:
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  bool own_server() const { return server_ > 0; }
  pid_t server() const { return server_; }  // process id, or −1

 private:
  pid_t server_ = -1;
  bool had_display_ = false;
  std::string old_display_;
};

}  // namespace voussoir
