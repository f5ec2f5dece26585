#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "client/session/hub.h"
#include "client/session/scene_change.h"
#include "client/session/view.h"

namespace metamer::client {

/// A view that is kept going on its session's thread: changes are gathered and sent one at a time,
/// frames are asked for as they are taken, and not at all once the picture is complete. Where the
/// server loses the view's worker it is opened anew with all that it was told, RestartLimit's
/// number of times; so it is for another scene where the server is too old to replace one.
class LiveView : public std::enable_shared_from_this<LiveView> {
 public:
  LiveView(boost::asio::any_io_executor executor, Submission submission, ViewHooks hooks);

  /// Opens the view and draws until close() or a loss. The session outlives it.
  boost::asio::awaitable<void> run(Session& session);
  /// There is no session, or no longer one: says so, once.
  void lose(const SessionError& error);

  void change(SceneChange change);
  void taken();
  void probe(const ViewPlace& place);
  void want_xyz(bool wanted);
  void pause(bool paused);
  void close();

  static constexpr int most_frames = 2;  ///< Asked for, or given away and not yet taken.

 private:
  boost::asio::awaitable<void> draw();
  boost::asio::awaitable<void> send_pending();
  boost::asio::awaitable<void> send(SceneChange change);
  boost::asio::awaitable<void> send_probes();
  boost::asio::awaitable<void> show_next();
  boost::asio::awaitable<void> close_view(std::shared_ptr<View> view);
  boost::asio::awaitable<void> watch_over(std::shared_ptr<View> view);
  void begin(std::unique_ptr<View> view);
  void end_view();
  void refuse(const SessionError& error);
  void accept();
  bool is_too_old() const { return !replaces_ && !sending_ && pending_.scene; }
  bool wants_frame() const;
  void wake();

  ViewHooks hooks_;
  boost::asio::steady_timer signal_;
  std::shared_ptr<View> view_;  ///< Coroutines that use it hold it.
  /// As the server has it: the scene, then what was told of it since.
  Submission scene_;
  SceneChange since_;
  SceneChange sent_;     ///< Under way.
  SceneChange pending_;  ///< Not sent yet.
  bool sending_ = false, paused_ = false, complete_ = false;
  bool closing_ = false;  ///< For good.
  bool ending_ = false;   ///< The view that there is now.
  bool replaces_ = true;  ///< Until the server shows that it does not.
  bool xyz_ = false, xyz_due_ = false;
  std::uint64_t revision_ = 0;  ///< Sent last.
  std::deque<bool> asked_;      ///< Frames that are to come: whether with X Y Z.
  int waiting_ = 0;
  std::optional<ViewPlace> place_;  ///< To be probed next.
  bool probing_ = false;
};

}  // namespace metamer::client
