#include "common/wire/endpoint.h"

#include "common/wire/inherited.h"

#include <grp.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <boost/asio/experimental/awaitable_operators.hpp>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

namespace metamer::wire {

namespace {

using boost::system::error_code;
using GenericEndpoint = asio::generic::stream_protocol::endpoint;

constexpr std::size_t max_unix_path = 107;  // sun_path is 108 bytes with its closing 0
constexpr int backlog = 1024;
/// A Unix socket whose listener has as many connections waiting as it holds is tried again after
/// this time: the system has nothing to wait for there.
constexpr std::chrono::milliseconds busy_retry{20};
constexpr auto as_tuple = asio::as_tuple(asio::use_awaitable);

std::optional<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return port;
}

tl::unexpected<Problem> bad(std::string_view text, const std::string& why) {
  return problem("\"" + std::string(text) + "\" is no endpoint: " + why);
}

Result<Endpoint> parse_unix(std::string_view text, std::string_view path) {
  if (path.empty()) return bad(text, "the path after unix: is empty");
  if (path.size() > max_unix_path) {
    return bad(text, "the path has " + std::to_string(path.size()) +
                         " bytes, a Unix socket's has at most 107");
  }
  return Endpoint{Endpoint::Kind::unix_socket, std::string(path), {}, 0};
}

using Addresses = std::vector<GenericEndpoint>;

/// The address of an endpoint that has no name to look up.
std::optional<GenericEndpoint> address_of(const Endpoint& endpoint) {
  if (endpoint.kind == Endpoint::Kind::unix_socket)
    return asio::local::stream_protocol::endpoint(endpoint.path);
  error_code error;
  const auto address = asio::ip::make_address(endpoint.host, error);
  if (error) return std::nullopt;
  return asio::ip::tcp::endpoint(address, endpoint.port);
}

Result<Addresses> found_addresses(const Endpoint& endpoint, const error_code& error,
                                  const asio::ip::tcp::resolver::results_type& found) {
  if (error) return problem("can't find " + endpoint.host + ": " + error.message());
  Addresses addresses;
  for (const auto& entry : found) addresses.emplace_back(entry.endpoint());
  return addresses;
}

/// The system's addresses for an endpoint, looked up where it has a name.
Result<Addresses> resolve(const asio::any_io_executor& executor, const Endpoint& endpoint) {
  if (const auto address = address_of(endpoint)) return Addresses{*address};
  asio::ip::tcp::resolver resolver(executor);
  error_code error;
  const auto found = resolver.resolve(endpoint.host, std::to_string(endpoint.port), error);
  return found_addresses(endpoint, error, found);
}

/// Small messages travel at once. A peer that takes none of what was sent, or of a silent one the
/// question whether it is there, is given up after `dead_peer` (tcp(7)).
void prepare_tcp(Socket& socket, std::chrono::seconds dead_peer) {
  const int seconds = static_cast<int>(dead_peer.count());
  error_code error;
  const int family = socket.local_endpoint(error).data()->sa_family;
  if (error) return;
  if (family != AF_INET && family != AF_INET6) return;
  const auto set = [&](int level, int option, int value) {
    ::setsockopt(socket.native_handle(), level, option, &value, sizeof value);
  };
  set(IPPROTO_TCP, TCP_NODELAY, 1);
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, seconds);
  set(IPPROTO_TCP, TCP_KEEPINTVL, std::max(1, seconds / 3));
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, seconds * 1000);
}

/// Lets those connect to a Unix socket that `file` says.
Result<void> let_in(const Endpoint& endpoint, const SocketFile& file) {
  const auto failed = [&](const std::string& what) {
    return problem("can't listen on " + to_string(endpoint) + ": " + what);
  };
  if (!file.group.empty()) {
    errno = 0;
    const group* known = ::getgrnam(file.group.c_str());
    if (!known) return failed("there is no group \"" + file.group + "\"");
    if (::chown(endpoint.path.c_str(), static_cast<uid_t>(-1), known->gr_gid) != 0)
      return failed("can't give it to the group " + file.group + ": " + std::strerror(errno));
  }
  if (::chmod(endpoint.path.c_str(), file.mode) != 0)
    return failed(std::string("can't set its mode: ") + std::strerror(errno));
  return {};
}

/// Makes room for a Unix socket at `path`: nothing there, or one that nobody listens on.
Result<void> clear_path(const asio::any_io_executor& executor, const Endpoint& endpoint) {
  struct stat status {};
  if (::lstat(endpoint.path.c_str(), &status) != 0) {
    return errno == ENOENT || errno == ENOTDIR
               ? Result<void>()
               : problem("can't look at " + endpoint.path + ": " + std::strerror(errno));
  }
  if (!S_ISSOCK(status.st_mode)) {
    return problem("can't listen on " + to_string(endpoint) +
                   ": a file that is no socket is there");
  }
  Socket probe(executor);
  error_code error;
  probe.connect(asio::local::stream_protocol::endpoint(endpoint.path), error);
  if (error != asio::error::connection_refused) {
    return problem("can't listen on " + to_string(endpoint) + ": another server listens there");
  }
  ::unlink(endpoint.path.c_str());
  return {};
}

}  // namespace

