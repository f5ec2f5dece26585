#include <malloc.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "server/service/folders.h"
#include "server/service/log.h"
#include "server/service/parent_watch.h"
#include "server/service/service.h"

namespace {

namespace service = metamer::service;
namespace wire = metamer::wire;
using metamer::Problem;
using metamer::Result;

constexpr int exit_ok = 0;
constexpr int exit_failure = 1;
constexpr int exit_usage = 2;

struct CommandLine {
  std::vector<std::string> listen;
  std::string store;
  std::string worker;
  std::string gl_device = "auto";
  std::string log_level = "info";
  std::uint64_t store_bytes = 8ull << 30;
  std::uint64_t keep_bytes = 1ull << 30;
  std::optional<std::uint64_t> first_job;
  std::uint32_t threads = 0;
  double worker_timeout = 5;
  double stall_timeout = 120;
  int parent_fd = -1;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "metamerd " METAMER_VERSION);
  app.add_option("--listen", line.listen,
                 "unix:PATH, HOST:PORT, or PORT on 127.0.0.1; may be repeated. Default: a Unix "
                 "socket in $XDG_RUNTIME_DIR, else in /tmp/metamer-UID")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--store", line.store,
                 "folder of assets; kept. Default: a temporary one, removed at the end");
  app.add_option("--store-bytes", line.store_bytes, "the most that the store may hold")
      ->transform(CLI::AsSizeValue(false))
      ->capture_default_str();
  app.add_option("--keep-bytes", line.keep_bytes, "pictures of ended and of paused jobs to keep")
      ->transform(CLI::AsSizeValue(false))
      ->capture_default_str();
  app.add_option("--first-job", line.first_job,
                 "the first job's number. Default: by the clock, so that none comes again after "
                 "a restart")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 52));
  app.add_option("--threads", line.threads, "of a worker; 0: as many as the machine has")
      ->check(CLI::Range(0u, 256u))
      ->capture_default_str();
  app.add_option("--worker", line.worker,
                 "the worker's program. Default: metamer-worker beside "
                 "this one");
  app.add_option("--gl-device", line.gl_device,
                 "of the GL worker, which starts when it is asked for: auto, a graphics processor "
                 "before software; reference, software; or a number, in EGL's order")
      ->check(CLI::IsMember({"auto", "reference"}) | CLI::Range(0u, 15u))
      ->capture_default_str();
  app.add_option("--worker-timeout", line.worker_timeout,
                 "seconds without a sign of life after which a worker is ended")
      ->check(CLI::Range(0.05, 3600.0))
      ->capture_default_str();
  app.add_option("--stall-timeout", line.stall_timeout,
                 "seconds without progress in a job after which a worker is ended")
      ->check(CLI::Range(0.05, 86400.0))
      ->capture_default_str();
  app.add_option("--parent-fd", line.parent_fd,
                 "say `ready` on this descriptor once listening, and end when it closes")
      ->check(CLI::Range(3, 1 << 20));
  app.add_option("--log-level", line.log_level, "what to say on stderr")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}))
      ->capture_default_str();
}

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

/// The endpoints to listen on; a problem is one of usage.
Result<std::vector<wire::Endpoint>> endpoints(const CommandLine& line) {
  std::vector<wire::Endpoint> result;
  for (const std::string& text : line.listen) {
    const auto endpoint = wire::parse_endpoint(text);
    if (!endpoint) return tl::unexpected(endpoint.error());
    result.push_back(*endpoint);
  }
  return result;
}

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

int run(const CommandLine& line, service::ServiceOptions options) {
  boost::asio::io_context context(1);
  service::Service service(context, std::move(options));
  boost::asio::signal_set signals(context, SIGINT, SIGTERM);
  std::optional<service::ParentWatch> parent;

  // End once: for a signal, or because the client is gone.
  const auto end = [&] {
    boost::system::error_code ignored;
    signals.cancel(ignored);
    if (parent) parent->close();
    service.stop();
  };
  signals.async_wait([&](boost::system::error_code cancelled, int number) {
    if (cancelled) return;
    spdlog::info("ending for signal {}", number);
    end();
  });
  if (line.parent_fd >= 0) parent.emplace(context.get_executor(), line.parent_fd, end);

  if (auto started = service.start(); !started) return fail(exit_failure, started.error());
  if (parent) parent->ready();
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

int run(const CommandLine& line) {
  service::ServiceOptions options;
  const auto listen = endpoints(line);
  if (!listen) return fail(exit_usage, listen.error());
  options.listen = *listen;
  if (options.listen.empty()) {
    const auto endpoint = service::default_endpoint();
    if (!endpoint) return fail(exit_failure, endpoint.error());
    options.listen.push_back(*endpoint);
  }

  std::optional<service::TemporaryFolder> temporary;
  options.store = line.store;
  if (line.store.empty()) {
    auto made = service::TemporaryFolder::make();
    if (!made) return fail(exit_failure, made.error());
    temporary.emplace(*std::move(made));
    options.store = temporary->path();
  }
  options.store_bytes = line.store_bytes;
  options.keep_bytes = line.keep_bytes;
  if (line.first_job) options.first_job_id = *line.first_job;
  options.worker.command.program =
      line.worker.empty() ? service::default_worker() : std::filesystem::path(line.worker);
  options.worker.command.threads = line.threads;
  options.worker.command.gl_device = line.gl_device;
  options.worker.worker_timeout = milliseconds(line.worker_timeout);
  options.worker.stall_timeout = milliseconds(line.stall_timeout);
  return run(line, std::move(options));
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  CLI::App app("The Metamer render service.");
  describe(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_usage;
  }

  service::log_to_stderr(line.log_level);
  keep_message_memory();
  ::signal(SIGPIPE, SIG_IGN);
  try {
    return run(line);
  } catch (const std::exception& exception) {
    spdlog::critical("{}", exception.what());
    return exit_failure;
  }
}
