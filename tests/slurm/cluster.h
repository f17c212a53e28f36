// A Slurm cluster of one node, this machine, for as long as the object lives.
#pragma once
#include <sys/types.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/whole/program.h"

namespace voussoir::test {

/// A process in the background; ended with the object, and killed when the test is.
class Daemon {
 public:
  Daemon(const std::vector<std::string>& words, const std::string& log, const std::string& conf);
  ~Daemon();
  Daemon(const Daemon&) = delete;
  bool running();

 private:
  pid_t process_ = -1;
};

class Cluster {
 public:
  /// Starts munged, slurmctld and slurmd on free ports, with all their files in a temporary folder.
  Cluster();
  ~Cluster();
  /// Empty where all programs are there, else which is missing.
  static std::string missing();
  /// Empty once the node waits for work, else why not.
  std::string trouble();
  /// Environment that leads Slurm's programs to this cluster.
  std::map<std::string, std::string> environment() const;

 private:
  std::string logs() const;

  Folder folder_;
  std::vector<std::unique_ptr<Daemon>> daemons_;
};

}  // namespace voussoir::test
