#include <malloc.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>

#include "common/wire/inherited.h"
#include "server/service/ops/command_line.h"
#include "server/service/ops/folders.h"
#include "server/service/ops/lifecycle.h"
#include "server/service/ops/log.h"
#include "server/service/ops/notify.h"
#include "server/service/ops/option_checks.h"
#include "server/service/ops/user_command.h"
#include "server/service/service.h"

namespace {

namespace service = metamer::service;
using metamer::Problem;
using metamer::Result;
using service::exit_failure;
using service::exit_ok;
using service::exit_usage;

int fail(int code, const Problem& problem) {
  spdlog::error("{}", problem.message);
  return code;
}

/// A message takes up to 4 MiB, several times over on its way. By default the C library returns
/// such pieces to the system when they are freed, and each next message has the kernel clear its
/// pages anew. Pictures, which are larger, still come and go by themselves.
void keep_message_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 8 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

int run(const service::CommandLine& line, service::Settings& settings) {
  boost::asio::io_context context(1);
  service::Service service(context, settings.service);
  service::Lifecycle life(context, service, line, settings);
  if (auto started = service.start(); !started) return fail(exit_failure, started.error());
  life.begin();
  // What a worker or a session is to blame for has ended that; anything else costs one step.
  while (true) {
    try {
      context.run();
      return exit_ok;
    } catch (const std::exception& exception) {
      spdlog::critical("a step failed: {}", exception.what());
    }
  }
}

/// Of the workers; empty where none is delegated.
std::filesystem::path control_group() {
  auto group = service::delegated_control_group();
  auto divided = group ? service::divide_control_group(*group) : tl::unexpected(group.error());
  if (divided) return *std::move(group);
  spdlog::info("workers have no control groups: {}", divided.error().message);
  return {};
}

int serve(const service::CommandLine& line, service::Settings& settings) {
  service::ServiceOptions& options = settings.service;
  for (const std::string& text : settings.listen) {
    const auto endpoint = metamer::wire::parse_endpoint(text);
    if (!endpoint) return fail(exit_usage, endpoint.error());
    options.listen.push_back(*endpoint);
  }
  for (const int descriptor : service::notify::listening_descriptors()) {
    const auto endpoint = metamer::wire::inherit_listener(descriptor);
    if (!endpoint) return fail(exit_failure, endpoint.error());
    if (std::find(options.listen.begin(), options.listen.end(), *endpoint) == options.listen.end())
      options.listen.push_back(*endpoint);
  }
  if (options.listen.empty()) {
    const auto endpoint = service::default_endpoint();
    if (!endpoint) return fail(exit_failure, endpoint.error());
    options.listen.push_back(*endpoint);
  }

  std::optional<service::TemporaryFolder> temporary;
  options.store = settings.store;
  options.state = settings.state;
  if (settings.store.empty() && settings.state.empty()) {
    auto made = service::TemporaryFolder::make();
    if (!made) return fail(exit_failure, made.error());
    temporary.emplace(*std::move(made));
    options.store = temporary->path();
  }
  options.listening.socket.mode = service::socket_mode_of(settings.socket_mode).value_or(0600);
  if (settings.first_job) options.first_job_id = *settings.first_job;
  options.worker.control_group = control_group();
  options.worker.gives_up = settings.parent_fd.has_value();
  options.worker.command.program =
      settings.worker.empty() ? service::default_worker() : std::filesystem::path(settings.worker);
  return run(line, settings);
}

int refuse(const service::Problems& problems) {
  for (const Problem& problem : problems)
    std::fprintf(stderr, "%s\n", metamer::format(problem).c_str());
  return exit_usage;
}

int check(const std::string& file, const service::Settings& settings) {
  for (const std::string& caution : service::cautions(settings))
    std::fprintf(stderr, "%s: warning: %s\n", file.c_str(), caution.c_str());
  auto wrong = service::contradictions(settings);
  if (wrong.empty()) return exit_ok;
  for (Problem& problem : wrong) problem.file = file;
  return refuse(wrong);
}

int run(const service::CommandLine& line) {
  auto settings = service::settings_of(line);
  if (!settings) return refuse(settings.error());
  switch (line.task) {
    case service::CommandLine::Task::print_config:
      std::fputs(service::config_text(*settings).c_str(), stdout);
      return exit_ok;
    case service::CommandLine::Task::check_config:
      return check(*line.config, *settings);
    case service::CommandLine::Task::serve:
      break;
  }
  service::log_to_stderr(settings->log_level, settings->log_format == "json"
                                                  ? service::LogFormat::json
                                                  : service::LogFormat::text);
  if (const auto wrong = service::contradictions(*settings); !wrong.empty()) return refuse(wrong);
  for (const std::string& caution : service::cautions(*settings)) spdlog::warn("{}", caution);
  keep_message_memory();
  service::allow_descriptors();
  ::signal(SIGPIPE, SIG_IGN);
  return serve(line, *settings);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "user")
    return service::run_user_command(argc - 1, argv + 1);
  const auto line = service::parse_command_line(argc, argv);
  if (!line) return line.error();
  try {
    return run(*line);
  } catch (const std::exception& exception) {
    spdlog::critical("{}", exception.what());
    return exit_failure;
  }
}
