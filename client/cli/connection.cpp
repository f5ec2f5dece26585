#include "client/cli/connection.h"

#include <boost/asio.hpp>
#include <cstdlib>
#include <optional>
#include <utility>

#include "client/session/connect.h"
#include "client/session/job_handle.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

/// `listen` begins to handle interrupts: not while we wait for another machine to accept, where the
/// system's way of dying is the quicker one.
asio::awaitable<ExitCode> connect_and_work(std::string server, Report& report, const Work& work,
                                           const std::function<void()>& listen) {
  const bool named = !server.empty();
  if (!named) listen();
  Answer<Connection> connection = co_await connect(std::move(server));
  if (!connection) co_return report.session_error(connection.error());
  if (named) listen();
  if (const std::string id = server_digits(connection->session->welcome()); !id.empty())
    report.document()["server_id"] = id;
  const ExitCode code = co_await work(*connection->session);
  co_return code;
}

/// Runs the coroutine until it ends, or until an interrupt stops the loop.
ExitCode run(asio::io_context& loop, Report& report, asio::awaitable<ExitCode> main) {
  std::optional<ExitCode> result;
  asio::co_spawn(loop, std::move(main), [&](const std::exception_ptr& error, ExitCode code) {
    try {
      if (error) std::rethrow_exception(error);
      result = code;
    } catch (const std::exception& failure) {
      report.error(failure.what());
      result = ExitCode::other;
    }
    loop.stop();
  });
  loop.run();
  if (!result) report.error("cancelled");
  return result.value_or(ExitCode::cancelled);
}

}  // namespace

Interrupts::Interrupts(asio::io_context& loop) : loop_(loop), signals_(loop, SIGINT, SIGTERM) {
  wait();
}

void Interrupts::wait() {
  signals_.async_wait([this](const boost::system::error_code& error, int) {
    if (error) return;
    if (std::exchange(seen_, true)) std::_Exit(static_cast<int>(ExitCode::cancelled));
    if (action_) {
      action_();
      wait();
    } else {
      loop_.stop();
    }
  });
}

std::string server_name(const CommonOptions& options) {
  if (!options.server.empty()) return options.server;
  const char* named = std::getenv("METAMER_SERVER");
  return named ? named : "";
}

ExitCode with_server(const CommonOptions& options, Report& report, const Work& work) {
  const std::string server = server_name(options);
  if (server.empty()) {
    report.error(
        "no server named: use --server unix:PATH, HOST:PORT or tls:HOST:PORT, or set "
        "METAMER_SERVER");
    return ExitCode::bad_input;
  }
  asio::io_context loop(1);
  const std::function<void()> ignore = [] {};  // Ctrl-C has nothing to cancel here
  return run(loop, report, connect_and_work(server, report, work, ignore));
}

ExitCode with_named_server(const std::string& server, const Credentials& credentials,
                           Report& report, const Work& work) {
  asio::io_context loop(1);
  const auto connect_with = [&]() -> asio::awaitable<ExitCode> {
    // With names: GCC 12 destroys some temporaries of a co_await twice.
    const ConnectLimits limits;
    const std::optional<Credentials> known = credentials;
    Answer<std::unique_ptr<Session>> session = co_await Session::connect(server, limits, known);
    if (!session) co_return report.session_error(session.error());
    co_return co_await work(**session);
  };
  return run(loop, report, connect_with());
}

ExitCode with_any_server(const CommonOptions& options, Report& report, InterruptibleWork work) {
  asio::io_context loop(1);
  std::optional<Interrupts> interrupts;
  const std::function<void()> listen = [&] { interrupts.emplace(loop); };
  const Work with_interrupts = [&](Session& session) { return work(session, *interrupts); };
  return run(loop, report, connect_and_work(server_name(options), report, with_interrupts, listen));
}

}  // namespace metamer::cli
