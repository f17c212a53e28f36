#include "tests/whole/program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace voussoir::test {

namespace fs = std::filesystem;

namespace {

/// Our environment with the changes, as "NAME=value".
std::vector<std::string> environment_of(const Surroundings& surroundings) {
  std::vector<std::string> list;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!surroundings.environment.contains(text.substr(0, text.find('=')))) list.push_back(text);
  }
  // Unset, the program sets them and starts itself a second time, which would take half of the time of most tests.
  for (const auto& [name, value] :
       {std::pair("OMP_WAIT_POLICY", "passive"), {"GLIBC_TUNABLES", "glibc.malloc.hugetlb=1"}})
    if (!surroundings.environment.contains(name)) list.push_back(std::string(name) + "=" + value);
  for (const auto& [name, value] : surroundings.environment)
    if (!value.empty()) list.push_back(name + "=" + value);
  return list;
}

std::vector<char*> pointers(std::vector<std::string>& list) {
  std::vector<char*> result;
  for (std::string& text : list) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// In the child, before exec.
void settle(const Surroundings& surroundings, int out, int err, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is stopped leaves nothing behind
  if (::getppid() != parent) ::_exit(126);
  if (!surroundings.output_file.empty()) out = ::open(surroundings.output_file.c_str(), O_WRONLY);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
  if (surroundings.file_size >= 0) {
    const rlimit limit{rlim_t(surroundings.file_size), rlim_t(surroundings.file_size)};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
}

bool read_some(int& from, std::string& to) {
  char buffer[1 << 14];
  const ssize_t n = ::read(from, buffer, sizeof buffer);
  if (n > 0) to.append(buffer, std::size_t(n));
  if (n > 0) return true;
  if (n == 0) ::close(from), from = -1;
  return false;
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  std::vector<std::string> words = {VOUSSOIR_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_of(surroundings);
  const std::vector<char*> argv = pointers(words), envp = pointers(variables);
  int out[2], err[2];
  if (::pipe2(out, O_CLOEXEC) || ::pipe2(err, O_CLOEXEC)) throw std::runtime_error("cannot make a pipe");
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("cannot fork");
  if (process_ == 0) {
    settle(surroundings, out[1], err[1], parent);
    ::execve(VOUSSOIR_PROGRAM, argv.data(), envp.data());
    ::_exit(127);
  }
  ::close(out[1]);
  ::close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

Program::~Program() {
  if (!ended_) {
    ::kill(process_, SIGKILL);
    reap(0);
  }
  for (const int end : {out_, err_})
    if (end >= 0) ::close(end);
}

/// Waits up to so long for output and takes up what there is.
void Program::drain(int milliseconds) {
  std::vector<pollfd> ends;
  for (const int end : {out_, err_})
    if (end >= 0) ends.push_back({end, POLLIN, 0});
  if (ends.empty()) {
    if (milliseconds > 0) ::usleep(5000);
    return;
  }
  if (::poll(ends.data(), nfds_t(ends.size()), milliseconds) <= 0) return;
  for (const pollfd& end : ends) {
    if (end.revents == 0) continue;
    if (end.fd == out_)
      read_some(out_, outcome_.out);
    else
      read_some(err_, outcome_.err);
  }
}

void Program::reap(int options) {
  int state = 0;
  if (ended_ || ::waitpid(process_, &state, options) != process_) return;
  ended_ = true;
  if (WIFEXITED(state)) outcome_.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) outcome_.signal = WTERMSIG(state);
}

bool Program::running() {
  drain(0);
  reap(WNOHANG);
  return !ended_;
}

void Program::send(int signal) {
  if (!ended_) ::kill(process_, signal);
}

double Program::first_output(double limit) {
  while (outcome_.out.empty() && outcome_.err.empty() && !ended_ && age() < limit) {
    drain(10);
    reap(WNOHANG);
  }
  return outcome_.out.empty() && outcome_.err.empty() ? -1.0 : age();
}

Outcome Program::wait(double limit) {
  const double end = age() + limit;
  while (!ended_) {
    drain(20);
    reap(WNOHANG);
    if (!ended_ && age() > end) {
      outcome_.timed_out = true;
      ::kill(process_, SIGKILL);
      reap(0);
    }
  }
  while (out_ >= 0 && read_some(out_, outcome_.out)) {
  }
  while (err_ >= 0 && read_some(err_, outcome_.err)) {
  }
  return outcome_;
}

Outcome voussoir(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return Program(arguments, surroundings).wait();
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "voussoir-whole-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  set_bytes(*this / name, text);
  return *this / name;
}

bool exists(const std::string& path) {
  return fs::exists(path);
}

std::string bytes_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void set_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << bytes;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) found[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path().string());
  return found;
}

bool wait_until(Program& program, const std::function<bool()>& ready, double limit) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  while (!ready()) {
    if (!program.running() || std::chrono::steady_clock::now() > end) return ready();
    ::usleep(2000);
  }
  return true;
}

}  // namespace voussoir::test
