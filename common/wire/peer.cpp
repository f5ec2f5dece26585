#include "common/wire/peer.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>

namespace metamer::wire {

namespace {

bool is_loopback(const asio::generic::stream_protocol::endpoint& remote) {
  if (remote.data()->sa_family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, remote.data(), std::min(sizeof address, remote.size()));
    return asio::ip::address_v4(ntohl(address.sin_addr.s_addr)).is_loopback();
  }
  sockaddr_in6 address{};
  std::memcpy(&address, remote.data(), std::min(sizeof address, remote.size()));
  asio::ip::address_v6::bytes_type bytes;
  std::memcpy(bytes.data(), &address.sin6_addr, bytes.size());
  const asio::ip::address_v6 v6(bytes);
  return v6.is_loopback() ||
         (v6.is_v4_mapped() && asio::ip::make_address_v4(asio::ip::v4_mapped, v6).is_loopback());
}

std::string address_text(const asio::generic::stream_protocol::endpoint& remote) {
  if (remote.data()->sa_family == AF_INET) {
    sockaddr_in address{};
    std::memcpy(&address, remote.data(), std::min(sizeof address, remote.size()));
    return asio::ip::address_v4(ntohl(address.sin_addr.s_addr)).to_string();
  }
  if (remote.data()->sa_family != AF_INET6) return {};
  sockaddr_in6 address{};
  std::memcpy(&address, remote.data(), std::min(sizeof address, remote.size()));
  asio::ip::address_v6::bytes_type bytes;
  std::memcpy(bytes.data(), &address.sin6_addr, bytes.size());
  const asio::ip::address_v6 v6(bytes);
  if (v6.is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, v6).to_string();
  std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
  return asio::ip::address_v6(bytes).to_string() + "/64";
}

}  // namespace

PeerIdentity peer_of(Socket& socket) {
  PeerIdentity peer;
  ucred credentials{};
  socklen_t size = sizeof credentials;
  boost::system::error_code error;
  const auto local = socket.local_endpoint(error);
  if (error) return peer;
  if (local.data()->sa_family == AF_UNIX) {
    peer.local = true;
    if (::getsockopt(socket.native_handle(), SOL_SOCKET, SO_PEERCRED, &credentials, &size) == 0) {
      peer.user = credentials.uid;
      if (credentials.pid > 0) peer.process = credentials.pid;
    }
    return peer;
  }
  const auto remote = socket.remote_endpoint(error);
  if (error) return peer;
  peer.address = address_text(remote);
  peer.local = is_loopback(remote);
  return peer;
}

std::string to_string(const PeerIdentity& peer) {
  return peer.user ? "uid " + std::to_string(*peer.user) : peer.address;
}

}  // namespace metamer::wire
