#include "viz/display.h"

#include <dlfcn.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "solver/base/child.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr int kStartLimit = 30000;  // ms a server may take to start; a busy cluster node can be slow

/// The display number that the server writes once it listens, or empty when it ends or is too slow.
std::string read_number(int from) {
  std::string text;
  while (text.empty() || text.back() != '\n') {
    pollfd wait{from, POLLIN, 0};
    const int ready = ::poll(&wait, 1, kStartLimit);
    if (ready < 0 && errno == EINTR) continue;
    char c = 0;
    if (ready <= 0 || ::read(from, &c, 1) != 1) return "";
    text += c;
  }
  text.pop_back();
  return text;
}

void end_server(pid_t server) {
  ::kill(server, SIGTERM);
  for (int i = 0; i < 200; ++i) {
    if (::waitpid(server, nullptr, WNOHANG) != 0) return;
    ::usleep(10000);
  }
  ::kill(server, SIGKILL);
  ::waitpid(server, nullptr, 0);
}

struct Server {
  pid_t process = -1;
  std::string number;
};

pid_t start_xvfb(const Pipe& number) {
  try {
    return start({.words = {"Xvfb", "-displayfd", std::to_string(number.ends[1]), "-screen", "0", "1920x1440x24",
                            "-nolisten", "tcp", "-noreset"},
                  .kept = number.ends[1],
                  .group = Launch::Group::session,  // Ctrl-C in the terminal reaches only this program, which ends the
                                                    // server itself
                  .signal_at_our_end = SIGTERM});
  } catch (const RunError& error) {
    throw InputError(
        "pictures: there is no display, and Xvfb, which replaces a display, did not start: {} Install the package "
        "xvfb.",
        error.what());
  }
}

Server start_server() {
  Pipe number;
  const pid_t child = start_xvfb(number);
  number.close_end(1);
  const std::string text = read_number(number.ends[0]);
  if (text.empty()) {
    end_server(child);
    throw RunError("pictures: Xvfb did not start within {} s. Run 'Xvfb -displayfd 1' to see why", kStartLimit / 1000);
  }
  return {child, text};
}

}  // namespace

bool display_is_usable() {
  const char* name = std::getenv("DISPLAY");
  // A display over a network connection has no usable OpenGL.
  if (!name || (name[0] != ':' && std::strncmp(name, "unix:", 5) != 0)) return false;
  // Xlib is asked at run time (VTK brings it anyway), so that we need not link to it.
  void* library = ::dlopen("libX11.so.6", RTLD_NOW);
  if (!library) return false;
  using Open = void* (*)(const char*);
  using Query = int (*)(void*, const char*, int*, int*, int*);
  using Close = int (*)(void*);
  const auto open = reinterpret_cast<Open>(::dlsym(library, "XOpenDisplay"));
  const auto query = reinterpret_cast<Query>(::dlsym(library, "XQueryExtension"));
  const auto close = reinterpret_cast<Close>(::dlsym(library, "XCloseDisplay"));
  bool usable = false;
  if (open && query && close)
    if (void* display = open(name)) {
      int opcode = 0, event = 0, error = 0;
      usable = query(display, "GLX", &opcode, &event, &error) != 0;
      close(display);
    }
  ::dlclose(library);
  return usable;
}

Display::Display() {
  if (display_is_usable()) return;
  const char* old = std::getenv("DISPLAY");
  had_display_ = old != nullptr;
  if (old) old_display_ = old;
  const Server server = start_server();
  server_ = server.process;
  ::setenv("DISPLAY", (":" + server.number).c_str(), 1);
}

Display::~Display() {
  if (server_ <= 0) return;
  if (had_display_)
    ::setenv("DISPLAY", old_display_.c_str(), 1);
  else
    ::unsetenv("DISPLAY");
  end_server(server_);
}

}  // namespace voussoir
