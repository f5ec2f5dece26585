#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "process.h"

namespace metamer::test {

using Json = nlohmann::json;

/// A metamerd of the test's own. It ends with its object, also when the test is killed.
class Daemon {
 public:
  enum class Listens { unix_socket, tcp };
  /// Renders on one thread where nothing else is said: the tests' time is then about the same on
  /// machines with many.
  explicit Daemon(Listens listens = Listens::unix_socket, std::vector<std::string> options = {});
  ~Daemon();

  const std::string& address() const { return address_; }  ///< For --server.
  const std::string& socket_path() const { return socket_path_; }
  std::uint16_t port() const { return port_; }
  pid_t pid() const { return process_->pid(); }
  void signal(int number) { process_->signal(number); }

  /// `metamer WORDS --server ADDRESS`.
  Ended metamer(std::vector<std::string> words) const;
  /// The same, left running.
  std::unique_ptr<Process> start(std::vector<std::string> words) const;
  /// `metamer WORDS --json --server ADDRESS`: its document; a failure where it has none.
  Json json(std::vector<std::string> words) const;

  /// Submits a scene; gives the job's number as words need it.
  std::string submit(const std::string& scene, std::vector<std::string> overrides = {}) const;
  pid_t worker_pid() const;        ///< The jobs' one, as `metamer info` tells it;
  pid_t views_worker_pid() const;  ///< that of the views.
  std::string job_state(const std::string& job) const;

 private:
  Folder folder_;
  std::string address_, socket_path_;
  std::uint16_t port_ = 0;
  int pair_end_ = -1;
  std::unique_ptr<Process> process_;
};

/// The workers of a daemon, stopped in their tracks: a job in the middle stays there however long
/// the commands that look at it take. The daemon's --worker-timeout has to be longer.
class HeldWorkers {
 public:
  explicit HeldWorkers(const Daemon& daemon);
  /// Processes that one of them has started.
  explicit HeldWorkers(std::vector<pid_t> pids);
  HeldWorkers(const HeldWorkers&) = delete;
  HeldWorkers& operator=(const HeldWorkers&) = delete;
  ~HeldWorkers() { release(); }
  void release();

 private:
  std::vector<pid_t> pids_;
};

/// One JSON document and nothing else; a failure where it is none.
Json parse_document(const std::string& text);

}  // namespace metamer::test
