#include "client/session/connect.h"

#include <utility>

namespace metamer::client {

boost::asio::awaitable<Answer<Connection>> connect(std::string server, ConnectLimits limits,
                                                   int nice) {
  Connection connection;
  std::optional<Credentials> credentials;
  if (server.empty()) {
    Answer<PrivateServer> started = co_await PrivateServer::start(nice);
    if (!started) co_return tl::unexpected<SessionError>(std::move(started.error()));
    connection.own.emplace(std::move(*started));
    server = "unix:" + connection.own->socket().string();
    credentials.emplace();  // it is ours
  }

  Answer<std::unique_ptr<Session>> session =
      co_await Session::connect(server, limits, std::move(credentials));
  if (!session) co_return tl::unexpected<SessionError>(std::move(session.error()));
  if (connection.own) connection.own->connected();
  connection.session = std::move(*session);
  co_return Answer<Connection>(std::move(connection));
}

}  // namespace metamer::client
