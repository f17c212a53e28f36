#include "viz/display.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr int kStartLimit = 30000;  // ms a server may take to start; a busy cluster node can be slow

/// The reading and writing ends of a pipe; closed on leaving.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC)) throw RunError("cannot make a pipe for Xvfb ({})", std::strerror(errno));
    read = ends[0], write = ends[1];
  }
  ~Pipe() {
    ::close(read);
    close_write();
  }
  void close_write() {
    if (write >= 0) ::close(write);
    write = -1;
  }
};

/// In the child: becomes Xvfb, writing its display number to `out`; says errno through `trouble` when that fails.
[[noreturn]] void become_server(int out, int trouble, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(0);  // the parent died before the line above
  ::setsid();                             // Ctrl-C in the terminal is for the parent, which ends us when it is done
  const int null = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, stream);
  ::fcntl(out, F_SETFD, 0);
  char number[16];
  // Digits by hand: between fork and exec only async-signal-safe calls are allowed.
  int n = 0, tens = 1;
  while (out / tens >= 10) tens *= 10;
  for (; tens > 0; tens /= 10) number[n++] = char('0' + (out / tens) % 10);
  number[n] = 0;
  ::execlp("Xvfb", "Xvfb", "-displayfd", number, "-screen", "0", "1920x1440x24", "-nolisten", "tcp", "-noreset",
           static_cast<char*>(nullptr));
  const int reason = errno;
  [[maybe_unused]] const auto written = ::write(trouble, &reason, sizeof reason);
  ::_exit(127);
}

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

Server start_server() {
  Pipe number, trouble;
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw RunError("cannot start Xvfb ({})", std::strerror(errno));
  if (child == 0) become_server(number.write, trouble.write, parent);
  number.close_write();
  trouble.close_write();
  int reason = 0;
  if (::read(trouble.read, &reason, sizeof reason) == sizeof reason) {  // closed by a successful exec
    ::waitpid(child, nullptr, 0);
    throw InputError(
        "pictures: there is no display, and Xvfb, which draws without one, cannot be started ({}); install "
        "the package xvfb",
        std::strerror(reason));
  }
  const std::string text = read_number(number.read);
  if (text.empty()) {
    end_server(child);
    throw RunError("pictures: Xvfb did not start within {} s; run 'Xvfb -displayfd 1' to see why", kStartLimit / 1000);
  }
  return {child, text};
}

}  // namespace

bool display_is_usable() {
  const char* name = std::getenv("DISPLAY");
  // A display at the other end of a network connection has no OpenGL worth the name.
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
