#include "tests/slurm/cluster.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <pwd.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <random>
#include <thread>

namespace voussoir::test {

namespace {

/// Daemons are not in everybody's PATH.
std::string path_of(const std::string& program) {
  for (const char* folder : {"/usr/sbin/", "/usr/bin/", "/usr/local/sbin/", "/usr/local/bin/", "/sbin/"})
    if (::access((folder + program).c_str(), X_OK) == 0) return folder + program;
  return "";
}

/// A port that nobody listens on now.
int free_port() {
  const int s = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ::bind(s, reinterpret_cast<sockaddr*>(&address), size);
  ::getsockname(s, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(s);
  return ntohs(address.sin_port);
}

std::string short_host_name() {
  char name[256] = {};
  ::gethostname(name, sizeof name - 1);
  const std::string host = name;
  return host.substr(0, host.find('.'));
}

std::string user_name() {
  const passwd* user = ::getpwuid(::geteuid());
  return user ? user->pw_name : "root";
}

/// No cgroups, no accounting: what a container offers is enough.
std::string configuration(const std::string& folder) {
  const std::string host = short_host_name();
  return fmt::format(R"(ClusterName=test
SlurmctldHost={0}(127.0.0.1)
SlurmctldPort={1}
SlurmdPort={2}
AuthType=auth/munge
AuthInfo=socket={3}/munge.socket
CredType=cred/munge
SlurmUser={4}
SlurmdUser={4}
StateSaveLocation={3}/state
SlurmdSpoolDir={3}/spool
SlurmctldPidFile={3}/slurmctld.pid
SlurmdPidFile={3}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1,sched_min_interval=0
MinJobAge=10
KillWait=5
NodeName={0} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=test Nodes={0} Default=YES MaxTime=INFINITE State=UP
)",
                     host, free_port(), free_port(), folder, user_name());
}

void write_key(const std::string& file) {
  std::random_device random;
  std::string key;
  for (int i = 0; i < 256; ++i) key += char(random() & 0xff);
  set_bytes(file, key);
  ::chmod(file.c_str(), 0400);
}

}  // namespace

Daemon::Daemon(const std::vector<std::string>& words, const std::string& log, const std::string& conf) {
  const LogFile output(log);
  process_ = start({.words = words,
                    .environment = {{"SLURM_CONF", conf}},
                    .out = output.descriptor,
                    .err = output.descriptor,
                    .group = Launch::Group::own,
                    .signal_at_our_end = SIGKILL});
}

bool Daemon::running() {
  if (Finished how; process_ > 0 && has_ended(process_, how)) process_ = -1;
  return process_ > 0;
}

Daemon::~Daemon() {
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  for (int i = 0; i < 250 && running(); ++i) pause_milliseconds(20);
  if (!running()) return;
  ::kill(process_, SIGKILL);
  wait_for(process_);
}

std::string Cluster::missing() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo"})
    if (path_of(program).empty()) return program;
  return "";
}

Cluster::Cluster() {
  const std::string f = folder_.path(), conf = f + "/slurm.conf";
  ::chmod(f.c_str(), 0755);
  for (const char* name : {"/munge", "/state", "/spool"}) ::mkdir((f + name).c_str(), 0700);
  write_key(f + "/munge/key");
  set_bytes(conf, configuration(f));
  const auto begin = [&](const std::vector<std::string>& words, const std::string& log) {
    daemons_.push_back(std::make_unique<Daemon>(words, f + "/" + log, conf));
  };
  begin({path_of("munged"), "--foreground", "--force", "--key-file=" + f + "/munge/key",
         "--socket=" + f + "/munge.socket", "--pid-file=" + f + "/munge/pid", "--log-file=" + f + "/munge/log",
         "--seed-file=" + f + "/munge/seed"},
        "munged.log");
  for (int i = 0; i < 500 && !exists(f + "/munge.socket"); ++i) ::usleep(20000);
  begin({path_of("slurmctld"), "-D", "-f", conf}, "slurmctld.log");
  begin({path_of("slurmd"), "-D", "-f", conf}, "slurmd.log");
}

/// The node first: what still runs there belongs to this test.
Cluster::~Cluster() {
  while (!daemons_.empty()) daemons_.pop_back();
}

std::string Cluster::logs() const {
  std::string text;
  for (const char* name : {"munged.log", "slurmctld.log", "slurmd.log"}) {
    const std::string log = bytes_of(folder_ / name);
    text += fmt::format("\n--- {}\n{}", name, log.substr(log.size() - std::min<std::size_t>(log.size(), 2000)));
  }
  return text;
}

std::string Cluster::trouble() {
  const std::string state = folder_ / "sinfo.txt";
  for (int i = 0; i < 150; ++i) {
    for (const auto& daemon : daemons_)
      if (!daemon->running()) return "one of munged, slurmctld and slurmd has ended" + logs();
    ::unlink(state.c_str());
    Daemon sinfo({path_of("sinfo"), "--noheader", "--format=%t"}, state, folder_ / "slurm.conf");
    while (sinfo.running()) ::usleep(10000);
    if (bytes_of(state).starts_with("idle")) return "";
    ::usleep(200000);
  }
  return "the node did not come up within 30 s" + logs();
}

std::map<std::string, std::string> Cluster::environment() const {
  const char* path = std::getenv("PATH");
  return {{"SLURM_CONF", folder_ / "slurm.conf"}, {"PATH", fmt::format("{}:/usr/bin:/usr/sbin", path ? path : "")}};
}

}  // namespace voussoir::test
