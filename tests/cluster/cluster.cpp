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
#include <sstream>
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
  std::ostringstream text;
  text << in.rdbuf();  // which throws nothing where the process ends meanwhile
  return text.str();
}

pid_t parent_of(pid_t pid) {
  const std::string status = word_of(pid, "status");
  const auto at = status.find("PPid:");
  return at == std::string::npos ? 0 : std::atoi(status.c_str() + at + 5);
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

std::string Cluster::lacks_apart() {
  if (auto lacks = Cluster::lacks(); !lacks.empty()) return lacks;
  if (find_program("ip").empty()) return "ip is not installed: apt-get install iproute2";
  const Ended tried = run({"/usr/bin/unshare", "--net", "--mount", "/bin/true"});
  return tried.code == 0 ? "" : "no namespaces here: " + tried.err;
}

Cluster::Cluster(const Shape& shape) : shape_(shape) {
  for (const std::string name : {"state", "shared"}) fs::create_directory(folder_ / name);
  if (shape_.apart) set_apart();
  std::ofstream(folder_ / "slurm.conf") << in_configuration();
  if (shape_.gpu) std::ofstream(folder_ / "gres.conf") << "Name=gpu File=/dev/null\n";
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
  for (int i = 1; i <= shape_.nodes; ++i) start_node("n" + std::to_string(i));
  wait_until_idle(shape_.nodes);
}

Cluster::~Cluster() {
  std::vector<std::string> names;
  for (const auto& [name, node] : nodes_) names.push_back(name);
  for (const std::string& name : names) power_off(name);
  controller_.reset();
  munged_.reset();
  ::unsetenv("SLURM_CONF");
}

/// Namespaces with a link to this machine, which are there as long as a process that does nothing.
void Cluster::set_apart() {
  // Addresses of four each, by the process's number: tests beside this one have others.
  const int place = ::getpid() % 16384 * 4;
  const std::string net = "10.213." + std::to_string(place / 256) + ".";
  address_ = net + std::to_string(place % 256 + 1);
  address_apart_ = net + std::to_string(place % 256 + 2);
  namespaces_ = std::make_unique<Process>(std::vector<std::string>{
      "/usr/bin/unshare", "--net", "--mount", "/bin/sh", "-c", "echo ready; exec sleep infinity"});
  if (!namespaces_->line_out("ready")) ADD_FAILURE() << "no namespaces";
  const std::string ip = find_program("ip"), link = "mt" + std::to_string(::getpid());
  for (const Ended& ended : {run({ip, "link", "add", link, "type", "veth", "peer", "name", "eth0",
                                  "netns", std::to_string(namespaces_->pid())}),
                             run({ip, "address", "add", address_ + "/30", "dev", link}),
                             run({ip, "link", "set", link, "up"})})
    EXPECT_EQ(ended.code, 0) << ended.err;
  do_apart({ip, "address", "add", address_apart_ + "/30", "dev", "eth0"});
  do_apart({ip, "link", "set", "lo", "up"});
  set_link("up");
}

void Cluster::do_apart(const std::vector<std::string>& words) const {
  std::vector<std::string> all = {"/usr/bin/nsenter", "--target",
                                  std::to_string(namespaces_->pid()), "--net", "--mount"};
  all.insert(all.end(), words.begin(), words.end());
  const Ended ended = run(all);
  EXPECT_EQ(ended.code, 0) << ended.err;
}

void Cluster::set_link(const std::string& state) const {
  do_apart({find_program("ip"), "link", "set", "eth0", state});
}

/// What is written there goes to a file system of a few pages, laid over what all see.
void Cluster::fill_disk() const {
  const std::string small = folder_ / "small";
  fs::create_directory(small);
  do_apart({"/bin/sh", "-c",
            "mount -t tmpfs -o size=4k tmpfs " + small + " && mkdir " + small + "/upper " + small +
                "/work && mount -t overlay overlay -o lowerdir=" + (folder_ / "shared") +
                ",upperdir=" + small + "/upper,workdir=" + small + "/work " +
                (folder_ / "shared")});
}

void Cluster::make_room() const { do_apart({"/bin/umount", "--lazy", folder_ / "shared"}); }

std::string Cluster::in_configuration() const {
  const int nodes = shape_.nodes;
  const std::vector<int> ports = free_ports(static_cast<std::size_t>(nodes) + 1);
  const std::string folder = folder_.path();
  std::string text = R"(ClusterName=metamer
AuthType=auth/munge
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
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
  // With these it listens at what the machine's name stands for, which another network does not
  // see.
  if (!shape_.apart) text += "CommunicationParameters=NoCtldInAddrAny,NoInAddrAny\n";
  text += "SlurmctldHost=localhost(" + address_ + ")\n";
  if (shape_.gpu) text += "GresTypes=gpu\n";
  text += "AuthInfo=socket=" + folder + "/munge\n";
  text += "StateSaveLocation=" + folder + "/state\n";
  text += "SlurmdSpoolDir=" + folder + "/spool-%n\n";
  text += "SlurmctldPidFile=" + folder + "/slurmctld.pid\n";
  text += "SlurmdPidFile=" + folder + "/slurmd-%n.pid\n";
  text += "SlurmctldLogFile=" + folder + "/slurmctld.log\n";
  text += "SlurmdLogFile=" + folder + "/slurmd-%n.log\n";
  text += "SlurmctldPort=" + std::to_string(ports[0]) + "\n";
  for (int i = 1; i <= nodes; ++i)
    text += "NodeName=n" + std::to_string(i) + " NodeHostname=localhost NodeAddr=" +
            (shape_.apart && i == nodes ? address_apart_ : address_) +
            " Port=" + std::to_string(ports[static_cast<std::size_t>(i)]) +
            " CPUs=" + std::to_string(shape_.cpus) + (shape_.gpu ? " Gres=gpu:1" : "") + "\n";
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
  std::vector<std::string> words;
  if (shape_.apart && node == "n" + std::to_string(shape_.nodes))
    words = {"/usr/bin/nsenter", "--target", std::to_string(namespaces_->pid()), "--net",
             "--mount"};
  words.insert(words.end(), {find_program("slurmd"), "-D", "-N", node});
  nodes_[node] = std::make_unique<Process>(words);
}

/// slurmd, all that has the node in its environment, and the slurmstepds that started that, whose
/// own words do not name the node.
void Cluster::power_off(const std::string& node) {
  nodes_.at(node)->signal(SIGKILL);
  nodes_.at(node)->wait();
  nodes_.erase(node);
  for (const pid_t pid : processes_with("environ", "SLURM_CONF=" + (folder_ / "slurm.conf"))) {
    if (word_of(pid, "environ").find("SLURMD_NODENAME=" + node) == std::string::npos) continue;
    const pid_t parent = parent_of(pid);
    if (word_of(parent, "cmdline").find("slurmstepd: [") != std::string::npos)
      ::kill(parent, SIGKILL);
    ::kill(pid, SIGKILL);
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

std::vector<pid_t> Cluster::tasks_on(const std::string& node) const {
  std::vector<pid_t> found;
  for (const pid_t pid : processes_with("cmdline", "--batch"))
    if (word_of(pid, "cmdline").find(folder_ / "shared") != std::string::npos &&
        word_of(pid, "environ").find("SLURMD_NODENAME=" + node) != std::string::npos)
      found.push_back(pid);
  return found;
}

int Cluster::tasks_submitted() const {
  // Each task of an array has a number of its own once it has been looked at.
  const Ended said = run({find_program("scontrol"), "show", "config"});
  const auto at = said.out.find("NEXT_JOB_ID");
  if (at == std::string::npos) return 0;
  return std::atoi(said.out.c_str() + said.out.find('=', at) + 1) - 1;
}

}  // namespace metamer::test
