#include "server/service/ops/lifecycle.h"

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "server/service/ops/log.h"
#include "server/service/ops/notify.h"
#include "server/service/ops/option_value.h"

namespace metamer::service {

namespace {

/// How often the service manager gets a line of state, unless it wants signs of life more often.
constexpr std::chrono::milliseconds state_interval{5000};
/// What Prometheus asks for by itself unless told otherwise is a minute.
constexpr std::chrono::seconds metrics_interval{15};
/// To end workers and to write what is still to be kept; killed for slowness it would lose no job.
constexpr std::chrono::milliseconds ending_time{10'000};

}  // namespace

TakenOver take_over(Settings& settings, const Settings& fresh) {
  TakenOver result;
  for (const Option& option : all_options()) {
    if (toml_text(option, settings) == toml_text(option, fresh)) continue;
    (option.reloads ? result.changed : result.needs_restart).push_back(option.name);
    if (option.reloads) copy_value(option, fresh, settings);
  }
  return result;
}

Lifecycle::Lifecycle(asio::io_context& context, Service& service, const CommandLine& line,
                     Settings& settings)
    : context_(context),
      service_(service),
      line_(line),
      settings_(settings),
      signals_(context, SIGINT, SIGTERM, SIGHUP),
      beat_(context),
      metrics_(context) {
  if (settings.parent_fd) {
    parent_.emplace(context.get_executor(), static_cast<int>(*settings.parent_fd),
                    [this] { end(); });
  }
}

void Lifecycle::begin() {
  on_signal();
  if (!settings_.metrics_file.empty()) write_metrics();
  if (parent_) parent_->ready();
  notify::ready();
  report_state();
}

void Lifecycle::on_signal() {
  signals_.async_wait([this](boost::system::error_code cancelled, int number) {
    if (cancelled) return;
    if (number == SIGHUP) {
      if (!draining_) reload();
    } else if (draining_) {
      spdlog::info("ending at once for signal {}", number);
      return end();
    } else {
      drain(number);
    }
    on_signal();
  });
}

void Lifecycle::drain(int signal) {
  spdlog::info("ending for signal {}", signal);
  draining_ = true;
  notify::stopping(settings_.drain_time + ending_time);
  asio::co_spawn(context_, service_.drain(settings_.drain_time),
                 [this](const std::exception_ptr&) { end(); });
}

void Lifecycle::end() {
  notify::stopping(ending_time);
  boost::system::error_code ignored;
  signals_.cancel(ignored);
  beat_.cancel();
  metrics_.cancel();
  if (parent_) parent_->close();
  service_.stop();
}

void Lifecycle::reload() {
  notify::reloading();
  if (const auto fresh = settings_of(line_); !fresh) {
    for (const Problem& problem : fresh.error()) spdlog::error("{}", format(problem));
    spdlog::error("the configuration stays as it was");
  } else {
    const TakenOver taken = take_over(settings_, *fresh);
    spdlog::info("configuration read again: {} changed{}", taken.changed.size(),
                 taken.changed.empty() ? "" : fmt::format(" ({})", fmt::join(taken.changed, ", ")));
    if (!taken.needs_restart.empty())
      spdlog::warn("needs a restart: {}", fmt::join(taken.needs_restart, ", "));
    spdlog::set_level(spdlog::level::from_str(settings_.log_level));
    service_.change_limits(settings_.service.limits, settings_.service.patience);
    if (const auto certificates = service_.reload_certificates(); !certificates)
      spdlog::error("{}; the certificates stay as they were", certificates.error().message);
  }
  notify::ready();
}

void Lifecycle::write_metrics() {
  if (auto written = replace_file(settings_.metrics_file, prometheus_text(service_.counts()));
      !written)
    spdlog::error("{}", written.error().message);
  metrics_.expires_after(metrics_interval);
  metrics_.async_wait([this](boost::system::error_code cancelled) {
    if (!cancelled) write_metrics();
  });
}

/// Also the sign of life: the loop that does all the work gets here.
void Lifecycle::report_state() {
  const auto watchdog = notify::watchdog_interval();
  if (watchdog) notify::alive();
  notify::status(service_.state_line());
  beat_.expires_after(watchdog ? std::min(*watchdog, state_interval) : state_interval);
  beat_.async_wait([this](boost::system::error_code cancelled) {
    if (!cancelled) report_state();
  });
}

}  // namespace metamer::service
