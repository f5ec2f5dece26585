#include "client/session/connect.h"

#include <utility>

namespace metamer::client {

boost::asio::awaitable<Answer<Connection>> connect(std::string server) {
  Connection connection;
  if (server.empty()) {
    Answer<PrivateServer> started = co_await PrivateServer::start();
    if (!started) co_return tl::unexpected<SessionError>(std::move(started.error()));
    connection.own.emplace(std::move(*started));
    server = "unix:" + connection.own->socket().string();
  }

  Answer<std::unique_ptr<Session>> session = co_await Session::connect(server);
  if (!session) co_return tl::unexpected<SessionError>(std::move(session.error()));
  if (connection.own) connection.own->connected();
  connection.session = std::move(*session);
  co_return Answer<Connection>(std::move(connection));
}

}  // namespace metamer::client
