#include <filesystem>
#include <iostream>

#include "client/cli/commands.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"
#include "client/session/film.h"
#include "client/tools/text/job_text.h"
#include "common/image/image.h"

namespace metamer::cli {
namespace {

struct WatchOptions {
  CommonOptions common;
  std::string job;
  std::uint64_t from = 0;
  std::string preview;  ///< A .png that is kept up to date; empty: none.
};

/// Replaces the preview file; a picture that can't be written ends the watching.
Answer<void> write_preview(const v1::Preview& preview, const std::string& file) {
  const Answer<Image> image = preview_image(preview);
  if (!image) return tl::unexpected<SessionError>(image.error());
  const Result<GamutReport> written = write_image(*image, file, false, {});
  if (!written) return session_error(SessionError::Kind::input, format(written.error()));
  return {};
}

ExitCode end_code(const v1::JobEvent& last) {
  switch (last.event_case()) {
    case v1::JobEvent::kFinished:
      return ExitCode::done;
    case v1::JobEvent::kFailed:
      return ExitCode::job_failed;
    default:
      return ExitCode::cancelled;
  }
}

boost::asio::awaitable<ExitCode> watch_job(Session& session, std::uint64_t job_id,
                                           const WatchOptions& options, Report& report) {
  v1::Watch request;
  request.set_job_id(job_id);
  request.set_from_sequence(options.from);
  request.set_previews(!options.preview.empty());

  v1::JobEvent last;
  bool previewed = false;
  Session::OnEvent on_event = [&](const v1::JobEvent& event) -> Answer<void> {
    last = event;
    // The file stands before its line is told.
    if (event.has_preview()) {
      Answer<void> written = write_preview(event.preview(), options.preview);
      if (!written) return written;
      previewed = true;
    }
    if (options.common.json) {
      std::cout << event_json(event, session).dump(-1, ' ', false, Json::error_handler_t::replace)
                << std::endl;
    } else {
      report.line(describe(event));
    }
    return {};
  };
  const Answer<void> watched = co_await session.watch(request, on_event);
  if (!watched) co_return report.session_error(watched.error());
  if (!options.preview.empty() && !previewed) {
    Problem note;
    note.message = "the job sent no preview; metamer fetch gets its picture";
    report.note(note);
  }
  co_return end_code(last);
}

ExitCode run(const WatchOptions& options) {
  // Its lines are its documents: the last one says how the job ended.
  Report report(false);
  if (!options.preview.empty() && std::filesystem::path(options.preview).extension() != ".png") {
    report.error("--preview: \"" + options.preview + "\" does not end in .png");
    return ExitCode::bad_input;
  }
  return with_job(options.common, options.job, report, [&](Session& session, std::uint64_t job_id) {
    return watch_job(session, job_id, options, report);
  });
}

void declare(WatchOptions& values, Options& options) {
  declare_job(values.job, options);
  options.push_back(
      {.names = "--from", .target = &values.from, .meaning = "the first event's number"});
  options.push_back({.names = "--preview",
                     .target = &values.preview,
                     .meaning = "a .png that is kept up to date"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::watch() {
  return make_command<WatchOptions>("watch", "print a job's events until it ends", declare, run);
}

}  // namespace metamer::cli
