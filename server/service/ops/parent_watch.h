#pragma once

#include <boost/asio.hpp>
#include <functional>

namespace metamer::service {

/// Watches the client that started a private daemon, by one end of a socket pair or a pipe. Says
/// `ready` there once the daemon listens, and notices that the other end closes, however the client
/// ended.
class ParentWatch {
 public:
  /// Takes the descriptor over. `gone` is called once, when the other end is closed.
  ParentWatch(const boost::asio::any_io_executor& executor, int fd, std::function<void()> gone);

  /// Writes `ready` and a line end, and begins to wait.
  void ready();
  void close();

 private:
  void wait();

  boost::asio::posix::stream_descriptor stream_;
  std::function<void()> gone_;
  char received_ = 0;
};

}  // namespace metamer::service
