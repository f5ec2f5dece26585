#include "server/batch/batch.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/program/machine.h"
#include "common/wire/batch_file.h"
#include "common/wire/worker_program.h"
#include "server/batch/task.h"

namespace metamer::batch {
namespace {

int fail_batch(const std::string& message) {
  std::fprintf(stderr, "metamer-worker: %s\n", message.c_str());
  return 1;
}

std::string node_name() {
  // Several nodes of a test are one machine.
  const char* const slurm = std::getenv("SLURMD_NODENAME");
  return slurm ? slurm : host_name();
}

/// What the worker has said of its part, by the node's own name.
void move_record(v1::BatchResult& result) {
  if (!result.done().has_record()) return;
  *result.mutable_record() = std::move(*result.mutable_done()->mutable_record());
  result.mutable_done()->clear_record();
  for (v1::MachineRecord& machine : *result.mutable_record()->mutable_machine())
    machine.set_name(result.node());
}

v1::BatchResult carry_out(const v1::BatchOrder& order, const BatchOptions& options) {
  v1::BatchResult result;
  result.set_job_id(order.job_id());
  result.set_attempt(order.attempt());
  result.set_first(order.first());
  const auto lost = [&](const std::string& why) {
    result.set_lost(why);
    return result;
  };
  if (!order.build().empty() && wire::digest_of_program(options.program) != order.build())
    return lost(options.program.string() + " is not the server's metamer-worker");
  auto worker = OwnWorker::start({.program = options.program,
                                  .store = order.assets(),
                                  .threads = options.threads,
                                  .unconfined = options.unconfined,
                                  .gl_device = options.gl_device});
  if (!worker) return lost(worker.error().message);
  return Task(order, *worker).run(options.threads);
}

}  // namespace

int run_batch(const BatchOptions& options) {
  const auto order = wire::read_batch_order(options.order);
  if (!order) return fail_batch(order.error().message);
  v1::BatchResult result = carry_out(*order, options);
  result.set_node(node_name());
  result.set_cpu(processor_name());
  move_record(result);
  if (!result.lost().empty()) (void)fail_batch(result.lost());
  const auto written = wire::write_batch_file(order->result(), result);
  return written ? 0 : fail_batch(written.error().message);
}

}  // namespace metamer::batch
