#pragma once

#include <boost/asio.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/endpoint.h"

namespace metamer::wire {

/// What the other end has shown to be, by a certificate that was verified.
struct PeerCertificate {
  std::string fingerprint;         ///< SHA-256 of the certificate: 64 hexadecimal digits.
  std::vector<std::string> names;  ///< Its common name, then its subject's other names.
};

/// Bytes in both directions, plain or encrypted. Everything on one thread; one who reads and one
/// who writes at a time. Nothing is kept for a stream that is silent: who reads brings the memory
/// once something has come.
class Stream {
 public:
  using Taken = std::pair<boost::system::error_code, std::size_t>;

  virtual ~Stream() = default;
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Takes at most `size` bytes of what has come, without waiting: how many. Errors: would_block
  /// (nothing has come), eof, the system's, those of TLS.
  virtual Taken read(char* data, std::size_t size) = 0;
  /// Gives away what there is room for, without waiting: how many bytes. Errors: would_block (no
  /// room; the next write has to begin with the same bytes), the system's, those of TLS.
  virtual Taken write(const char* data, std::size_t size) = 0;
  /// Wait until a read, or a write, that would block has something to do. Errors: the system's.
  virtual asio::awaitable<boost::system::error_code> wait_to_read() = 0;
  virtual asio::awaitable<boost::system::error_code> wait_to_write() = 0;

  /// Says that nothing more will be sent.
  virtual void shutdown_send() = 0;
  /// No more receiving; what has arrived can still be read.
  virtual void shutdown_receive() = 0;
  /// Ends every pending operation.
  virtual void close() = 0;
  virtual bool is_open() const = 0;
  virtual asio::any_io_executor executor() = 0;
  /// Of the other end; null: it has shown none.
  virtual const PeerCertificate* certificate() const { return nullptr; }
};

/// A socket as it is.
std::unique_ptr<Stream> plain_stream(Socket socket);

}  // namespace metamer::wire
