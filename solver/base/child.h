// Child processes, never through a shell: what stands in their arguments stays an argument.
#pragma once
#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace voussoir {

/// What a child starts with. Streams are descriptors of ours, −1 is /dev/null.
struct Launch {
  std::vector<std::string> words;  // the program, looked up in PATH unless its name has a slash, and its words
  std::map<std::string, std::string> environment{};  // what differs from ours; an empty value removes a variable
  std::string folder{};                              // working folder; "": ours
  int out = -1, err = -1;                            // nothing is on its standard input
  int kept = -1;                                     // a further descriptor that it finds under the same number
  enum class Group { ours, own, session } group = Group::ours;  // `session`: away from our terminal as well
  int signal_at_our_end = 0;                                    // sent to it when the thread that started it ends
  long file_size = -1;  // bytes a file that it writes may have (RLIMIT_FSIZE); −1: no limit
};

/// Starts it; SIGINT, SIGTERM, SIGPIPE and SIGXFSZ have their default effect in it, also where we ignore them. Throws
/// RunError "cannot start PROGRAM: …" with the system's reason when it cannot be executed.
pid_t start(const Launch& launch);

struct Finished {
  int status = -1;  // exit status; −1 when it did not exit by itself
  int signal = 0;   // that ended it
};
/// True once the process has ended; does not wait.
bool has_ended(pid_t process, Finished& how);
/// Waits for its end.
Finished wait_for(pid_t process);

/// Both ends of a pipe, closed with it and in children that do not keep them.
struct Pipe {
  int ends[2] = {-1, -1};  // to read from, to write to
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  void close_end(int i);
  /// Appends what is there, waiting for something; false at its end.
  bool read_to(std::string& text);
};

/// A file opened for appending, made where it is not there; closed on leaving. Throws RunError.
struct LogFile {
  int descriptor = -1;
  explicit LogFile(const std::string& path);
  ~LogFile();
  LogFile(const LogFile&) = delete;
};

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

}  // namespace voussoir
