#include "solver/base/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "solver/base/error.h"

namespace voussoir {

namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

/// "NAME=value" of ours with the changes.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> list;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) list.push_back(text);
  }
  for (const auto& [name, value] : changes)
    if (!value.empty()) list.push_back(name + "=" + value);
  return list;
}

/// False with errno.
bool put(int descriptor, int stream) {
  return descriptor == stream ? ::fcntl(stream, F_SETFD, 0) == 0 : ::dup2(descriptor, stream) >= 0;
}

/// In the child, where only what is safe after fork() may be called. False with errno.
bool settle(const Launch& launch, pid_t parent) {
  if (launch.signal_at_our_end != 0) {
    ::prctl(PR_SET_PDEATHSIG, launch.signal_at_our_end);
    if (::getppid() != parent) ::_exit(126);  // we had ended before that line
  }
  if (launch.group == Launch::Group::own) ::setpgid(0, 0);
  if (launch.group == Launch::Group::session) ::setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  if (!launch.folder.empty() && ::chdir(launch.folder.c_str()) != 0) return false;
  const int null = ::open("/dev/null", O_RDWR);
  if (null < 0 || !put(null, STDIN_FILENO)) return false;
  if (!put(launch.out < 0 ? null : launch.out, STDOUT_FILENO)) return false;
  if (!put(launch.err < 0 ? null : launch.err, STDERR_FILENO)) return false;
  if (null > STDERR_FILENO) ::close(null);
  if (launch.kept >= 0 && ::fcntl(launch.kept, F_SETFD, 0) < 0) return false;
  if (launch.file_size < 0) return true;
  const rlimit limit{rlim_t(launch.file_size), rlim_t(launch.file_size)};
  return ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

Finished finished(int state) {
  Finished how;
  if (WIFEXITED(state)) how.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) how.signal = WTERMSIG(state);
  return how;
}

void read_both(Pipe& out, Pipe& err, Answer& answer) {
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    pollfd ends[] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
    if (::poll(ends, 2, -1) < 0) continue;
    if (ends[0].revents != 0 && !out.read_to(answer.out)) out.close_end(0);
    if (ends[1].revents != 0 && !err.read_to(answer.err)) err.close_end(0);
  }
}

}  // namespace

pid_t start(const Launch& launch) {
  std::vector<std::string> words = launch.words, variables = environment_with(launch.environment);
  const std::vector<char*> arguments = pointers(words), environment = pointers(variables);
  Pipe trouble;  // what a child writes that could not become the program; closed by one that did
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw RunError("cannot start {}: {}", words[0], std::strerror(errno));
  if (child == 0) {
    if (settle(launch, parent)) ::execvpe(arguments[0], arguments.data(), environment.data());
    const int reason = errno;
    [[maybe_unused]] const auto written = ::write(trouble.ends[1], &reason, sizeof reason);
    ::_exit(127);
  }
  trouble.close_end(1);
  std::string said;
  while (trouble.read_to(said)) {
  }
  if (said.empty()) return child;
  wait_for(child);
  int reason = 0;
  std::memcpy(&reason, said.data(), std::min(said.size(), sizeof reason));
  throw RunError("cannot start {}: {}", words[0], std::strerror(reason));
}

bool has_ended(pid_t process, Finished& how) {
  int state = 0;
  if (::waitpid(process, &state, WNOHANG) != process) return false;
  how = finished(state);
  return true;
}

Finished wait_for(pid_t process) {
  int state = 0;
  while (::waitpid(process, &state, 0) < 0 && errno == EINTR) {
  }
  return finished(state);
}

Pipe::Pipe() {
  if (::pipe2(ends, O_CLOEXEC) != 0) throw RunError("cannot make a pipe: {}", std::strerror(errno));
}

Pipe::~Pipe() {
  for (const int i : {0, 1}) close_end(i);
}

void Pipe::close_end(int i) {
  if (ends[i] >= 0) ::close(ends[i]);
  ends[i] = -1;
}

bool Pipe::read_to(std::string& text) {
  char buffer[1 << 14];
  const ssize_t n = ::read(ends[0], buffer, sizeof buffer);
  if (n > 0) text.append(buffer, std::size_t(n));
  return n > 0 || (n < 0 && errno == EINTR);
}

LogFile::LogFile(const std::string& path)
    : descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor < 0) throw RunError("cannot write {}: {}", path, std::strerror(errno));
}

LogFile::~LogFile() {
  ::close(descriptor);
}

Answer ask(const std::vector<std::string>& words) {
  Pipe out, err;
  const pid_t process = start({.words = words, .out = out.ends[1], .err = err.ends[1], .group = Launch::Group::own});
  out.close_end(1), err.close_end(1);
  Answer answer;
  read_both(out, err, answer);
  answer.status = wait_for(process).status;
  return answer;
}

bool in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folder;
  for (const char* c = path ? path : "";; ++c) {
    if (*c != ':' && *c != '\0') {
      folder += *c;
      continue;
    }
    if (::access((folder.empty() ? program : folder + "/" + program).c_str(), X_OK) == 0) return true;
    folder.clear();
    if (*c == '\0') return false;
  }
}

std::string own_program() {
  std::error_code failed;
  const std::string path = std::filesystem::read_symlink("/proc/self/exe", failed).string();
  if (failed) throw RunError("cannot find the executable file of this program: {}", failed.message());
  return path;
}

void pause_milliseconds(int milliseconds) {
  const timespec time{milliseconds / 1000, (milliseconds % 1000) * 1000000L};
  ::nanosleep(&time, nullptr);
}

}  // namespace voussoir
