#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "client/session/session.h"

namespace metamer::client {

/// A scene that is looked at and changed: frames as this side asks for them. Its session must
/// outlive it; on the server it lives until close(), or as long as the session. Its coroutines run
/// on the session's executor, and several may be under way at once: what is under a place can be
/// asked while a frame is waited for.
class View {
 public:
  /// Sends what the server lacks, opens the view and waits for its plan. Errors: input for what is
  /// wrong with the scene, refused for anything else.
  static boost::asio::awaitable<Answer<std::unique_ptr<View>>> open(Session& session,
                                                                    const Submission& submission);
  ~View();

  /// What is shown and how, as the newest change has it.
  const v1::Plan& plan() const { return plan_; }
  /// The newest change that was carried out, and the time that it took.
  const v1::ViewUpdated& updated() const { return updated_; }

  /// Changes what is seen; `view_id` is filled in, and `files` are sent as far as the server lacks
  /// them, by the names that the change has for them. What the server thinks of it comes by next().
  boost::asio::awaitable<Answer<void>> update(v1::UpdateView change,
                                              const std::vector<Upload>& files = {});
  /// Shows another scene in place of the whole, as update() does, with `change` to it; the backend
  /// stays. A server that is too old for that says that it has updated, without a plan.
  boost::asio::awaitable<Answer<void>> replace(const Submission& submission, std::uint64_t revision,
                                               v1::UpdateView change = {},
                                               const std::vector<Upload>& files = {});
  /// Asks for one frame more; at most two may be asked for and not yet here. `xyz`: once the frame
  /// is complete it has X Y Z, too.
  boost::asio::awaitable<void> ask(bool xyz = false);

  struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< Row by row from the top, as the scene's development says.
    std::vector<float> xyz;         ///< Of the same pixels; empty where they were not asked for.
    v1::Frame frame;
  };
  /// The next frame that was asked for. Errors: input, with its problems, for a change that was
  /// refused (the view goes on as it was); any other means that the view is lost.
  boost::asio::awaitable<Answer<Picture>> next();

  /// What is at a pixel of a complete frame, from the upper left, and the mean of the newest
  /// frame's X Y Z over a square of `side` pixels around it, 1 to 64. Errors, after which the view
  /// goes on: refused where the place lies outside, where the server knows no probes (its code is
  /// UNKNOWN_MESSAGE), or where newer ones took its turn. Any other means that the view is lost.
  boost::asio::awaitable<Answer<v1::Probed>> probe(std::uint32_t x, std::uint32_t y,
                                                   std::uint32_t side = 1);

  /// Why it is lost, its session or it alone; nothing: it goes on.
  const std::optional<SessionError>& lost() const { return lost_; }
  /// Returns when it is lost, though nobody waits for anything else.
  boost::asio::awaitable<void> until_lost();
  /// Whether it is lost with the process that drew it: it can be opened again.
  bool worker_lost() const { return worker_lost_; }

  /// Returns when the server has forgotten it. Errors: the connection is lost.
  boost::asio::awaitable<Answer<void>> close();

 private:
  View(Session& session, std::unique_ptr<Session::Exchange> exchange);

  boost::asio::awaitable<void> send(v1::Envelope request);
  boost::asio::awaitable<void> read_until(std::function<bool()> ready);
  void take(Answer<v1::Envelope> answer);
  void take_event(v1::ViewEvent& event);
  void take_band(const v1::FrameBand& band);
  void take_probed(v1::Probed probed);
  void lose(SessionError error);

  Session& session_;
  std::unique_ptr<Session::Exchange> exchange_;
  std::uint64_t id_ = 0;
  v1::Plan plan_;
  v1::ViewUpdated updated_;
  unsigned coming_ = 0;                  ///< Frames that were asked for.
  Picture picture_;                      ///< Whose bands are coming.
  std::deque<Answer<Picture>> arrived_;  ///< For next().
  std::map<std::uint64_t, std::optional<Answer<v1::Probed>>> probes_;  ///< Under way, by number.
  std::optional<SessionError> lost_;
  bool closed_ = false;  ///< By the server.
  bool worker_lost_ = false;
  bool reading_ = false;  ///< One coroutine reads for all;
  struct Changed;
  std::unique_ptr<Changed> changed_;  ///< the others wait for this.
};

}  // namespace metamer::client
