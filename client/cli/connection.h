#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <functional>

#include "client/cli/exit_code.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/session/session.h"

namespace metamer::cli {

/// Ctrl-C and SIGTERM of a command that has something to cancel. The first one does what
/// on_first() says, or ends the loop where nothing has been said yet; the second one leaves at
/// once.
class Interrupts {
 public:
  explicit Interrupts(boost::asio::io_context& loop);
  void on_first(std::function<void()> action) { action_ = std::move(action); }

 private:
  void wait();
  boost::asio::io_context& loop_;
  boost::asio::signal_set signals_;
  std::function<void()> action_;
  bool seen_ = false;
};

/// What a subcommand does with a server.
using Work = std::function<boost::asio::awaitable<ExitCode>(Session&)>;

/// Connects to the server that the options or METAMER_SERVER name, and works with it; prints why
/// where that fails. No server named is an error of usage.
ExitCode with_server(const CommonOptions& options, Report& report, const Work& work);

/// The same, but starts a private server where none is named, and handles interrupts.
using InterruptibleWork = std::function<boost::asio::awaitable<ExitCode>(Session&, Interrupts&)>;
ExitCode with_any_server(const CommonOptions& options, Report& report, InterruptibleWork work);

/// Connects to `server` with these credentials, whatever is kept of it.
ExitCode with_named_server(const std::string& server, const Credentials& credentials,
                           Report& report, const Work& work);

/// The server that the options or the environment name; empty: none.
std::string server_name(const CommonOptions& options);

}  // namespace metamer::cli