Result<Endpoint> parse_endpoint(std::string_view text) {
  constexpr std::string_view expected = "expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT";
  if (text.starts_with("unix:")) return parse_unix(text, text.substr(5));
  const bool tls = text.starts_with("tls:");
  const std::string_view whole = text;
  if (tls) text.remove_prefix(4);

  // A colon inside brackets belongs to an IPv6 address.
  std::string_view host = "127.0.0.1";
  std::string_view port = text;
  if (const auto colon = text.rfind(':'); colon != std::string_view::npos) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (host.starts_with('[') && host.ends_with(']')) {
      host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
      return bad(whole, "an IPv6 address needs brackets, as in [::1]:7777");
    }
  }
  if (host.empty()) return bad(whole, std::string(expected));
  const auto number = parse_port(port);
  if (!number) {
    const bool digits =
        !port.empty() && port.find_first_not_of("0123456789") == std::string_view::npos;
    return bad(whole, std::string(digits ? "a port is at most 65535" : expected));
  }
  return Endpoint{Endpoint::Kind::tcp, {}, std::string(host), *number, tls};
}

std::string to_string(const Endpoint& endpoint) {
  if (endpoint.kind == Endpoint::Kind::unix_socket) return "unix:" + endpoint.path;
  const bool v6 = endpoint.host.find(':') != std::string::npos;
  return (endpoint.tls ? "tls:" : "") + (v6 ? "[" + endpoint.host + "]" : endpoint.host) + ":" +
         std::to_string(endpoint.port);
}

namespace {

/// A look-up that may be left: the system's call can't be interrupted.
struct LookUp {
  explicit LookUp(const asio::any_io_executor& executor)
      : resolver(executor), done(executor, asio::steady_timer::time_point::max()) {}
  asio::ip::tcp::resolver resolver;
  asio::steady_timer done;  // cancelled when there is a result
  std::optional<Result<Addresses>> result;
};

/// The same without blocking. Another error: "Operation canceled".
asio::awaitable<Result<Addresses>> look_up(Endpoint endpoint) {
  if (const auto address = address_of(endpoint)) co_return Addresses{*address};
  const auto look = std::make_shared<LookUp>(co_await asio::this_coro::executor);
  look->resolver.async_resolve(endpoint.host, std::to_string(endpoint.port),
                               [look, endpoint](auto error, auto found) {
                                 look->result = found_addresses(endpoint, error, found);
                                 look->done.cancel();
                               });
  co_await look->done.async_wait(as_tuple);
  if (look->result) co_return *look->result;
  const error_code cancelled = asio::error::operation_aborted;
  co_return found_addresses(endpoint, cancelled, {});
}

/// What is cancelled while nothing is awaited is not told by the next operation: ask.
bool is_cancelled(const asio::cancellation_state& state) {
  return state.cancelled() != asio::cancellation_type::none;
}

/// A Unix socket connects at once or not at all; see busy_retry.
asio::awaitable<error_code> connect_unix(Socket& socket, const GenericEndpoint& address) {
  asio::steady_timer pause(socket.get_executor());
  error_code error;
  socket.open(address.protocol(), error);
  while (!error) {
    socket.native_non_blocking(true, error);
    const auto size = static_cast<socklen_t>(address.size());
    if (::connect(socket.native_handle(), address.data(), size) == 0) co_return error_code();
    if (errno != EAGAIN) co_return error_code(errno, boost::system::system_category());
    pause.expires_after(busy_retry);
    std::tie(error) = co_await pause.async_wait(as_tuple);
    if (is_cancelled(co_await asio::this_coro::cancellation_state))
      error = asio::error::operation_aborted;
  }
  co_return error;
}

asio::awaitable<Result<Socket>> connect_in_turn(const Endpoint& endpoint) {
  // Cancelled or late is told as a value, like any other reason.
  co_await asio::this_coro::throw_if_cancelled(false);
  const auto addresses = co_await look_up(endpoint);
  if (!addresses) co_return tl::unexpected(addresses.error());
  error_code error = asio::error::host_not_found;
  for (const auto& address : *addresses) {
    if (is_cancelled(co_await asio::this_coro::cancellation_state)) {
      error = asio::error::operation_aborted;
      break;
    }
    Socket socket(co_await asio::this_coro::executor);
    if (endpoint.kind == Endpoint::Kind::unix_socket) {
      error = co_await connect_unix(socket, address);
    } else {
      std::tie(error) = co_await socket.async_connect(address, as_tuple);
    }
    if (error == asio::error::operation_aborted) break;
    if (error) continue;
    prepare_tcp(socket, dead_peer_limit);
    co_return socket;
  }
  co_return problem("can't connect to " + to_string(endpoint) + ": " + error.message());
}

asio::awaitable<void> pass(std::chrono::steady_clock::duration limit) {
  asio::steady_timer timer(co_await asio::this_coro::executor, limit);
  co_await timer.async_wait(asio::use_awaitable);
}

}  // namespace

