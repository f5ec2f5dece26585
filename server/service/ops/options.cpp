#include "server/service/ops/options.h"

#include <charconv>

#include "common/wire/endpoint.h"

namespace metamer::service {

namespace {

Result<void> check_endpoint(const std::string& text) {
  if (const auto endpoint = wire::parse_endpoint(text); !endpoint)
    return tl::unexpected(endpoint.error());
  return {};
}

Result<void> check_mode(const std::string& text) {
  if (socket_mode_of(text)) return {};
  return problem("expected a mode such as 0660, not " + quoted(text));
}

Result<void> check_gl_device(const std::string& text) {
  constexpr unsigned last_device = 15;
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  if (text == "auto" || text == "reference" || (is_number && number <= last_device)) return {};
  return problem("expected auto, reference, or a number from 0 to " + std::to_string(last_device) +
                 ", not " + quoted(text));
}

constexpr double kib = 1024;
constexpr double tib = kib * kib * kib * kib;
constexpr double day = 86400;

}  // namespace

std::optional<mode_t> socket_mode_of(const std::string& text) {
  constexpr mode_t any = 0777;
  mode_t mode = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mode, 8);
  if (error != std::errc{} || end != text.data() + text.size() || mode > any) return std::nullopt;
  return mode;
}

const std::vector<Section>& all_sections() {
  static const std::vector<Section> sections = {
      {"service", "Where clients come in, and how the daemon ends."},
      {"store", "What is kept, and how much of it."},
      {"workers", "The processes that render."},
      {"cluster", "Machines beside this one that render jobs, where Slurm has them."},
      {"limits",
       "How much there may be, and how long a client may keep from others what it does not use."},
      {"log", "What is said on stderr, and what is counted."},
  };
  return sections;
}

