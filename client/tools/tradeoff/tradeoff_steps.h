#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/session/job_record.h"
#include "client/session/submission.h"
#include "client/tools/tradeoff/tradeoff.h"
#include "common/image/image.h"
#include "common/scene/scene_file.h"

/// The jobs of a trade, one after the other, and what comes of them; who sends and watches them is
/// the caller's business, in whatever thread.
namespace metamer::client {

/// A sound scene, whose settings name no method that would count.
struct TradeoffScene {
  const v1::Scene& scene;
  const std::vector<Asset>& assets;
  std::string name;
};

/// Why a run came to no end.
struct TradeoffStop {
  enum class Kind {
    session,    ///< `error` says why.
    cancelled,  ///< One of its jobs was.
    reference,  ///< It can't be rendered: problem.message says why.
    picture,    ///< `problem`, by `measured`, or pictures that do not compare.
  };
  Kind kind = Kind::cancelled;
  SessionError error = {};
  Problem problem = {};
};

/// A row was measured in its first round; the picture is its difference from the reference, drawn
/// by false_color. An error ends the run.
using TradeoffMeasured = std::function<Result<void>(const TradeoffRow& row, const Image&)>;

class TradeoffSteps {
 public:
  /// Every case `rounds` times, 1 or more. `scene` outlives this; without `measured` no differences
  /// are drawn.
  TradeoffSteps(const TradeoffScene& scene, unsigned rounds, TradeoffMeasured measured = {});

  /// The job that is due: the reference first, which also warms the worker up, then the cases round
  /// by round. Nothing: all are done.
  std::optional<Submission> next() const;
  /// The server refused it: its row has the reason. An error ends the run.
  tl::expected<void, TradeoffStop> refused(const std::string& why);
  /// It ended; its picture was kept. Compares it with the reference, which takes a while. An error
  /// ends the run.
  tl::expected<void, TradeoffStop> ended(const JobRecord& job);

  /// From 1 on; 0: that of the reference.
  unsigned round() const { return round_; }
  unsigned jobs_done() const;
  unsigned jobs() const;
  /// The method of the job that is due.
  std::string due() const;
  /// The rows of the first rounds so far, and the front, once all are done.
  const Tradeoff& so_far() const { return tradeoff_; }

 private:
  bool is_done() const { return round_ > tradeoff_.rounds; }
  tl::expected<void, TradeoffStop> end_reference(const JobRecord& job);
  tl::expected<void, TradeoffStop> fail(const std::string& why);
  void go_on();

  TradeoffScene scene_;
  TradeoffMeasured measured_;
  Tradeoff tradeoff_;
  std::optional<Image> reference_;
  unsigned round_ = 0;
  std::size_t row_ = 0;  ///< Of the round's.
};

/// A perfect white that faces the dominant light, of the light's luminance. Nothing where the plan
/// has no white of it.
std::optional<Xyz> lit_white(const v1::Plan& plan, const v1::Scene& scene);

}  // namespace metamer::client
