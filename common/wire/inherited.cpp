#include "common/wire/inherited.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace metamer::wire {

namespace {

std::vector<std::pair<Endpoint, int>>& inherited_listeners() {
  static std::vector<std::pair<Endpoint, int>> listeners;
  return listeners;
}

std::optional<Endpoint> endpoint_of(const sockaddr_storage& address, socklen_t size) {
  if (address.ss_family == AF_UNIX) {
    const auto& local = reinterpret_cast<const sockaddr_un&>(address);
    if (size <= offsetof(sockaddr_un, sun_path) || local.sun_path[0] == '\0') return std::nullopt;
    return Endpoint{.kind = Endpoint::Kind::unix_socket, .path = local.sun_path, .host = {}};
  }
  Endpoint endpoint;
  char text[INET6_ADDRSTRLEN];
  if (address.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
    endpoint.host = ::inet_ntop(AF_INET, &v4.sin_addr, text, sizeof text);
    endpoint.port = ntohs(v4.sin_port);
  } else if (address.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(address);
    endpoint.host = ::inet_ntop(AF_INET6, &v6.sin6_addr, text, sizeof text);
    endpoint.port = ntohs(v6.sin6_port);
  } else {
    return std::nullopt;
  }
  return endpoint;
}

}  // namespace

Result<Endpoint> inherit_listener(int descriptor) {
  const auto fail = [&] {
    return problem("descriptor " + std::to_string(descriptor) +
                   " is no Unix or TCP socket that listens");
  };
  int listens = 0;
  socklen_t length = sizeof listens;
  if (::getsockopt(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &listens, &length) != 0 || listens == 0)
    return fail();
  sockaddr_storage address{};
  socklen_t size = sizeof address - 1;  // a path of full length has no closing 0
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return fail();
  const auto endpoint = endpoint_of(address, size);
  if (!endpoint) return fail();
  inherited_listeners().emplace_back(*endpoint, descriptor);
  return *endpoint;
}

std::optional<int> take_inherited(const Endpoint& endpoint) {
  auto& listeners = inherited_listeners();
  const auto found = std::find_if(listeners.begin(), listeners.end(),
                                  [&](const auto& known) { return known.first == endpoint; });
  if (found == listeners.end()) return std::nullopt;
  const int descriptor = found->second;
  listeners.erase(found);
  return descriptor;
}

}  // namespace metamer::wire