asio::awaitable<Result<Socket>> connect(Endpoint endpoint,
                                        std::chrono::steady_clock::duration limit) {
  using asio::experimental::awaitable_operators::operator||;
  auto first = co_await (connect_in_turn(endpoint) || pass(limit));
  if (auto* connected = std::get_if<0>(&first)) co_return std::move(*connected);
  const std::chrono::duration<double> seconds = limit;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", seconds.count());
  co_return problem("can't connect to " + to_string(endpoint) + ": no connection within " +
                    text.data() + " s");
}

Acceptor::Acceptor(Native native, Endpoint endpoint)
    : native_(std::move(native)), endpoint_(std::move(endpoint)) {
  if (endpoint_.kind == Endpoint::Kind::unix_socket) file_ = file_id(endpoint_.path);
}

Acceptor::~Acceptor() { close(); }

Acceptor::FileId Acceptor::file_id(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino};
}

bool Acceptor::is_local() const {
  if (endpoint_.kind == Endpoint::Kind::unix_socket) return true;
  error_code error;
  const auto local = native_.local_endpoint(error);
  if (error) return false;
  asio::ip::tcp::endpoint address;
  std::memcpy(address.data(), local.data(), std::min(local.size(), address.capacity()));
  return address.address().is_loopback();
}

Result<Acceptor> Acceptor::listen(const asio::any_io_executor& executor, const Endpoint& endpoint,
                                  const SocketFile& file, std::chrono::seconds dead_peer) {
  if (const auto descriptor = take_inherited(endpoint)) {
    const bool unix_socket = endpoint.kind == Endpoint::Kind::unix_socket;
    const bool v6 = endpoint.host.find(':') != std::string::npos;
    const int family = unix_socket ? AF_UNIX : v6 ? AF_INET6 : AF_INET;
    Acceptor acceptor(Native(executor, asio::generic::stream_protocol(family, 0), *descriptor),
                      endpoint);
    acceptor.file_ = {};
    acceptor.dead_peer_ = dead_peer;
    return acceptor;
  }
  if (endpoint.kind == Endpoint::Kind::unix_socket) {
    if (auto clear = clear_path(executor, endpoint); !clear) return tl::unexpected(clear.error());
  }
  const auto addresses = resolve(executor, endpoint);
  if (!addresses) return tl::unexpected(addresses.error());

  // Bind, then narrow the file's mode before anybody can connect.
  const auto& address = addresses->front();
  const auto failed = [&](const error_code& error) {
    return problem("can't listen on " + to_string(endpoint) + ": " + error.message());
  };
  error_code error;
  Native native(executor);
  native.open(address.protocol(), error);
  if (error) return failed(error);
  if (endpoint.kind == Endpoint::Kind::tcp) {
    native.set_option(asio::socket_base::reuse_address(true), error);
  }
  native.bind(address, error);
  if (error) return failed(error);
  if (endpoint.kind == Endpoint::Kind::unix_socket)
    if (auto open = let_in(endpoint, file); !open) return tl::unexpected(open.error());
  native.listen(backlog, error);
  if (error) return failed(error);

  Endpoint bound = endpoint;
  if (endpoint.kind == Endpoint::Kind::tcp) {
    const auto local = native.local_endpoint();
    // The port stands at the same place in sockaddr_in and sockaddr_in6.
    bound.port = ntohs(reinterpret_cast<const sockaddr_in*>(local.data())->sin_port);
  }
  Acceptor acceptor(std::move(native), std::move(bound));
  acceptor.dead_peer_ = dead_peer;
  return acceptor;
}

asio::awaitable<std::pair<error_code, Socket>> Acceptor::accept() {
  auto [error, socket] = co_await native_.async_accept(asio::as_tuple(asio::use_awaitable));
  if (!error) prepare_tcp(socket, dead_peer_);
  co_return std::pair(error, std::move(socket));
}

void Acceptor::close() {
  if (!native_.is_open()) return;
  error_code ignored;
  native_.close(ignored);
  if (file_ != FileId{} && file_id(endpoint_.path) == file_) ::unlink(endpoint_.path.c_str());
}

}  // namespace metamer::wire
