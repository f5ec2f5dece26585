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
  struct Shape {
    int nodes = 2;
    int cpus = 1;  ///< Of each.
    /// The last node is in namespaces of its own: see cut_off() and fill_disk().
    bool apart = false;
    bool gpu = false;  ///< Each node says that it has one, which is /dev/null.
  };
  /// Why there can be none here; empty: there can.
  static std::string lacks();
  /// The same, of one with a node that is apart.
  static std::string lacks_apart();

  explicit Cluster(const Shape& shape);
  Cluster() : Cluster(Shape{}) {}
  ~Cluster();
  Cluster(const Cluster&) = delete;

  /// Ends the controller as a power cut would, and has another take over what it has saved.
  void kill_controller();
  void start_controller();
  /// Ends a node, "n1", with what runs there.
  void power_off(const std::string& node);
  void start_node(const std::string& node);

  /// Takes the link of the node that is apart down, and up again. What runs there runs on, and the
  /// folder that all see is seen.
  void cut_off() const { set_link("down"); }
  void reconnect() const { set_link("up"); }
  /// Lets nothing more be written into the shared folder by the node that is apart, and leaves what
  /// others write. Before it has begun to run anything.
  void fill_disk() const;
  void make_room() const;

  /// What an administrator does for nodes that Slurm has drained: a controller that gives a number
  /// out again which a node still runs takes the node for broken ("Duplicate jobid").
  void resume_nodes() const;

  /// The words for a metamerd whose jobs it renders, with what it keeps in `folder()`.
  std::vector<std::string> words(const std::string& task_time) const;
  const Folder& folder() const { return folder_; }
  /// The workers' processes that tasks have at this moment.
  std::vector<pid_t> workers() const;
  /// What drives them there, on one node.
  std::vector<pid_t> tasks_on(const std::string& node) const;
  /// How many tasks Slurm has been given since its start.
  int tasks_submitted() const;
  /// Until as many nodes may be given tasks.
  void wait_until_idle(int nodes) const;

 private:
  std::string in_configuration() const;
  void set_apart();
  void set_link(const std::string& state) const;
  void do_apart(const std::vector<std::string>& words) const;

  Folder folder_;
  Shape shape_;
  std::string address_ = "127.0.0.1", address_apart_;
  std::unique_ptr<Process> namespaces_;  // of the node that is apart: they are there while it runs
  std::unique_ptr<Process> munged_, controller_;
  std::map<std::string, std::unique_ptr<Process>> nodes_;
};

}  // namespace metamer::test
