#pragma once

#include <boost/asio.hpp>
#include <functional>
#include <optional>

#include "server/service/ops/command_line.h"
#include "server/service/ops/parent_watch.h"
#include "server/service/service.h"

namespace metamer::service {

/// What makes the program end, or read its configuration again:
///
///     SIGTERM, SIGINT   the service drains, for at most --drain-seconds; a second one ends it at
///     once SIGHUP            the file of --config is read again, if it is right
///     --parent-fd       closes: the service ends at once
///
/// and what the service manager hears of it.
class Lifecycle {
 public:
  /// `settings` are what `line` said. All outlive this.
  Lifecycle(asio::io_context& context, Service& service, const CommandLine& line,
            Settings& settings);

  /// The service has started: say so, and begin to listen for signals.
  void begin();

 private:
  void on_signal();
  void drain(int signal);
  void end();
  void reload();
  void report_state();
  void write_metrics();

  asio::io_context& context_;
  Service& service_;
  const CommandLine& line_;
  Settings& settings_;
  asio::signal_set signals_;
  asio::steady_timer beat_;
  asio::steady_timer metrics_;
  std::optional<ParentWatch> parent_;
  bool draining_ = false;
};

/// What of a configuration has been taken over, by the options' names.
struct TakenOver {
  std::vector<std::string> changed;        ///< In force from now on.
  std::vector<std::string> needs_restart;  ///< Differ, but stay as they are.
};

/// Gives `settings` those values of `fresh` that may change while the daemon runs.
TakenOver take_over(Settings& settings, const Settings& fresh);

}  // namespace metamer::service
