#include "cluster.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace metamer::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using std::chrono::steady_clock;

std::string find_program(const std::string& name) {
  for (const char* folder : {"/usr/sbin", "/usr/bin", "/usr/local/sbin", "/usr/local/bin"})
    if (fs::exists(fs::path(folder) / name)) return fs::path(folder) / name;
  return {};
}

/// Ports of the loopback that nobody listens on just now.
std::vector<int> free_ports(std::size_t count) {
  std::vector<int> ports, sockets;
  for (std::size_t i = 0; i < count; ++i) {
    const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(probe, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
    ports.push_back(ntohs(address.sin_port));
    sockets.push_back(probe);
  }
  for (const int probe : sockets) ::close(probe);
  return ports;
}

std::string word_of(pid_t pid, const std::string& file) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All processes whose environment or words have this text.
std::vector<pid_t> processes_with(const std::string& file, const std::string& text) {
  std::vector<pid_t> found;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const pid_t pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0 && pid != ::getpid() && word_of(pid, file).find(text) != std::string::npos)
      found.push_back(pid);
  }
  return found;
}

}  // namespace

std::string Cluster::lacks() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel"})
    if (find_program(program).empty())
      return std::string(program) +
             " is not installed: apt-get install slurmctld slurmd slurm-client munge";
  return ::geteuid() == 0 ? "" : "slurmd wants to be root";
}

Cluster::Cluster(int nodes, int cpus_per_node) {
  std::ofstream(folder_ / "slurm.conf") << in_configuration(nodes, cpus_per_node);
  for (const std::string name : {"state", "shared"}) fs::create_directory(folder_ / name);
  ::setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);

  const std::string key = folder_.write("munge.key", std::string(1024, 'k'));
  fs::permissions(key, fs::perms::owner_read | fs::perms::owner_write);
  munged_ = std::make_unique<Process>(std::vector<std::string>{
      find_program("munged"), "--foreground", "--force", "--key-file=" + key,
      "--socket=" + (folder_ / "munge"), "--pid-file=" + (folder_ / "munged.pid"),
      "--log-file=" + (folder_ / "munged.log"), "--seed-file=" + (folder_ / "munged.seed")});
  const auto end = steady_clock::now() + seconds(30);
  while (!fs::exists(folder_ / "munge") && steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  start_controller();
  for (int i = 1; i <= nodes; ++i) start_node("n" + std::to_string(i));
  wait_until_idle(nodes);
}

Cluster::~Cluster() {
  std::vector<std::string> names;
  for (const auto& [name, node] : nodes_) names.push_back(name);
  for (const std::string& name : names) power_off(name);
  controller_.reset();
  munged_.reset();
  ::unsetenv("SLURM_CONF");
}

std::string Cluster::in_configuration(int nodes, int cpus) const {
  const std::vector<int> ports = free_ports(static_cast<std::size_t>(nodes) + 1);
  const std::string folder = folder_.path();
  std::string text = R"(ClusterName=metamer
SlurmctldHost=localhost(127.0.0.1)
AuthType=auth/munge
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmctldTimeout=10
SlurmdTimeout=10
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
KillWait=2
SlurmctldDebug=error
SlurmdDebug=error
)";
  text += "AuthInfo=socket=" + folder + "/munge\n";
  text += "StateSaveLocation=" + folder + "/state\n";
  text += "SlurmdSpoolDir=" + folder + "/spool-%n\n";
  text += "SlurmctldPidFile=" + folder + "/slurmctld.pid\n";
  text += "SlurmdPidFile=" + folder + "/slurmd-%n.pid\n";
  text += "SlurmctldLogFile=" + folder + "/slurmctld.log\n";
  text += "SlurmdLogFile=" + folder + "/slurmd-%n.log\n";
  text += "SlurmctldPort=" + std::to_string(ports[0]) + "\n";
  for (int i = 1; i <= nodes; ++i)
    text += "NodeName=n" + std::to_string(i) + " NodeHostname=localhost NodeAddr=127.0.0.1 Port=" +
            std::to_string(ports[static_cast<std::size_t>(i)]) + " CPUs=" + std::to_string(cpus) +
            "\n";
  return text + "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n";
}

void Cluster::wait_until_idle(int nodes) const {
  const auto end = steady_clock::now() + seconds(60);
  while (steady_clock::now() < end) {
    const Ended said = run({find_program("sinfo"), "-h", "-N", "-t", "idle", "-o", "%n"});
    if (std::count(said.out.begin(), said.out.end(), '\n') == nodes) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ADD_FAILURE() << "the nodes do not come up";
}

void Cluster::kill_controller() {
  controller_->signal(SIGKILL);
  controller_->wait();
}

void Cluster::start_controller() {
  controller_ =
      std::make_unique<Process>(std::vector<std::string>{find_program("slurmctld"), "-D"});
}

void Cluster::resume_nodes() const {
  (void)run({find_program("scontrol"), "update", "nodename=ALL", "state=resume"});
}

void Cluster::start_node(const std::string& node) {
  fs::create_directories(folder_ / ("spool-" + node));
  nodes_[node] =
      std::make_unique<Process>(std::vector<std::string>{find_program("slurmd"), "-D", "-N", node});
}

/// slurmd, its slurmstepds, whose words name the node, and all that has the node in its
/// environment.
void Cluster::power_off(const std::string& node) {
  nodes_.at(node)->signal(SIGKILL);
  nodes_.at(node)->wait();
  nodes_.erase(node);
  const std::string conf = "SLURM_CONF=" + (folder_ / "slurm.conf");
  for (const pid_t pid : processes_with("environ", conf)) {
    const std::string environment = word_of(pid, "environ");
    const std::string words = word_of(pid, "cmdline");
    const bool of_node = environment.find("SLURMD_NODENAME=" + node) != std::string::npos ||
                         words.find("slurmstepd: [") != std::string::npos;
    if (of_node) ::kill(pid, SIGKILL);
  }
}

std::vector<std::string> Cluster::words(const std::string& task_time) const {
  return {"--executor",        "slurm",
          "--slurm-folder",    folder_ / "shared",
          "--state",           folder_ / "metamer",
          "--slurm-task-time", task_time,
          "--slurm-patience",  "3"};
}

std::vector<pid_t> Cluster::workers() const {
  std::vector<pid_t> found;
  for (const pid_t pid : processes_with("cmdline", "--store"))
    if (word_of(pid, "cmdline").find(folder_ / "shared") != std::string::npos &&
        word_of(pid, "environ").find("SLURM_JOB_ID=") != std::string::npos)
      found.push_back(pid);
  return found;
}

}  // namespace metamer::test
