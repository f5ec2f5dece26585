#pragma once

#include <sys/types.h>

#include <boost/asio/awaitable.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "client/session/error.h"

namespace metamer::client {

/// A metamerd of our own, on a Unix socket that nobody else knows. It goes when this object goes,
/// and when this process ends, however that happens: it reads the end of file of a descriptor
/// that only we hold open.
class PrivateServer {
 public:
  /// Starts the metamerd beside this program, else the one in PATH, and waits until it listens.
  /// Error: it can't be started, ended, or said nothing for `start_time_limit`; with its last
  /// words. `nice` is added to its niceness: a window beside it comes first.
  static boost::asio::awaitable<Answer<PrivateServer>> start(int nice = 0);

  PrivateServer(PrivateServer&& other) noexcept;
  PrivateServer& operator=(PrivateServer&&) = delete;
  /// Ends the daemon and waits for it; kills it when it has not gone in `stop_time_limit`.
  ~PrivateServer();

  /// Where to connect. Valid until connected() was called.
  std::filesystem::path socket() const { return folder_ / "socket"; }
  /// Say that the connection stands: removes the socket's folder, so that nothing is left behind
  /// even if this process is killed.
  void connected();
  /// How it ended and its last words: "the private metamerd ended by signal 9: …". Empty: it runs,
  /// 0.2 s on still.
  std::string how_it_ended();

  static constexpr std::chrono::seconds start_time_limit{20};
  static constexpr std::chrono::seconds stop_time_limit{5};

 private:
  PrivateServer() = default;
  std::string last_words();

  pid_t pid_ = -1;
  int pair_end_ = -1;  ///< Ours, of the socket pair by which the daemon notices our end.
  std::filesystem::path folder_;
  std::ifstream log_;  ///< Open once the folder is gone.
};

}  // namespace metamer::client
