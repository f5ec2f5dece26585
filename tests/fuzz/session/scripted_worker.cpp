#include "scripted_worker.h"

#include <sys/mman.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "worker_script.h"

namespace metamer::fuzz {

namespace {

using service::WorkerProcess;

Start start_as = Start::works;
std::map<WorkerProcess*, Worker> workers;

/// Of one that is ended, or ends by itself.
void report_if_over(WorkerProcess* process) {
  const auto found = workers.find(process);
  if (found == workers.end()) return;
  const Worker& worker = found->second;
  if (worker.killed_for.empty() && !worker.dies) return;
  const std::string reason = worker.dies ? "crashed" : worker.killed_for;
  const auto exit = worker.handlers.exit;
  workers.erase(found);
  if (exit) exit(reason);
}

/// Says what there is to say.
void say(WorkerProcess* process) {
  while (true) {
    const auto found = workers.find(process);
    if (found == workers.end()) return;
    Worker& worker = found->second;
    if (worker.says.empty() || !worker.killed_for.empty()) break;
    const v1::WorkerEnvelope message = std::move(worker.says.front());
    worker.says.pop_front();
    const auto hear = worker.handlers.message;
    try {
      if (hear) hear(message);
    } catch (const std::exception& exception) {
      process->kill(exception.what());
    }
  }
  report_if_over(process);
}

/// Does something to those that run now: each may end, and another start, meanwhile.
template <class Do>
void for_each_worker(const Do& act) {
  std::vector<std::shared_ptr<WorkerProcess>> all;
  for (auto& [process, worker] : workers)
    if (auto shared = process->weak_from_this().lock()) all.push_back(std::move(shared));
  for (const auto& process : all)
    if (const auto found = workers.find(process.get()); found != workers.end()) {
      act(found->second);
      say(process.get());
    }
}

}  // namespace

void set_start(Start start) { start_as = start; }
std::size_t count_workers() { return workers.size(); }
void forget_scripts() {
  start_as = Start::works;
  forget_attempts();
}

void let_workers_work(unsigned things) {
  for (unsigned i = 0; i < things; ++i)
    for_each_worker([](Worker& worker) { work(worker, start_as != Start::never_ready); });
}

void let_workers_beat() {
  for_each_worker([](Worker& worker) {
    if (!worker.ready) return;
    v1::WorkerEnvelope& message = worker.says.emplace_back();
    message.mutable_heartbeat()->set_work(worker.work);
    message.mutable_heartbeat()->set_busy(worker.rendering);
  });
}

void let_workers_say(const v1::WorkerEnvelope& message) {
  for_each_worker([&](Worker& worker) {
    v1::WorkerEnvelope& said = worker.says.emplace_back(message);
    if (said.job_id() == 0) said.set_job_id(worker.job);
  });
}

void end_workers() {
  for_each_worker([](Worker& worker) { worker.dies = true; });
}

}  // namespace metamer::fuzz

namespace metamer::service {

namespace {

/// The state of one, while it runs.
fuzz::Worker* state_of(const WorkerProcess* process) {
  const auto found = fuzz::workers.find(const_cast<WorkerProcess*>(process));
  return found == fuzz::workers.end() ? nullptr : &found->second;
}

}  // namespace

WorkerProcess::WorkerProcess(pid_t pid, asio::posix::stream_descriptor exit, int film,
                             wire::Socket socket, Handlers handlers)
    : pid_(pid),
      film_(film),
      exit_(std::move(exit)),
      channel_(std::move(socket), wire::Peer::worker),
      handlers_(std::move(handlers)),
      unsent_signal_(channel_.executor()),
      grace_(channel_.executor()) {}

WorkerProcess::~WorkerProcess() {
  abandon();
  unmap_film();
}

tl::expected<std::shared_ptr<WorkerProcess>, WorkerProcess::SpawnError> WorkerProcess::spawn(
    const asio::any_io_executor& executor, const WorkerCommand& command, Handlers handlers) {
  if (fuzz::start_as == fuzz::Start::lacks_memory)
    return tl::unexpected(SpawnError{"there is no memory for it", true});
  if (fuzz::start_as == fuzz::Start::fails)
    return tl::unexpected(SpawnError{"there is no such program", false});
  // Under a number that no process has.
  auto process = std::shared_ptr<WorkerProcess>(
      new WorkerProcess(std::numeric_limits<pid_t>::max(), asio::posix::stream_descriptor(executor),
                        -1, wire::Socket(executor), {}));
  fuzz::Worker& worker = fuzz::workers[process.get()];
  worker.command = command;
  worker.handlers = std::move(handlers);
  return process;
}

void WorkerProcess::send(v1::WorkerEnvelope message) {
  if (fuzz::Worker* worker = state_of(this)) worker->orders.push_back(std::move(message));
}

/// Black, and no memory until it is looked at.
bool WorkerProcess::size_film(std::uint64_t bytes) {
  release_film();
  void* const memory =
      ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return false;
  mapped_ = memory;
  mapped_bytes_ = bytes;
  return true;
}

void WorkerProcess::release_film() { unmap_film(); }

void WorkerProcess::unmap_film() {
  if (mapped_) ::munmap(std::exchange(mapped_, nullptr), mapped_bytes_);
}

bool WorkerProcess::write_film(std::uint64_t offset, const void*, std::size_t bytes) {
  return offset + bytes <= mapped_bytes_;
}

bool WorkerProcess::ran_out_of_memory(bool) const { return false; }

void WorkerProcess::kill(std::string reason) {
  if (fuzz::Worker* worker = state_of(this); worker && worker->killed_for.empty())
    worker->killed_for = std::move(reason);
}

void WorkerProcess::abandon() { fuzz::workers.erase(this); }

}  // namespace metamer::service
