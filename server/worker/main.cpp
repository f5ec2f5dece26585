// metamer-worker: started by metamerd, which talks to it over descriptor 3 and shares the picture's
// memory as descriptor 4. Or, with --batch, a task of a cluster, which starts another as the daemon
// would.

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "common/program/machine.h"
#include "server/batch/batch.h"
#include "server/cpu/renderer.h"
#include "server/gl/renderer.h"
#include "server/sandbox/sandbox.h"
#include "server/worker/capabilities.h"
#include "server/worker/heartbeat.h"
#include "server/worker/lane.h"
#include "server/worker/out_of_memory.h"

namespace {

constexpr int link_descriptor = 3;
constexpr int film_descriptor = 4;

constexpr const char* usage =
    "usage: metamer-worker --store DIR --threads N [--gl-device auto|reference|N] [--nice N] "
    "[--group DIR] [--unconfined yes] [--isa native|avx2|avx512]\n"
    "Started by metamerd; descriptor 3 is its socket, descriptor 4 the picture's memory.\n"
    "   or: metamer-worker --batch FILE [--threads N] [--gl-device …] [--nice N] [--unconfined "
    "yes]\n"
    "Carries out an order of metamerd's, as a task of a cluster.\n";

/// Moves this process into a control group, and so all that it will start.
void enter_group(const std::string& folder) {
  const int processes = open((folder + "/cgroup.procs").c_str(), O_WRONLY | O_CLOEXEC);
  if (processes < 0 || write(processes, "0", 1) != 1) std::perror("metamer-worker: --group");
  if (processes >= 0) close(processes);
}

/// Tells the daemon why this worker never will be ready.
void say_failed(const std::string& reason, metamer::worker::Link& link) {
  metamer::v1::WorkerEnvelope failed;
  failed.mutable_failed()->set_kind(metamer::v1::Failed::SERVER);
  failed.mutable_failed()->set_reason(reason);
  link.send(failed);
}

/// Opens the GL device, with all files that its driver wants, and frees it for the lane's thread.
std::unique_ptr<metamer::gl::Device> open_device(const std::string& which,
                                                 metamer::worker::Link& link) {
  metamer::sandbox::confine_driver();
  setenv("MESA_SHADER_CACHE_DISABLE", "1", 0);  // Programs are kept in memory; no files in $HOME.
  auto device = metamer::gl::Device::create(which);
  if (!device) {
    say_failed(device.error().message, link);
    return nullptr;
  }
  device->context().release();
  return std::make_unique<metamer::gl::Device>(std::move(*device));
}

/// What is known of this machine before it can't be read any more.
metamer::v1::MachineRecord describe_machine(const metamer::Backend& backend,
                                            metamer::cpu::Isa isa) {
  metamer::v1::MachineRecord machine;
  machine.set_name(metamer::host_name());
  machine.set_cpu(metamer::processor_name());
  metamer::v1::Capabilities capabilities;
  backend.describe(capabilities);
  machine.set_gpu(capabilities.gl().renderer());
  machine.set_isa(metamer::cpu::name_of(isa));
  machine.set_lanes(metamer::cpu::packet_rays(isa));
  return machine;
}

/// Exit codes: 0 the daemon is gone, 1 this machine or this daemon can't run it, 2 usage.
int run(metamer::worker::WorkerOptions options, const std::string& gl_device,
        const std::string& isa, bool unconfined) {
#ifdef __AVX2__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::fprintf(stderr, "metamer-worker: this processor lacks AVX2 and FMA\n");
    return 1;
  }
#endif
  // Before there is a thread, and before anything is open that a file's reader has no use for.
  const auto importer = metamer::import::Importer::start(options.store);
  if (!importer) {
    std::perror("metamer-worker: can't start the importer");
    return 1;
  }
  options.importer = importer.get();
  if (isa == "avx2") metamer::cpu::keep_embree_to(isa);
  metamer::worker::end_when_out_of_memory();
  metamer::worker::Link link(link_descriptor);
  options.tell_damage = [&link](const std::string& digest) {
    metamer::v1::WorkerEnvelope message;
    message.mutable_asset_damaged()->set_sha256(digest);
    link.send(message);
  };
  std::unique_ptr<metamer::gl::Device> device;
  std::unique_ptr<metamer::Backend> backend;
  const auto chosen = metamer::cpu::choose_isa(isa);
  if (!chosen) {
    say_failed(chosen.error().message, link);
    return 1;
  }
  if (gl_device.empty()) {
    backend = metamer::cpu::make_backend(options.threads, *chosen);
  } else {
    device = open_device(gl_device, link);
    if (!device) return 1;
    backend = metamer::gl::make_backend(*device, options.threads);
  }
  options.backend = backend.get();
  options.machine = describe_machine(*backend, *chosen);
  const metamer::sandbox::Confinement confinement =
      metamer::sandbox::enter(options.store, metamer::sandbox::open_devices(film_descriptor));
  if (!confinement.lacks.empty() && !unconfined) {
    say_failed("the system can't confine a worker (" + confinement.lacks +
                   "); metamerd --unconfined starts it all the same",
               link);
    return 1;
  }
  metamer::worker::Work work = 0;
  std::atomic<bool> busy = false;

