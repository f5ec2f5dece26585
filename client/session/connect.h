#pragma once

#include <boost/asio/awaitable.hpp>
#include <memory>
#include <optional>
#include <string>

#include "client/session/error.h"
#include "client/session/private_server.h"
#include "client/session/session.h"

namespace metamer::client {

/// A session, and the server that it is with where that is a private one, which ends with this.
struct Connection {
  std::optional<PrivateServer> own;
  std::unique_ptr<Session> session;  ///< Ends before its server. Never null.
};

/// Connects to a server, "unix:PATH" or "HOST:PORT"; where none is named, starts a private one and
/// connects to that. Errors: those of PrivateServer::start and Session::connect.
boost::asio::awaitable<Answer<Connection>> connect(std::string server, ConnectLimits limits = {},
                                                   int nice = 0);

}  // namespace metamer::client
