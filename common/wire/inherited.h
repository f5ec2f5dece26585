#pragma once

#include <optional>

#include "common/wire/endpoint.h"

/// Listening sockets that a process was started with: who started it has bound them, and goes on to
/// hold them when it ends (sd_listen_fds(3)). For the thread that starts a server.
namespace metamer::wire {

/// Says that `descriptor` listens: Acceptor::listen of the endpoint that this gives takes it over,
/// and leaves a Unix socket's file where it is. Errors: it is no Unix or TCP socket that listens.
Result<Endpoint> inherit_listener(int descriptor);

/// The descriptor that listens there, once.
std::optional<int> take_inherited(const Endpoint& endpoint);

}  // namespace metamer::wire
