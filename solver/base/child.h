// Child processes. They are started without a shell, so that their arguments are not interpreted.
#pragma once
#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace voussoir {

/// Options of a child process. Streams are descriptors of this process; −1 is /dev/null.
struct Launch {
  std::vector<std::string> words;  // the program, searched in PATH unless its name has a slash, and its arguments
  std::map<std::string, std::string> environment{};  // changes relative to this process; an empty value removes a
                                                     // variable
  std::string folder{};                              // working folder; "": that of this process
  int out = -1, err = -1;                            // standard input is empty
  int kept = -1;                                     // a further descriptor that it inherits under the same number
  enum class Group { ours, own, session } group = Group::ours;  // `session`: also detached from the terminal
  int signal_at_our_end = 0;                                    // signal sent to it when the thread that started it
                                                                // ends
  long file_size = -1;  // largest size of a file that it writes, bytes (RLIMIT_FSIZE); −1: no limit
};

/// Starts the child. SIGINT, SIGTERM, SIGPIPE and SIGXFSZ have their default effect in it, even if this process ignores
/// them. Throws RunError "cannot start PROGRAM: …" with the reason of the system if it cannot be executed.
pid_t start(const Launch& launch);

struct Finished {
  int status = -1;  // exit status; −1 if a signal ended it
  int signal = 0;   // the signal that ended it, or 0
};
/// Whether the process has ended; does not wait.
bool has_ended(pid_t process, Finished& how);
/// Waits for its end.
Finished wait_for(pid_t process);

/// Both ends of a pipe. They are closed by the destructor and in children that do not keep them.
struct Pipe {
  int ends[2] = {-1, -1};  // to read from, to write to
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  void close_end(int i);
  /// Waits for data and appends them; false at the end of the stream.
  bool read_to(std::string& text);
};

/// A file opened for appending, created if it does not exist and closed by the destructor. Throws RunError.
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
/// Runs a program to its end and reads its output. Throws RunError if it cannot be started.
Answer ask(const std::vector<std::string>& words);

bool in_path(const std::string& program);
/// Absolute path of the executable file of this program. Throws RunError if it cannot be determined.
std::string own_program();
void pause_milliseconds(int milliseconds);

}  // namespace voussoir
