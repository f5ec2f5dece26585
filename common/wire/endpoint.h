#pragma once

#include <sys/types.h>

#include <boost/asio.hpp>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "common/problem.h"

/// Where a server listens, and how to get there.
namespace metamer::wire {

namespace asio = boost::asio;

/// One type for Unix and TCP sockets alike.
using Socket = asio::generic::stream_protocol::socket;

struct Endpoint {
  enum class Kind { unix_socket, tcp };
  Kind kind = Kind::tcp;
  std::string path;        ///< Of a Unix socket; at most 107 bytes, the kernel's bound.
  std::string host;        ///< Name or address; a bare port means 127.0.0.1.
  std::uint16_t port = 0;  ///< 0: the kernel chooses one, for listeners only.
  bool tls = false;        ///< What is said is encrypted: TCP with TLS.

  bool operator==(const Endpoint&) const = default;
};

/// Reads `unix:PATH`, `HOST:PORT`, `[IPV6]:PORT` or `PORT`; `tls:` before one of the last three is
/// TCP with TLS. The error says what was expected.
Result<Endpoint> parse_endpoint(std::string_view text);
/// As parse_endpoint reads it.
std::string to_string(const Endpoint& endpoint);

/// Longer than a network takes that works, shorter than a person waits: the system itself tries for
/// two minutes.
inline constexpr std::chrono::seconds connect_timeout{10};

/// Connects, name look-up included: each of a name's addresses in turn, for `limit` in all. The
/// error names the endpoint: the system's reason, the time-out, or "Operation canceled" where the
/// coroutine was cancelled (by asio's cancellation slot). A look-up that is given up still holds
/// its thread until the resolver has answered.
asio::awaitable<Result<Socket>> connect(
    Endpoint endpoint, std::chrono::steady_clock::duration limit = connect_timeout);

/// After which a TCP peer is taken for gone that takes nothing of what was sent to it; twice as
/// long for one to which nothing was.
inline constexpr std::chrono::seconds dead_peer_limit{30};

/// Who may connect to a Unix socket: the system asks for the right to write its file.
struct SocketFile {
  mode_t mode = 0600;
  std::string group;  ///< Its name; empty: that of the process.
};

/// An open listening socket. A Unix socket's file is removed with it.
class Acceptor {
 public:
  /// Binds and listens. A Unix socket file that nobody listens on any more is replaced. Errors: an
  /// address in use, a file that is no socket, a group that does not exist, whatever else the
  /// system says.
  static Result<Acceptor> listen(const asio::any_io_executor& executor, const Endpoint& endpoint,
                                 const SocketFile& file = {},
                                 std::chrono::seconds dead_peer = dead_peer_limit);

  Acceptor(Acceptor&&) noexcept = default;
  Acceptor& operator=(Acceptor&&) = delete;
  ~Acceptor();

  /// The endpoint, with the port that the kernel chose.
  const Endpoint& endpoint() const { return endpoint_; }
  /// Only this machine can connect: a Unix socket, or an address of the loopback.
  bool is_local() const;
  /// The next connection; a TCP peer that is gone is noticed (dead_peer).
  /// Errors: the system's.
  asio::awaitable<std::pair<boost::system::error_code, Socket>> accept();
  void close();

 private:
  using Native = asio::basic_socket_acceptor<asio::generic::stream_protocol>;
  /// Which file it is, so that another server's is not removed.
  struct FileId {
    std::uint64_t device = 0;
    std::uint64_t inode = 0;
    bool operator==(const FileId&) const = default;
  };
  static FileId file_id(const std::string& path);

  Acceptor(Native native, Endpoint endpoint);

  Native native_;
  Endpoint endpoint_;
  FileId file_;
  std::chrono::seconds dead_peer_ = dead_peer_limit;
};

}  // namespace metamer::wire
