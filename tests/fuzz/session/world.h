#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "facts.h"
#include "peer.h"
#include "server/service/service.h"

namespace metamer::fuzz {

/// A daemon in this thread, its clients, and time that passes only when it is told to.
class World {
 public:
  struct Options {
    bool keeps_state = false;  ///< With users who have tokens.
    bool small_limits = false;
  };
  World(Options options, Facts& facts);
  /// Ends it; broken where something of a client is left.
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  static constexpr std::size_t most_peers = 12;
  /// By the Unix socket (0), or from one of three addresses. Null: there are enough.
  Peer* open(std::size_t from);
  std::vector<std::unique_ptr<Peer>>& peers() { return peers_; }

  /// Runs what can run, and lets clients read as much as they like.
  void settle();
  void pass(std::chrono::milliseconds time);
  service::Service& service() { return *service_; }
  /// The daemon ends in peace.
  void drain();
  /// What all sessions together take is bounded.
  void check_memory() const;

 private:
  void poll();
  void finish_questions();
  void cancel_jobs(Peer& owner);
  void check_no_client_left();
  v1::Envelope ask_owner(Peer& owner, const v1::Envelope& request);
  std::uint64_t bytes_of_files() const;

  Options options_;
  Facts& facts_;
  std::filesystem::path folder_;
  std::size_t allocated_before_;
  boost::asio::io_context loop_;
  std::unique_ptr<service::Service> service_;
  std::uint16_t port_ = 0;
  std::vector<std::unique_ptr<Peer>> peers_;
  bool drained_ = false;
};

}  // namespace metamer::fuzz
