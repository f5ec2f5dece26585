#include "server/import/messages.h"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace metamer::import {
namespace {

/// A message of one byte with room for one descriptor.
struct Carrier {
  char byte = 0;
  iovec part{&byte, 1};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
  msghdr message{};

  Carrier() {
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
  }
};

}  // namespace

bool send_descriptor(int socket, int descriptor) {
  Carrier carrier;
  if (descriptor >= 0) {
    cmsghdr* const head = CMSG_FIRSTHDR(&carrier.message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof descriptor);
    std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  } else {
    carrier.message.msg_control = nullptr;
    carrier.message.msg_controllen = 0;
  }
  ssize_t sent;
  do sent = sendmsg(socket, &carrier.message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == 1;
}

std::optional<Descriptor> receive_descriptor(int socket) {
  Carrier carrier;
  ssize_t got;
  do got = recvmsg(socket, &carrier.message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  if (got != 1) return std::nullopt;
  const cmsghdr* const head = CMSG_FIRSTHDR(&carrier.message);
  if (head == nullptr || head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS)
    return Descriptor();
  int descriptor = -1;
  std::memcpy(&descriptor, CMSG_DATA(head), sizeof descriptor);
  return Descriptor(descriptor);
}

}  // namespace metamer::import
