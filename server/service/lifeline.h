#pragma once

#include <boost/asio.hpp>
#include <functional>

namespace metamer::service {

/// A private daemon's tie to the client that started it: one end of a socket pair or a pipe. It
/// says `ready` there once it listens, and ends when the other end closes, however the client died.
class Lifeline {
 public:
  /// Takes the descriptor over. `cut` is called once, when the other end is closed.
  Lifeline(boost::asio::any_io_executor executor, int fd, std::function<void()> cut);

  /// Writes `ready` and a line end, and begins to wait.
  void ready();
  void close();

 private:
  void wait();

  boost::asio::posix::stream_descriptor stream_;
  std::function<void()> cut_;
  char received_ = 0;
};

}  // namespace metamer::service