const std::vector<Option>& all_options() {
  static const std::vector<Option> options = {
      {.name = "listen",
       .section = "service",
       .meaning = "where to listen: unix:PATH, tls:HOST:PORT, HOST:PORT, or PORT on 127.0.0.1; "
                  "may be repeated; not set: a Unix socket in $XDG_RUNTIME_DIR, else in "
                  "/run/metamer where that is the daemon's own, else in /tmp/metamer-UID",
       .at = [](Settings& all) -> OptionTarget { return &all.listen; },
       .check = check_endpoint},
      {.name = "socket-mode",
       .section = "service",
       .meaning = "who may connect to the Unix sockets, as for chmod: 0600, their owner; 0660, a "
                  "group, too; 0666, any user of this machine",
       .at = [](Settings& all) -> OptionTarget { return &all.socket_mode; },
       .check = check_mode},
      {.name = "socket-group",
       .section = "service",
       .meaning = "the group of the Unix sockets; not set: the daemon's",
       .at = [](Settings& all) -> OptionTarget { return &all.service.listening.socket.group; }},
      {.name = "tls-cert",
       .section = "service",
       .meaning = "the certificate of tls: endpoints, and those that lead to its issuer (PEM)",
       .at = [](Settings& all) -> OptionTarget { return &all.service.listening.tls.certificate; }},
      {.name = "tls-key",
       .section = "service",
       .meaning = "the certificate's key (PEM)",
       .at = [](Settings& all) -> OptionTarget { return &all.service.listening.tls.key; }},
      {.name = "client-ca",
       .section = "service",
       .meaning = "who signs the certificates of clients (PEM), whose name is then a user's; not "
                  "set: they are not asked for any",
       .at = [](Settings& all) -> OptionTarget { return &all.service.listening.client_ca; }},
      {.name = "open",
       .section = "service",
       .meaning = "by TCP without TLS no token is needed: whoever reaches it may submit jobs",
       .at = [](Settings& all) -> OptionTarget { return &all.service.open; }},
      {.name = "insecure",
       .section = "service",
       .meaning = "listen without TLS where other machines can reach it, too: what is said there "
                  "can be read on the way",
       .at = [](Settings& all) -> OptionTarget { return &all.service.listening.insecure; }},
      {.name = "drain-seconds",
       .section = "service",
       .meaning = "the time that clients have, when the daemon ends, to take what is on its way",
       .at = [](Settings& all) -> OptionTarget { return &all.drain_time; },
       .unit = Unit::seconds,
       .min = 0,
       .max = 3600,
       .reloads = true},
      {.name = "parent-fd",
       .section = "",
       .meaning = "say `ready` on this descriptor once listening, and end when it closes",
       .at = [](Settings& all) -> OptionTarget { return &all.parent_fd; },
       .min = 3,
       .max = 1 << 20},

      {.name = "state",
       .section = "store",
       .meaning =
           "the folder of all that outlives the daemon: jobs, their pictures, assets, users; "
           "not set: nothing does but store",
       .at = [](Settings& all) -> OptionTarget { return &all.state; }},
      {.name = "store",
       .section = "store",
       .meaning = "the folder of assets, which is kept; not set: that of the state, or a temporary "
                  "one, removed at the end",
       .at = [](Settings& all) -> OptionTarget { return &all.store; }},
      {.name = "store-bytes",
       .section = "store",
       .meaning = "the most that the store may hold",
       .at = [](Settings& all) -> OptionTarget { return &all.service.store_bytes; },
       .unit = Unit::bytes,
       .min = 0,
       .max = 1024 * tib},
      {.name = "keep-bytes",
       .section = "store",
       .meaning =
           "pictures of ended and of paused jobs to keep, of all users together: whose take no "
           "more than their share lose none to others",
       .at = [](Settings& all) -> OptionTarget { return &all.service.keep_bytes; },
       .unit = Unit::bytes,
       .min = 0,
       .max = 1024 * tib},
      {.name = "keep-days",
       .section = "store",
       .meaning =
           "the days that ended jobs stay, and their pictures; 0: until their room is wanted",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.keep_days; },
       .min = 0,
       .max = 36500,
       .reloads = true},
      {.name = "first-job",
       .section = "store",
       .meaning = "the first job's number; not set: by the clock, so that none comes again after a "
                  "restart",
       .at = [](Settings& all) -> OptionTarget { return &all.first_job; },
       .min = 1,
       .max = 0x1p52},

      {.name = "threads",
       .section = "workers",
       .meaning = "threads of a worker; 0: as many as the machine has",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.command.threads; },
       .min = 0,
       .max = 256},
      {.name = "worker",
       .section = "workers",
       .meaning = "the worker's program; not set: metamer-worker beside metamerd",
       .at = [](Settings& all) -> OptionTarget { return &all.worker; }},
      {.name = "gl-device",
       .section = "workers",
       .meaning =
           "the device of the GL worker, which starts when it is asked for: auto, a graphics "
           "processor before software; reference, software; or a number, in EGL's order",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.command.gl_device; },
       .check = check_gl_device},
      {.name = "isa",
       .section = "workers",
       .meaning = "what the ray tracer uses of the processor: all that it has; AVX2 alone, in "
                  "packets of 8 rays; or AVX-512, in packets of 16, which a processor without it "
                  "refuses",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.command.isa; },
       .words = {"native", "avx2", "avx512"}},
      {.name = "unconfined",
       .section = "workers",
       .meaning = "start workers, too, where the kernel can't confine them (Landlock, seccomp)",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.command.unconfined; }},
      {.name = "worker-timeout",
       .section = "workers",
       .meaning = "the time without a sign of life after which a worker is ended",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.worker_timeout; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = 3600},
      {.name = "stall-timeout",
       .section = "workers",
       .meaning = "the time without progress in a job after which a worker is ended",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.stall_timeout; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = day},

      {.name = "turn",
       .section = "workers",
       .meaning = "the time that a job has a worker while others wait for it; at least 20 times "
                  "what it took to begin",
       .at = [](Settings& all) -> OptionTarget { return &all.service.worker.quantum; },
       .unit = Unit::seconds,
       .min = 0.01,
       .max = 3600},
      {.name = "memory",
       .section = "workers",
       .meaning = "the memory that jobs may take together, as estimated; 0: three quarters of the "
                  "machine's",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.memory; },
       .unit = Unit::bytes,
       .min = 0,
       .max = 1024 * tib,
       .reloads = true},

      {.name = "user-work",
       .section = "workers",
       .meaning =
           "seconds that workers may spend on one user's jobs within a day, the hours of the "
           "clock; then they wait. Not for admins; 0: as many as it wants",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.user_work; },
       .min = 0,
       .max = 1e9,
       .reloads = true},

      {.name = "executor",
       .section = "cluster",
       .meaning =
           "who has the CPU's jobs: workers of this machine, or Slurm, by sbatch, squeue and "
           "scancel; views stay here, and GL's jobs without slurm-gres",
       .at = [](Settings& all) -> OptionTarget { return &all.service.executor; },
       .words = {"local", "slurm"}},
      {.name = "slurm-folder",
       .section = "cluster",
       .meaning =
           "the folder of orders and results, which all nodes see at the same path; assets lie "
           "in it, too, where the store is not set",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.folder; }},
      {.name = "slurm-arguments",
       .section = "cluster",
       .meaning = "more words for sbatch, such as --partition=render or --mem-per-cpu=2G",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.commands.arguments; }},
      {.name = "slurm-gres",
       .section = "cluster",
       .meaning =
           "what a task of the GL backend takes of its node, as sbatch --gres has it: gpu:1; "
           "empty: GL's jobs stay here",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.commands.gres; }},
      {.name = "slurm-tasks",
       .section = "cluster",
       .meaning = "tasks that Slurm has at a time, of all jobs; each has as many CPUs as a worker "
                  "has threads, or one",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.tasks; },
       .min = 1,
       .max = 10000},
      {.name = "slurm-task-time",
       .section = "cluster",
       .meaning = "the work that is put into a task, by what the job's first tiles took",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.run.task_time; },
       .unit = Unit::seconds,
       .min = 0.01,
       .max = day},
      {.name = "slurm-patience",
       .section = "cluster",
       .meaning = "the time after which a task is taken for lost that Slurm does not list, or that "
                  "ended without a result",
       .at = [](Settings& all) -> OptionTarget { return &all.service.slurm.patience; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = 3600},

      {.name = "sessions",
       .section = "limits",
       .meaning = "sessions at a time; each takes a descriptor and some 20 KiB",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.sessions; },
       .min = 1,
       .max = 10000,
       .reloads = true},
      {.name = "session-watches",
       .section = "limits",
       .meaning = "jobs that one session watches at a time",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.session_watches; },
       .min = 1,
       .max = 256,
       .reloads = true},
      {.name = "views",
       .section = "limits",
       .meaning = "views that are open at a time, each a scene in a worker's memory",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.views; },
       .min = 1,
       .max = 256,
       .reloads = true},
      {.name = "session-views",
       .section = "limits",
       .meaning = "views of one session",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.session_views; },
       .min = 1,
       .max = 256,
       .reloads = true},
      {.name = "held-assets",
       .section = "limits",
       .meaning = "assets that one session keeps from eviction",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.held_assets; },
       .min = 1,
       .max = 1 << 20,
       .reloads = true},
      {.name = "live-jobs",
       .section = "limits",
       .meaning = "jobs that have not ended",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.live_jobs; },
       .min = 1,
       .max = 1e6,
       .reloads = true},
      {.name = "ended-jobs",
       .section = "limits",
       .meaning =
           "jobs that have ended and are still listed; the oldest go first, of who has more than "
           "his share",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.ended_jobs; },
       .min = 1,
       .max = 1e6,
       .reloads = true},
      {.name = "handshakes",
       .section = "limits",
       .meaning = "handshakes of TLS that run at a time; further ones wait for their turn",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.handshakes; },
       .min = 1,
       .max = 10000,
       .reloads = true},
      {.name = "source-handshakes",
       .section = "limits",
       .meaning = "of them, those of one address",
       .at = [](Settings& all) -> OptionTarget { return &all.service.limits.source_handshakes; },
       .min = 1,
       .max = 10000,
       .reloads = true},
      {.name = "handshake-timeout",
       .section = "limits",
       .meaning = "the time after which a TLS handshake is ended whose place another waits for",
       .at = [](Settings& all) -> OptionTarget { return &all.service.patience.handshake; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = 3600,
       .reloads = true},
      {.name = "hello-timeout",
       .section = "limits",
       .meaning = "the time after which a connection is closed that has said nothing",
       .at = [](Settings& all) -> OptionTarget { return &all.service.patience.hello; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = 3600,
       .reloads = true},
      {.name = "idle-timeout",
       .section = "limits",
       .meaning = "the time after which a session that says, reads and watches nothing is closed "
                  "once its place is wanted",
       .at = [](Settings& all) -> OptionTarget { return &all.service.patience.idle_session; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = day,
       .reloads = true},
      {.name = "write-timeout",
       .section = "limits",
       .meaning =
           "the time after which a client is closed that takes nothing of what is sent to it",
       .at = [](Settings& all) -> OptionTarget { return &all.service.patience.stall; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = 3600,
       .reloads = true},
      {.name = "upload-timeout",
       .section = "limits",
       .meaning = "the time between two chunks of an upload (4 MiB each) after which its room in "
                  "the store is given to others",
       .at = [](Settings& all) -> OptionTarget { return &all.service.patience.upload; },
       .unit = Unit::seconds,
       .min = 0.05,
       .max = day,
       .reloads = true},

      {.name = "log-level",
       .section = "log",
       .meaning = "the least that is said",
       .at = [](Settings& all) -> OptionTarget { return &all.log_level; },
       .words = {"trace", "debug", "info", "warn", "error", "off"},
       .reloads = true},
      {.name = "log-format",
       .section = "log",
       .meaning =
           "lines for people, or an object each; fields (peer, user, job, reason) are in both",
       .at = [](Settings& all) -> OptionTarget { return &all.log_format; },
       .words = {"text", "json"}},
      {.name = "metrics-file",
       .section = "log",
       .meaning =
           "the file that has what is counted, in Prometheus's text format, written anew every "
           "15 s; not set: none",
       .at = [](Settings& all) -> OptionTarget { return &all.metrics_file; }},
  };
  return options;
}

}  // namespace metamer::service
