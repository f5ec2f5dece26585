#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "server/worker/view.h"
#include "server/worker/view_turns.h"

namespace metamer::worker {

/// All views of a worker. They have turns with each other and with the job: a frame each, or as
/// much of it as a turn's time allows.
class Views : public ViewTurns {
 public:
  /// `wake` is called from any thread when there is something to serve.
  Views(const WorkerOptions& options, Link& link, Work& work, std::function<void()> wake);
  ~Views() override;

  /// Keeps a message for the next turn; from any thread. False: it is not about views.
  bool take(const v1::WorkerEnvelope& message);

  bool waiting() const override { return waiting_; }
  /// Carries out what has come, then gives each view its turn.
  void serve() override;
  void serve_while(const std::function<void()>& work) override;

  /// A view's scene is being imported.
  bool importing() const { return importing_; }

 private:
  void carry_out(const v1::WorkerEnvelope& message);
  void call();

  const WorkerOptions& options_;
  Link& link_;
  Work& work_;
  std::function<void()> wake_;
  std::atomic<bool> waiting_ = false, importing_ = false;
  std::mutex mutex_;
  std::condition_variable called_;
  bool called_since_ = false;  ///< Since serve() began.
  std::vector<v1::WorkerEnvelope> messages_;
  // Of the lane's thread:
  std::map<std::uint64_t, std::unique_ptr<View>> views_;
  std::vector<std::unique_ptr<View>> closed_;  ///< Whose imports have not ended yet.
  bool aside_ = false;                         ///< Work of the job is done meanwhile.
};

}  // namespace metamer::worker
