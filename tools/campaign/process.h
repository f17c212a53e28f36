// Child processes, never through a shell: what stands in their arguments stays an argument.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace voussoir::campaign {

/// Starts a program (looked up in PATH unless its name has a slash) in a process group of its own, with nothing on its
/// standard input and its output at the end of a file ("" for none). Throws RunError with the system's reason.
pid_t start(const std::vector<std::string>& words, const std::string& output);

struct Finished {
  int status = -1;  // exit status; −1 when it did not exit by itself
  int signal = 0;   // that ended it
};
/// True once the process has ended; does not wait.
bool has_ended(pid_t process, Finished& how);

struct Answer {
  int status = -1;
  std::string out, err;
};
/// Runs a program to its end and reads what it says. Throws RunError when it cannot be started.
Answer ask(const std::vector<std::string>& words);

bool in_path(const std::string& program);
/// This program's file.
std::string own_program();
void pause_milliseconds(int milliseconds);

}  // namespace voussoir::campaign
