#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/process.h"

namespace metamer::test {

/// A Slurm of the test's own on the loopback: munged, slurmctld and slurmd, without systemd and
/// control groups. SLURM_CONF leads to it while it lives.
class Cluster {
 public:
  /// Why there can be none here; empty: there can.
  static std::string lacks();

  explicit Cluster(int nodes = 2, int cpus_per_node = 1);
  ~Cluster();
  Cluster(const Cluster&) = delete;

  /// Ends the controller as a power cut would, and has another take over what it has saved.
  void kill_controller();
  void start_controller();
  /// Ends a node, "n1", with what runs there.
  void power_off(const std::string& node);
  void start_node(const std::string& node);

  /// What an administrator does for nodes that Slurm has drained: a controller that gives a number
  /// out again which a node still runs takes the node for broken ("Duplicate jobid").
  void resume_nodes() const;

  /// The words for a metamerd whose jobs it renders, with what it keeps in `folder()`.
  std::vector<std::string> words(const std::string& task_time) const;
  const Folder& folder() const { return folder_; }
  /// The workers' processes that tasks have at this moment.
  std::vector<pid_t> workers() const;

 private:
  std::string in_configuration(int nodes, int cpus) const;
  void wait_until_idle(int nodes) const;

  Folder folder_;
  std::unique_ptr<Process> munged_, controller_;
  std::map<std::string, std::unique_ptr<Process>> nodes_;
};

}  // namespace metamer::test
