#include "server/service/lifeline.h"

#include <string_view>
#include <utility>

namespace metamer::service {

namespace asio = boost::asio;

Lifeline::Lifeline(asio::any_io_executor executor, int fd, std::function<void()> cut)
    : stream_(std::move(executor), fd), cut_(std::move(cut)) {}

void Lifeline::ready() {
  constexpr std::string_view word = "ready\n";
  boost::system::error_code error;
  asio::write(stream_, asio::buffer(word), error);
  if (error) return cut_();
  wait();
}

void Lifeline::close() {
  boost::system::error_code ignored;
  stream_.close(ignored);
}

void Lifeline::wait() {
  stream_.async_read_some(asio::buffer(&received_, 1),
                          [this](boost::system::error_code error, std::size_t) {
                            if (error == asio::error::operation_aborted) return;
                            if (error) return cut_();
                            wait();
                          });
}

}  // namespace metamer::service
