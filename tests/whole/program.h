// The program as a user starts it: a process of its own in a temporary folder, watched from outside.
#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "solver/base/child.h"
#include "tests/folder.h"

namespace voussoir::test {

/// How a process ended and what it said.
struct Outcome {
  int status = -1;         // exit status; −1 when it did not exit by itself
  int signal = 0;          // that ended it, 0 for none
  bool timed_out = false;  // killed by us
  std::string out, err;
};

/// Surroundings of a process.
struct Surroundings {
  std::string folder = ".";                          // working folder
  long file_size = -1;                               // bytes a file may have (RLIMIT_FSIZE); −1: no limit
  std::string output_file{};                         // where standard output goes instead of to us
  std::map<std::string, std::string> environment{};  // changed variables; an empty value removes one
};

/// A voussoir at work in the background; killed when the object goes. Only SIGKILL is beyond it, so that one is used.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});
  ~Program();
  Program(const Program&) = delete;

  bool running();  // also takes up what it has written meanwhile
  void send(int signal);
  /// Waits at most so many seconds for the first byte on either stream; the seconds it took, or −1.
  double first_output(double limit = 30.0);
  /// Waits for the end; kills after `limit` s.
  Outcome wait(double limit = 120.0);
  const Outcome& so_far() const { return outcome_; }

 private:
  void drain(int milliseconds);
  void take_end(const Finished& how);
  double age() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }

  pid_t process_ = -1;
  bool ended_ = false;
  Pipe out_, err_;
  Outcome outcome_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// Runs the program to its end.
Outcome voussoir(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

/// Waits until `ready()` or until the program has ended or `limit` s have passed; what ready() says then.
bool wait_until(Program& program, const std::function<bool()>& ready, double limit = 60.0);

}  // namespace voussoir::test
