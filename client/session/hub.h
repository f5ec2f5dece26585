#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "client/session/error.h"
#include "client/session/job_handle.h"
#include "client/session/job_record.h"
#include "client/session/submission.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/session.pb.h"
#include "metamer/v1/views.pb.h"

/// A session for programs that have a loop of their own, a window first of all: kept up on a thread
/// of its own, and made anew where it is lost. This header knows no Asio.
///
/// What is asked of it may be asked from any thread, and never waits. What it says it says on its
/// own thread, by the functions that it was given, which must not wait either; where there is no
/// session they get the error `disconnected`.
namespace metamer::client {

/// How things stand with the server.
struct LinkStatus {
  enum class Kind { connecting, ready, lost };
  Kind kind = Kind::connecting;
  std::string server;        ///< As it was named; empty: a private one.
  SessionError error = {};   ///< Of lost.
  double retry_in = 0;       ///< Of lost: seconds until it is tried again; below 0: it is not.
  double slow = 0;           ///< Of ready: seconds of its last answer, where that took slow_answer.
  v1::Welcome welcome = {};  ///< Of ready.
};

/// Seconds from which on a server is told to be slow: while its answer is due, `slow` is this.
inline constexpr double slow_answer = 0.3;

/// Seconds to wait before the n-th try to connect again, from 0: 1, 2, 4 … 30.
double retry_delay(unsigned failures);

/// A frame of a view.
struct ViewFrame {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< Row by row from the top, as the scene's development says.
  std::vector<float> xyz;         ///< Of complete frames, where they were asked for.
  bool newest = false;            ///< It shows all that the view was told.
  v1::Frame frame;
  v1::Plan plan;  ///< What is shown and how.
};

/// The jobs that a server shows.
struct ServerJobs {
  std::string server;  ///< As JobHandle::server.
  v1::JobList list;
};

/// A square of pixels of a complete frame: its side, 1 to 64, and its middle, from the upper left.
struct ViewPlace {
  std::uint32_t x = 0, y = 0, side = 1;
};

/// What is said of a view. `lost` is the last.
struct ViewHooks {
  std::function<void(const v1::Plan&)> opened;
  std::function<void(ViewFrame)> frame;
  /// A change that the server does not take, with its problems; the view is as it was.
  std::function<void(const SessionError&)> refused;
  /// The server lost what drew it: the view is opened anew, with all that it was told.
  std::function<void(const SessionError&)> interrupted;
  std::function<void(const SessionError&)> lost;
  /// What is at a place that was asked for. Error, refused: the place lies outside, or the server
  /// knows no probes (its code is UNKNOWN_MESSAGE).
  std::function<void(const ViewPlace&, Answer<v1::Probed>)> probed;
};

/// A view that is kept going: it asks for frames as long as there is something new to see and those
/// that came are taken. Closes when the last owner lets go; does nothing once the hub is gone. Used
/// on the thread that ends the hub.
class HubView {
 public:
  virtual ~HubView() = default;
  /// Something else is to be seen. Changes are gathered while one is under way, the newest of each
  /// kind wins; the revision is filled in.
  virtual void change(v1::UpdateView change, std::vector<Upload> files = {}) = 0;
  /// Another scene in the place of the whole; what is the same in both the server keeps, as far as
  /// it can. The backend stays.
  virtual void replace(Submission scene) = 0;
  /// A frame was shown: another may come. At most two are on their way.
  virtual void taken() = 0;
  /// Asks what is at a place: one question is under way at a time, and of those that come meanwhile
  /// the newest is asked next.
  virtual void probe(const ViewPlace& place) = 0;
  /// Whether complete frames bring their X Y Z.
  virtual void want_xyz(bool wanted) = 0;
  /// Stops asking for frames, until it is false.
  virtual void pause(bool paused) = 0;
};

class SessionHub {
 public:
  template <class T>
  using Done = std::function<void(Answer<T>)>;
  enum class Order { cancel, pause, resume };

  explicit SessionHub(std::function<void(const LinkStatus&)> on_status);
  /// Waits for its thread, and with a private server for its end (PrivateServer::stop_time_limit).
  ~SessionHub();

  /// Leaves the session that there is and connects to another server; "": starts a private one.
  /// A session that is lost is made anew, but where the server speaks another version; a private
  /// server is started anew at once, RestartLimit's number of times.
  void open(std::string server);
  /// Connects now, also where it was not to be tried again.
  void retry_now();
  /// Leaves the session that there is, or the try to make one.
  void stop();

  void info(Done<v1::Info> done);
  void list(Done<ServerJobs> done);
  /// Error, input: the session that there is now is with another server than the job's.
  void control(Order order, JobHandle job, Done<v1::JobSummary> done);
  void submit(Submission submission, Done<JobHandle> done);

  /// Watches a job from its first event: each goes to `on_event` before it is recorded, the record
  /// to `done`. `stop` ends it early, without a last event in the record. Where the session is lost
  /// it goes on with the next event in the next session with that server; where another one stands
  /// there by then, the job's numbers are not asked of it.
  void record(JobHandle job, JobParts parts, std::stop_token stop,
              std::function<void(const v1::JobEvent&)> on_event, Done<JobRecord> done);

  std::shared_ptr<HubView> view(Submission submission, ViewHooks hooks);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace metamer::client