  metamer::v1::WorkerEnvelope ready;
  *ready.mutable_ready()->mutable_capabilities() = metamer::worker::capabilities(
      options, {{"cpu", metamer::cpu::features}, {"gl", metamer::gl::features}});
  ready.mutable_ready()->set_sandbox(metamer::sandbox::describe(confinement));
  ready.mutable_ready()->set_isa(options.machine.isa());
  ready.mutable_ready()->set_lanes(options.machine.lanes());
  if (!link.send(ready)) return 0;

  const metamer::worker::Heartbeat heartbeat(link, work, busy);
  metamer::worker::Lane lane(options, link, work, busy);
  while (const auto message = link.receive())
    if (!lane.take(*message)) {
      std::fprintf(stderr, "metamer-worker: unexpected message from the daemon\n");
      std::_Exit(1);
    }
  // Not even the step that runs is waited for.
  std::_Exit(0);
}

}  // namespace

int main(int count, char** arguments) {
  metamer::worker::WorkerOptions options{
      .store = {}, .threads = 0, .backend = nullptr, .film_descriptor = film_descriptor};
  std::string gl_device, order, isa = "native";
  bool unconfined = false;
  if (const char* word = std::getenv("METAMER_ISA"); word != nullptr && *word != '\0') isa = word;
  for (int i = 1; i + 1 < count; i += 2) {
    if (std::strcmp(arguments[i], "--store") == 0) options.store = arguments[i + 1];
    if (std::strcmp(arguments[i], "--batch") == 0) order = arguments[i + 1];
    if (std::strcmp(arguments[i], "--gl-device") == 0) gl_device = arguments[i + 1];
    if (std::strcmp(arguments[i], "--group") == 0) enter_group(arguments[i + 1]);
    if (std::strcmp(arguments[i], "--unconfined") == 0) unconfined = true;
    if (std::strcmp(arguments[i], "--isa") == 0) isa = arguments[i + 1];
    // Before there is a thread or the importer, which are as nice as this.
    if (std::strcmp(arguments[i], "--nice") == 0 &&
        setpriority(PRIO_PROCESS, 0, std::atoi(arguments[i + 1])) != 0)
      std::perror("metamer-worker: --nice");
    if (std::strcmp(arguments[i], "--threads") == 0)
      options.threads = static_cast<unsigned>(std::strtoul(arguments[i + 1], nullptr, 10));
  }
  if (options.threads == 0) options.threads = std::max(1u, std::thread::hardware_concurrency());
  if (!order.empty())
    return metamer::batch::run_batch({.order = order,
                                      .program = std::filesystem::canonical("/proc/self/exe"),
                                      .threads = options.threads,
                                      .unconfined = unconfined,
                                      .gl_device = gl_device});
  if (options.store.empty() || fcntl(link_descriptor, F_GETFD) < 0 ||
      fcntl(film_descriptor, F_GETFD) < 0) {
    std::fputs(usage, stderr);
    return 2;
  }
  // Without a daemon there is nothing to save and nobody to wait for: leave without the libraries'
  // farewells. (A leak checker would hang in its own: the sandbox keeps it from looking at
  // threads.)
  std::_Exit(run(options, gl_device, isa, unconfined));
}
