#include "common/wire/stream.h"

#include <sys/socket.h>

#include <cerrno>

namespace metamer::wire {

namespace {

using boost::system::error_code;

class PlainStream final : public Stream {
 public:
  explicit PlainStream(Socket socket) : socket_(std::move(socket)) {}

  Taken read(char* data, std::size_t size) override {
    const auto got = ::recv(socket_.native_handle(), data, size, MSG_DONTWAIT);
    if (got == 0) return {asio::error::eof, 0};
    return taken(got);
  }

  Taken write(const char* data, std::size_t size) override {
    return taken(::send(socket_.native_handle(), data, size, MSG_DONTWAIT | MSG_NOSIGNAL));
  }

  asio::awaitable<error_code> wait_to_read() override { return wait(asio::socket_base::wait_read); }
  asio::awaitable<error_code> wait_to_write() override {
    return wait(asio::socket_base::wait_write);
  }

  void shutdown_send() override { shutdown(asio::socket_base::shutdown_send); }
  void shutdown_receive() override { shutdown(asio::socket_base::shutdown_receive); }
  void close() override {
    error_code ignored;
    socket_.close(ignored);
  }
  bool is_open() const override { return socket_.is_open(); }
  asio::any_io_executor executor() override { return socket_.get_executor(); }

 private:
  static Taken taken(ssize_t bytes) {
    if (bytes >= 0) return {error_code(), static_cast<std::size_t>(bytes)};
    // Nothing was done: who waits will find it possible.
    if (errno == EINTR || errno == EAGAIN) return {asio::error::would_block, 0};
    return {error_code(errno, boost::system::system_category()), 0};
  }

  asio::awaitable<error_code> wait(asio::socket_base::wait_type what) {
    const auto [error] = co_await socket_.async_wait(what, asio::as_tuple(asio::use_awaitable));
    co_return error;
  }

  void shutdown(asio::socket_base::shutdown_type what) {
    error_code ignored;
    socket_.shutdown(what, ignored);
  }

  Socket socket_;
};

}  // namespace

std::unique_ptr<Stream> plain_stream(Socket socket) {
  return std::make_unique<PlainStream>(std::move(socket));
}

}  // namespace metamer::wire
