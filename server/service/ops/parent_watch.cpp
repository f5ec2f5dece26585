#include "server/service/ops/parent_watch.h"

#include <string_view>
#include <utility>

namespace metamer::service {

namespace asio = boost::asio;

ParentWatch::ParentWatch(const asio::any_io_executor& executor, int fd, std::function<void()> gone)
    : stream_(executor, fd), gone_(std::move(gone)) {}

void ParentWatch::ready() {
  constexpr std::string_view word = "ready\n";
  boost::system::error_code error;
  asio::write(stream_, asio::buffer(word), error);
  if (error) return gone_();
  wait();
}

void ParentWatch::close() {
  boost::system::error_code ignored;
  stream_.close(ignored);
}

void ParentWatch::wait() {
  stream_.async_read_some(asio::buffer(&received_, 1),
                          [this](boost::system::error_code error, std::size_t) {
                            if (error == asio::error::operation_aborted) return;
                            if (error) return gone_();
                            wait();
                          });
}

}  // namespace metamer::service
