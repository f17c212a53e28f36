#include "tests/whole/program.h"

#include <poll.h>
#include <signal.h>

#include <optional>

namespace voussoir::test {

Program::Program(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  Launch launch{.words = {VOUSSOIR_PROGRAM},
                .environment = surroundings.environment,
                .folder = surroundings.folder,
                .out = out_.ends[1],
                .err = err_.ends[1],
                .signal_at_our_end = SIGKILL,  // a test that is stopped leaves nothing behind
                .file_size = surroundings.file_size};
  // Unset, the program sets them and starts itself a second time, which would take half of the time of most tests.
  launch.environment.insert({{"OMP_WAIT_POLICY", "passive"}, {"GLIBC_TUNABLES", "glibc.malloc.hugetlb=1"}});
  launch.words.insert(launch.words.end(), arguments.begin(), arguments.end());
  std::optional<LogFile> file;
  if (!surroundings.output_file.empty()) launch.out = file.emplace(surroundings.output_file).descriptor;
  process_ = start(launch);
  out_.close_end(1), err_.close_end(1);
}

Program::~Program() {
  if (!ended_) {
    ::kill(process_, SIGKILL);
    wait_for(process_);
  }
}

/// Waits up to so long for output and takes up what there is.
void Program::drain(int milliseconds) {
  if (out_.ends[0] < 0 && err_.ends[0] < 0) {
    if (milliseconds > 0) pause_milliseconds(5);
    return;
  }
  pollfd ends[] = {{out_.ends[0], POLLIN, 0}, {err_.ends[0], POLLIN, 0}};
  if (::poll(ends, 2, milliseconds) <= 0) return;
  if (ends[0].revents != 0 && !out_.read_to(outcome_.out)) out_.close_end(0);
  if (ends[1].revents != 0 && !err_.read_to(outcome_.err)) err_.close_end(0);
}

void Program::take_end(const Finished& how) {
  ended_ = true;
  outcome_.status = how.status, outcome_.signal = how.signal;
}

bool Program::running() {
  drain(0);
  if (Finished how; !ended_ && has_ended(process_, how)) take_end(how);
  return !ended_;
}

void Program::send(int signal) {
  if (!ended_) ::kill(process_, signal);
}

double Program::first_output(double limit) {
  while (outcome_.out.empty() && outcome_.err.empty() && running() && age() < limit) drain(10);
  return outcome_.out.empty() && outcome_.err.empty() ? -1.0 : age();
}

Outcome Program::wait(double limit) {
  const double end = age() + limit;
  while (running()) {
    drain(20);
    if (age() > end) {
      outcome_.timed_out = true;
      ::kill(process_, SIGKILL);
      take_end(wait_for(process_));
    }
  }
  while (out_.ends[0] >= 0 && out_.read_to(outcome_.out)) {
  }
  while (err_.ends[0] >= 0 && err_.read_to(outcome_.err)) {
  }
  return outcome_;
}

Outcome voussoir(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return Program(arguments, surroundings).wait();
}

bool wait_until(Program& program, const std::function<bool()>& ready, double limit) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit);
  while (!ready()) {
    if (!program.running() || std::chrono::steady_clock::now() > end) return ready();
    pause_milliseconds(2);
  }
  return true;
}

}  // namespace voussoir::test
