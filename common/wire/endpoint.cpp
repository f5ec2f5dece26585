#include "common/wire/endpoint.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <vector>

namespace metamer::wire {

namespace {

using boost::system::error_code;
using GenericEndpoint = asio::generic::stream_protocol::endpoint;

constexpr std::size_t max_unix_path = 107;  // sun_path is 108 bytes with its closing 0
constexpr int backlog = 64;

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

/// The system's addresses for an endpoint, looked up where it has a name.
Result<std::vector<GenericEndpoint>> resolve(const asio::any_io_executor& executor,
                                             const Endpoint& endpoint) {
  if (endpoint.kind == Endpoint::Kind::unix_socket) {
    return std::vector<GenericEndpoint>{asio::local::stream_protocol::endpoint(endpoint.path)};
  }
  asio::ip::tcp::resolver resolver(executor);
  error_code error;
  const auto found = resolver.resolve(endpoint.host, std::to_string(endpoint.port), error);
  if (error) return problem("can't find " + endpoint.host + ": " + error.message());
  std::vector<GenericEndpoint> endpoints;
  for (const auto& entry : found) endpoints.emplace_back(entry.endpoint());
  return endpoints;
}

/// Small messages travel at once; a peer that vanished is noticed some day.
void prepare_tcp(Socket& socket) {
  error_code error;
  const int family = socket.local_endpoint(error).data()->sa_family;
  if (error) return;
  if (family != AF_INET && family != AF_INET6) return;
  const int on = 1;
  ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ::setsockopt(socket.native_handle(), SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
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
  constexpr std::string_view expected = "expected unix:PATH, HOST:PORT or PORT";
  if (text.starts_with("unix:")) return parse_unix(text, text.substr(5));

  // A colon inside brackets belongs to an IPv6 address.
  std::string_view host = "127.0.0.1";
  std::string_view port = text;
  if (const auto colon = text.rfind(':'); colon != std::string_view::npos) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (host.starts_with('[') && host.ends_with(']')) {
      host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
      return bad(text, "an IPv6 address needs brackets, as in [::1]:7777");
    }
  }
  if (host.empty()) return bad(text, std::string(expected));
  const auto number = parse_port(port);
  if (!number) {
    const bool digits =
        !port.empty() && port.find_first_not_of("0123456789") == std::string_view::npos;
    return bad(text, std::string(digits ? "a port is at most 65535" : expected));
  }
  return Endpoint{Endpoint::Kind::tcp, {}, std::string(host), *number};
}

std::string to_string(const Endpoint& endpoint) {
  if (endpoint.kind == Endpoint::Kind::unix_socket) return "unix:" + endpoint.path;
  const bool v6 = endpoint.host.find(':') != std::string::npos;
  return (v6 ? "[" + endpoint.host + "]" : endpoint.host) + ":" + std::to_string(endpoint.port);
}

Result<Socket> connect(const asio::any_io_executor& executor, const Endpoint& endpoint) {
  const auto addresses = resolve(executor, endpoint);
  if (!addresses) return tl::unexpected(addresses.error());
  error_code error = asio::error::host_not_found;
  for (const auto& address : *addresses) {
    Socket socket(executor);
    socket.connect(address, error);
    if (error) continue;
    prepare_tcp(socket);
    return socket;
  }
  return problem("can't connect to " + to_string(endpoint) + ": " + error.message());
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

Result<Acceptor> Acceptor::listen(const asio::any_io_executor& executor, const Endpoint& endpoint) {
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
  if (endpoint.kind == Endpoint::Kind::unix_socket) ::chmod(endpoint.path.c_str(), 0600);
  native.listen(backlog, error);
  if (error) return failed(error);

  Endpoint bound = endpoint;
  if (endpoint.kind == Endpoint::Kind::tcp) {
    const auto local = native.local_endpoint();
    // The port stands at the same place in sockaddr_in and sockaddr_in6.
    bound.port = ntohs(reinterpret_cast<const sockaddr_in*>(local.data())->sin_port);
  }
  return Acceptor(std::move(native), std::move(bound));
}

asio::awaitable<std::pair<error_code, Socket>> Acceptor::accept() {
  auto [error, socket] = co_await native_.async_accept(asio::as_tuple(asio::use_awaitable));
  if (!error) prepare_tcp(socket);
  co_return std::pair(error, std::move(socket));
}

void Acceptor::close() {
  if (!native_.is_open()) return;
  error_code ignored;
  native_.close(ignored);
  if (file_ != FileId{} && file_id(endpoint_.path) == file_) ::unlink(endpoint_.path.c_str());
}

}  // namespace metamer::wire
