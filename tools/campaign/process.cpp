#include "tools/campaign/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "solver/base/error.h"

namespace voussoir::campaign {

namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

/// Owns what posix_spawn is told.
struct SpawnPlan {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnPlan() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
};

pid_t spawn(const SpawnPlan& plan, std::vector<std::string> words) {
  pid_t process = -1;
  const std::vector<char*> arguments = pointers(words);
  const int error = posix_spawnp(&process, arguments[0], &plan.files, &plan.attributes, arguments.data(), environ);
  if (error != 0) throw RunError("cannot start {}: {}", words[0], std::strerror(error));
  return process;
}

Finished finished(int state) {
  Finished how;
  if (WIFEXITED(state)) how.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) how.signal = WTERMSIG(state);
  return how;
}

/// Both ends of a pipe, closed with it.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) throw RunError("cannot make a pipe: {}", std::strerror(errno));
  }
  ~Pipe() {
    for (int i : {0, 1}) close_end(i);
  }
  Pipe(const Pipe&) = delete;
  void close_end(int i) {
    if (ends[i] >= 0) ::close(ends[i]);
    ends[i] = -1;
  }
  /// False at its end.
  bool read_to(std::string& text) {
    char buffer[4096];
    const ssize_t n = ::read(ends[0], buffer, sizeof buffer);
    if (n > 0) text.append(buffer, std::size_t(n));
    return n > 0 || (n < 0 && errno == EINTR);
  }
};

void read_both(Pipe& out, Pipe& err, Answer& answer) {
  while (out.ends[0] >= 0 || err.ends[0] >= 0) {
    pollfd ends[] = {{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}};
    if (::poll(ends, 2, -1) < 0) continue;
    if (ends[0].revents != 0 && !out.read_to(answer.out)) out.close_end(0);
    if (ends[1].revents != 0 && !err.read_to(answer.err)) err.close_end(0);
  }
}

}  // namespace

pid_t start(const std::vector<std::string>& words, const std::string& output) {
  SpawnPlan plan;
  const char* file = output.empty() ? "/dev/null" : output.c_str();
  posix_spawn_file_actions_addopen(&plan.files, STDOUT_FILENO, file, O_WRONLY | O_CREAT | O_APPEND, 0666);
  posix_spawn_file_actions_adddup2(&plan.files, STDOUT_FILENO, STDERR_FILENO);
  // Ctrl-C on a terminal goes to the campaign, which passes it on once.
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigdefault(&plan.attributes, &defaults);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  return spawn(plan, words);
}

bool has_ended(pid_t process, Finished& how) {
  int state = 0;
  if (::waitpid(process, &state, WNOHANG) != process) return false;
  how = finished(state);
  return true;
}

Answer ask(const std::vector<std::string>& words) {
  Pipe out, err;
  SpawnPlan plan;
  posix_spawn_file_actions_adddup2(&plan.files, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&plan.files, err.ends[1], STDERR_FILENO);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP);
  const pid_t process = spawn(plan, words);
  out.close_end(1), err.close_end(1);
  Answer answer;
  read_both(out, err, answer);
  int state = 0;
  while (::waitpid(process, &state, 0) < 0 && errno == EINTR) {
  }
  answer.status = finished(state).status;
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
  if (failed) throw RunError("cannot find the program's own file: {}", failed.message());
  return path;
}

void pause_milliseconds(int milliseconds) {
  const timespec time{milliseconds / 1000, (milliseconds % 1000) * 1000000L};
  ::nanosleep(&time, nullptr);
}

}  // namespace voussoir::campaign
