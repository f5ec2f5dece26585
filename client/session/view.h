#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "client/session/session.h"

namespace metamer::client {

/// A scene that is looked at and changed: frames as this side asks for them. Its session must
/// outlive it; on the server it lives until close(), or as long as the session.
class View {
 public:
  /// Sends what the server lacks, opens the view and waits for its plan. Errors: input for what is
  /// wrong with the scene, refused for anything else.
  static boost::asio::awaitable<Answer<std::unique_ptr<View>>> open(Session& session,
                                                                    const Submission& submission);
  ~View();

  /// What is shown and how, as the newest change has it.
  const v1::Plan& plan() const { return plan_; }

  /// Changes what is seen; `view_id` is filled in, and `files` are sent as far as the server lacks
  /// them, by the names that the change has for them. What the server thinks of it comes by next().
  boost::asio::awaitable<Answer<void>> update(v1::UpdateView change,
                                              const std::vector<Upload>& files = {});
  /// Asks for one frame more; at most two may be asked for and not yet here.
  boost::asio::awaitable<void> ask();

  struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< Row by row from the top, as the scene's development says.
    v1::Frame frame;
  };
  /// The next frame that was asked for. Errors: input, with its problems, for a change that was
  /// refused (the view goes on as it was); any other means that the view is lost.
  boost::asio::awaitable<Answer<Picture>> next();

  /// Returns when the server has forgotten it. Errors: the connection is lost.
  boost::asio::awaitable<Answer<void>> close();

 private:
  View(Session& session, std::unique_ptr<Session::Exchange> exchange);

  boost::asio::awaitable<void> send(v1::Envelope request);

  Session& session_;
  std::unique_ptr<Session::Exchange> exchange_;
  std::uint64_t id_ = 0;
  v1::Plan plan_;
  Picture picture_;  ///< Whose bands are coming.
};

}  // namespace metamer::client
