#include "server/service/executors/worker_process.h"

#include <gtest/gtest.h>

#include <new>
#include <optional>

#include "server/service/ops/folders.h"

namespace metamer::service {

namespace {

namespace asio = boost::asio;

/// How the fake worker ends whose first message is handled by `message`.
std::string end_of_worker(const std::function<void(v1::WorkerEnvelope)>& message) {
  const TemporaryFolder folder = TemporaryFolder::make().value();
  asio::io_context context;
  WorkerCommand command;
  command.program = METAMER_BIN "/metamer-fake-worker";
  command.store = folder.path() / "store";
  std::string end;
  auto worker = WorkerProcess::spawn(context.get_executor(), command,
                                     {message, [&](std::string reason) { end = reason; }});
  EXPECT_TRUE(worker);
  context.run();
  return end;
}

}  // namespace

TEST(WorkerProcess, AMessageThatTakesTooMuchMemoryEndsItsWorkerAndNothingElse) {
  EXPECT_EQ(end_of_worker([](const v1::WorkerEnvelope&) { throw std::bad_alloc(); }),
            "sent a message that could not be handled: std::bad_alloc");
}

TEST(WorkerProcess, AnyOtherExceptionToo) {
  EXPECT_EQ(end_of_worker([](const v1::WorkerEnvelope&) { std::optional<int>().value(); }),
            "sent a message that could not be handled: bad optional access");
}

}  // namespace metamer::service
