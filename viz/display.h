// A display to draw on where there is none. Debian's VTK 9.1 draws through X11 only, so on a machine with no screen we
// start our own virtual X server and end it again.
#pragma once
#include <sys/types.h>

#include <string>

namespace voussoir {

/// Whether the environment names a local X display that answers and can draw with OpenGL (GLX).
bool display_is_usable();

/// Makes sure that a display exists as long as the object lives. With a usable DISPLAY it does nothing; else it starts
/// Xvfb on a free number, sets DISPLAY, and on destruction ends Xvfb and puts DISPLAY back. The server also ends when
/// this process dies in any other way. Make it in the main thread (the server ends with the thread that made it),
/// before other threads read the environment, and let it outlive every render window. Throws InputError when Xvfb is
/// not installed and RunError when it does not start.
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
