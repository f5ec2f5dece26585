#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "metamer/v1/envelope.pb.h"

/// A real server with what a test wants to go wrong on the way. This header knows no Asio.
namespace metamer::gui {

/// Starts a metamerd, listens before it and passes on what each side says. Its hooks are called on
/// a thread of its own; set them before anybody connects.
class Relay {
 public:
  Relay();
  ~Relay();
  std::string address() const;

  /// Each answer comes so much later; those that follow each other at once do so still.
  std::atomic<std::chrono::milliseconds> delay{std::chrono::milliseconds(0)};
  /// What is answered in the server's place; nothing: the request is passed on.
  std::function<std::optional<v1::Envelope>(const v1::Envelope& request)> on_request;
  /// Whether an answer is passed on; else the connection is cut in its place.
  std::function<bool(const v1::Envelope& answer)> on_answer;
  /// Cuts all connections, and each that comes while `refuses`.
  void cut();
  std::atomic<bool> refuses{false};

  /// How often a request came.
  int count(v1::Envelope::BodyCase body) const { return counts_[body]; }

 private:
  struct State;
  std::vector<std::atomic<int>> counts_;
  std::unique_ptr<State> state_;
};

}  // namespace metamer::gui
