#include "client/cli/commands/series/follow_series.h"

#include <chrono>

#include "client/session/problems.h"
#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"
#include "client/tools/text/promise_text.h"
#include "common/printable.h"

namespace metamer::cli {
namespace {

using client::SeriesCounts;
using Clock = std::chrono::steady_clock;

std::string counts_text(const SeriesCounts& counts, const std::string& noun, double seconds) {
  std::string text = client::formatted("%u/%u ", counts.done, counts.count) + noun;
  if (counts.submitted > 0) text += client::formatted(", %u submitted", counts.submitted);
  if (counts.failed > 0) text += client::formatted(", %u failed", counts.failed);
  if (counts.cancelled > 0) text += client::formatted(", %u cancelled", counts.cancelled);
  // Before the first has ended nobody knows what one takes.
  if (counts.done > 0 && counts.share > 0)
    text += "  " + client::clock(seconds * (1 - counts.share) / counts.share) + " left";
  return text;
}

/// What was measured of a picture, and whether that is what was promised.
std::optional<client::PromiseText> measured(const SeriesPart& part) {
  if (!part.record || !part.record->plan || !part.record->last.has_finished()) return std::nullopt;
  return client::promise_text(*part.record->plan, part.record->last.finished());
}

}  // namespace

std::string failure_of(const client::SeriesEnd& end) {
  const auto text_of = [](const Problem& problem) {
    return printable((problem.field.empty() ? "" : problem.field + ": ") + problem.message);
  };
  if (!end) return text_of(end.error());
  const v1::JobEvent& last = end->last;
  if (last.has_finished()) return {};
  if (!last.has_failed()) return "cancelled";
  std::string text = printable(last.failed().reason());
  for (const Problem& problem : client::from_wire(last.failed().problem()))
    text += (text.empty() ? "" : "; ") + text_of(problem);
  return text.empty() ? "the job failed" : text;
}

boost::asio::awaitable<ExitCode> follow_series(Session& session, Interrupts& interrupts,
                                               const SeriesPlan& plan, const TakePart& take,
                                               Report& report) {
  const auto start = Clock::now();
  ProgressView view;
  bool promises_kept = true;
  client::SeriesCalls calls;
  calls.make = plan.make;
  calls.label = plan.label;
  calls.ended = [&](std::uint32_t index, client::SeriesEnd end) {
    SeriesPart part{.index = index,
                    .label = plan.label(index),
                    .failure = failure_of(end),
                    .record = std::nullopt};
    if (end) part.record = std::move(*end);
    if (const auto promise = measured(part)) {
      promises_kept = promises_kept && promise->kept;
      view.line(part.label + ": " + (promise->kept ? "" : "the promise is broken by ") +
                promise->text);
    }
    if (!part.failure.empty()) view.line(part.label + ": " + part.failure);
    take(std::move(part), view);
  };
  calls.progress = [&](const SeriesCounts& counts) {
    view.show(counts.share,
              counts_text(counts, plan.noun,
                          std::chrono::duration<double>(Clock::now() - start).count()));
  };

  client::SeriesRun run(session, plan.jobs, calls);
  interrupts.on_first([&] {
    view.line("cancelling; press Ctrl-C again to leave at once");
    run.cancel();
  });
  Answer<SeriesCounts> counts = co_await run.run();
  interrupts.on_first({});
  if (!counts) {
    const ExitCode code = report.session_error(counts.error());
    view.line("what was submitted goes on there: metamer jobs --series " +
              client::series_handle(plan.jobs.id));
    co_return code;
  }
  Json& series = report.document()["series"];
  series = {{"handle", client::series_handle(plan.jobs.id)},
            {"name", plan.jobs.name},
            {"count", counts->count},
            {"done", counts->done},
            {"failed", counts->failed},
            {"cancelled", counts->cancelled}};
  if (run.cancelled()) {
    report.error("cancelled");
    co_return ExitCode::cancelled;
  }
  if (counts->failed == 0) co_return promises_kept ? ExitCode::done : ExitCode::promise_broken;
  report.error(client::formatted("%u of %u ", counts->failed, counts->count) + plan.noun +
               " failed");
  co_return ExitCode::job_failed;
}

}  // namespace metamer::cli
