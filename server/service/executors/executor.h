#pragma once

#include <boost/asio.hpp>
#include <cstdint>

#include "metamer/v1/session.pb.h"
#include "metamer/v1/worker.pb.h"
#include "server/service/jobs/job.h"
#include "server/service/views/view.h"

namespace metamer::service {

namespace asio = boost::asio;

/// What renders a backend's jobs: it takes them from the queue, has tiles of their plans drawn
/// somewhere, and puts these into the jobs. The rest of the service knows no more of it, neither
/// processes nor machines. On the service's one thread; no call blocks.
///
/// Where it draws is its own: `Supervisor` has a process of this machine beside it, which sends
/// tile by tile. One whose workers are elsewhere hands out ranges of tiles and takes whole results,
/// by `TileRanges`.
class Executor {
 public:
  Executor() = default;
  Executor(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Gets ready. Without it the first job has it do so.
  virtual void start() = 0;
  /// Ends what it has running, and begins nothing more.
  virtual void stop() = 0;

  /// Takes the next job if it has room for one. To be called when the queue has grown.
  virtual void work() = 0;
  /// Says that `job` was cancelled or paused: it is stopped if it is here, and its tiles that come
  /// later are dropped.
  virtual void interrupt(const Job& job) = 0;
  /// Charges the jobs that it has with the time up to now (JobQueue::spend).
  virtual void charge_job() = 0;

  /// What clients may ask of it; empty until it knows.
  virtual const v1::Capabilities& capabilities() const = 0;
  /// Waits until that is known, or is not to be had.
  virtual asio::awaitable<void> wait_for_capabilities() = 0;
  virtual v1::WorkerInfo info() const = 0;
  /// Of workers, that ended by themselves or for what they did.
  virtual std::uint32_t losses() const = 0;
};

/// What draws views: frames are waited for, so this is always a process of this machine.
class ViewHost {
 public:
  ViewHost() = default;
  ViewHost(const ViewHost&) = delete;
  virtual ~ViewHost() = default;

  /// Opens a view in the worker, which is started if need be.
  virtual void open(const View& view) = 0;
  /// Tells the worker what concerns a view. Without a worker it is lost, and the view too.
  virtual void tell(v1::WorkerEnvelope message) = 0;
};

}  // namespace metamer::service
