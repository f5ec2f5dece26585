#include "client/gui/jobs/job_words.h"

#include <QCoreApplication>
#include <algorithm>

#include "client/session/problems.h"
#include "client/tools/text/job_text.h"
#include "client/tools/text/promise_text.h"
#include "common/printable.h"
#include "common/scene/feature_sets.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

QString job_words(const char* text) { return QCoreApplication::translate("Jobs", text); }

QString three_digits(double value) { return QString::number(value, 'g', 3); }

}  // namespace

QString seconds_text(double seconds) {
  return job_words("%1 s").arg(QString::number(seconds, 'f', 3));
}

QList<std::pair<QString, double>> timing_rows(const v1::Timing& timing) {
  QList<std::pair<QString, double>> rows;
  const auto add = [&](const char* name, double seconds) {
    if (seconds > 0) rows.append({job_words(name), seconds});
  };
  add("queued", timing.queued());
  add("reading", timing.compile());
  add("hierarchy", timing.acceleration());
  add("choosing a method", timing.pilot());
  add("tables", timing.prepare());
  add("rendering", timing.render());
  for (const v1::PassTime& pass : timing.pass())
    rows.append({job_words("  of it %1").arg(QString::fromStdString(printable(pass.name()))),
                 pass.seconds()});
  add("verifying", timing.verify());
  rows.append({job_words("in all"), timing.total()});
  return rows;
}

QString problem_line(const v1::Problem& problem) {
  return QString::fromStdString(printable(format(client::from_wire(problem))));
}

QString state_text(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kQueued:
      return event.queued().position() > 0
                 ? job_words("queued, %1 ahead").arg(event.queued().position())
                 : job_words("queued");
    case v1::JobEvent::kStarted:
      return job_words("started");
    case v1::JobEvent::kPreparing:
      return job_words("preparing: %1")
          .arg(QString::fromUtf8(client::word(event.preparing().stage())));
    case v1::JobEvent::kPaused:
      return job_words("paused");
    case v1::JobEvent::kRetrying:
      return job_words("once more: %1")
          .arg(QString::fromStdString(printable(event.retrying().reason())));
    case v1::JobEvent::kFailed:
      return job_words("failed: %1")
          .arg(QString::fromStdString(printable(event.failed().reason())));
    case v1::JobEvent::kCancelled:
      return job_words("cancelled");
    case v1::JobEvent::kFinished:
      return job_words("finished: %1")
          .arg(QString::fromStdString(client::describe(event.finished().timing())));
    case v1::JobEvent::kPlanned:
    case v1::JobEvent::kPrepared:
    case v1::JobEvent::kProgress:
    case v1::JobEvent::kTile:
    case v1::JobEvent::kPreview:
    case v1::JobEvent::EVENT_NOT_SET:
      return {};
  }
  return {};
}

std::optional<Promise> promise_of(const v1::Plan& plan, const v1::Finished& finished) {
  const std::optional<client::PromiseText> text = client::promise_text(plan, finished);
  if (!text) return std::nullopt;
  const v1::Goal& goal = plan.auto_();
  const QString error =
      job_words("ΔE00 at most %1").arg(three_digits(finished.accuracy().error().maximum()));
  QString measured;
  if (goal.has_tolerance())
    measured = job_words("%1; at most %2 was asked for").arg(error, three_digits(goal.tolerance()));
  else if (goal.has_deadline())
    measured =
        job_words("it took %1 s; %2 s were asked for; %3")
            .arg(three_digits(finished.timing().total()), three_digits(goal.deadline()), error);
  else
    measured = error;
  const QString headline = !plan.has_auto_() ? job_words("✓ verified: %1")
                           : text->kept      ? job_words("✓ promise kept: %1")
                                             : job_words("✗ promise broken: %1");
  return Promise{.kept = text->kept,
                 .text = headline.arg(measured),
                 .detail = QString::fromStdString(text->text)};
}

std::optional<QString> no_factors(const v1::Scene& scene, const v1::Capabilities& capabilities) {
  const v1::Settings full = with_defaults(scene.settings());
  if (!has_feature(capabilities, full.backend(), Feature::factors))
    return job_words(
               "No factors are kept, for the %1 backend has none: other light is traced anew.")
        .arg(QString::fromStdString(name_of(full.backend())).toUpper());
  // At most a pair of signature and weight (8 bytes) for each sample and light.
  const double most =
      8.0 * full.width() * full.height() * full.spp() * std::max(1, scene.light_size());
  if (most > most_factor_bytes)
    return job_words("No factors are kept, as they could take %1 GiB: other light is traced anew.")
        .arg(QString::number(most / (1024.0 * 1024 * 1024), 'f', 1));
  return std::nullopt;
}

}  // namespace metamer::gui
