#include "client/gui/methods/methods_room.h"

#include <QFileDialog>
#include <utility>

#include "client/gui/jobs/job_words.h"
#include "client/gui/jobs/render_scene.h"
#include "client/gui/looks/look_command.h"
#include "client/gui/plot/plot_style.h"
#include "client/session/submission.h"
#include "client/tools/scene/look_change.h"
#include "common/printable.h"
#include "common/scene/methods.h"

namespace metamer::gui {
namespace {

constexpr int rest = 300;          // ms
constexpr int least_height = 340;  // pixels

/// Why an explanation came to nothing.
QString why_unexplained(const client::JobRecord& job) {
  QStringList lines{state_text(job.last)};
  for (const v1::Problem& problem : job.last.failed().problem()) lines << problem_line(problem);
  return lines.join(QStringLiteral("; "));
}

}  // namespace

MethodsRoom::MethodsRoom(MainWindow& window)
    : QObject(&window), window_(window), dock_(new MethodsDock) {
  frame_ = window.add_dock(QStringLiteral("methods"), MethodsDock::tr("Methods"), dock_,
                           Qt::BottomDockWidgetArea);
  frame_->hide();
  settled_.setSingleShot(true);
  settled_.setInterval(rest);
  connect(&settled_, &QTimer::timeout, this, &MethodsRoom::update);
  connect(frame_, &QDockWidget::visibilityChanged, this, &MethodsRoom::update);
  connect(dock_, &MethodsDock::explain_asked, this, &MethodsRoom::explain);
  connect(dock_, &MethodsDock::measure_asked, this, &MethodsRoom::measure);
  connect(dock_, &MethodsDock::save_asked, this, &MethodsRoom::save_as);
  connect(dock_, &MethodsDock::cancel_asked, this, [this] {
    if (measuring_ != nullptr) measuring_->cancel();
  });
  connect(dock_, &MethodsDock::method_asked, this, [this](const v1::Method& method) {
    v1::Settings wanted;
    *wanted.mutable_method() = asked_method(method);
    set_method(wanted, QString::fromStdString(method_text(method)));
  });
  connect(dock_, &MethodsDock::tolerance_asked, this, [this](double tolerance) {
    v1::Settings wanted;
    wanted.mutable_goal()->set_tolerance(tolerance);
    set_method(wanted, MethodsDock::tr("a tolerance of %1").arg(tolerance, 0, 'g', 3));
  });
  connect(&window, &MainWindow::document_chosen, this, &MethodsRoom::follow_document);
  connect(&window.pictures(), &QTabWidget::currentChanged, this, &MethodsRoom::follow_pages);
}

void MethodsRoom::show_dock() {
  const bool first = !frame_->isVisible();
  frame_->show();
  frame_->raise();
  // A plot wants more room than a list.
  if (first && frame_->height() < least_height)
    window_.resizeDocks({frame_}, {least_height}, Qt::Vertical);
}

void MethodsRoom::follow_document() {
  if (document_ == window_.document()) return;
  if (document_ != nullptr) document_->disconnect(this);
  if (live_ != nullptr) live_->disconnect(this);
  document_ = window_.document();
  live_ = window_.live();
  if (document_ != nullptr) {
    connect(document_, &Document::look_changed, this, &MethodsRoom::update);
    connect(document_, &Document::checked_changed, this, &MethodsRoom::update);
    connect(document_, &Document::camera_changed, &settled_, qOverload<>(&QTimer::start));
    connect(live_, &LivePage::framed, this, [this] {
      if (live_->frame()->frame.complete()) update();
    });
  }
  update();
}

KnownMethods* MethodsRoom::find_known(const Document* document) {
  known_.removeIf([](const OfDocument& one) { return one.document.isNull(); });
  for (OfDocument& one : known_)
    if (one.document == document) return &one.known;
  return nullptr;
}

const KnownMethods* MethodsRoom::find_known(const Document* document) const {
  for (const OfDocument& one : known_)
    if (one.document == document && document != nullptr) return &one.known;
  return nullptr;
}

void MethodsRoom::set_known(const Document& document, KnownMethods known) {
  if (KnownMethods* there = find_known(&document))
    *there = std::move(known);
  else
    known_ << OfDocument{&document, std::move(known)};
}

/// What jobs came to is asked of their pages.
void MethodsRoom::follow_pages() {
  if (auto* page = qobject_cast<JobPage*>(window_.picture_page()))
    connect(page, &JobPage::completed, this, &MethodsRoom::update, Qt::UniqueConnection);
}

void MethodsRoom::update() {
  if (!frame_->isVisible()) return;
  KnownMethods* known = find_known(document_);
  dock_->set_can_save(known != nullptr && known->tradeoff() != nullptr);
  if (known == nullptr) return dock_->show_rows({}, MethodsDock::first_heading(), std::nullopt);
  const Result<v1::Scene> scene = document_->effective();
  if (!scene) return dock_->show_note(QString::fromStdString(scene.error().message));

  const v1::Settings& settings = scene->settings();
  const bool holds = known->hold_of(*scene);
  known->mark_used(settings);
  if (holds) {
    join_jobs(*known);
    if (const auto frame = live_->frame()) known->add_frame(frame->plan, frame->frame);
  }
  const bool tolerance = settings.has_goal() && !settings.goal().has_deadline();
  const double limit = settings.goal().has_tolerance() ? settings.goal().tolerance() : 0.5;
  dock_->show_rows(known->rows(), known->heading(),
                   tolerance ? std::optional(limit) : std::nullopt);
  if (measuring_ == nullptr)
    dock_->show_note(holds ? QString()
                           : MethodsDock::tr("The scene has changed since: Predict asks anew."));
  if (holds && !known->knows_choice(settings)) ask(true);
}

void MethodsRoom::join_jobs(KnownMethods& known) const {
  for (int i = 0; i < window_.pictures().count(); ++i) {
    const auto* page = qobject_cast<const JobPage*>(window_.pictures().widget(i));
    if (page == nullptr || !page->rendered() || !page->finished()) continue;
    const Picture& picture = *page->rendered();
    if (picture.scene && known.hold_of(*picture.scene))
      known.add_job(picture.from, *picture.plan, *page->finished());
  }
}

void MethodsRoom::explain() {
  show_dock();
  ask(false);
}

/// `choice_only`: figures that were measured stay.
void MethodsRoom::ask(bool choice_only) {
  if (choice_only && asking_) return;
  const auto ready = sendable(window_);
  if (!ready) return;
  client::Submission submission =
      client::make_submission(*ready->scene, ready->assets, ready->name.toStdString(), true);
  submission.request.set_explain(true);
  asking_ = true;
  dock_->show_note(MethodsDock::tr("The server looks at some pixels of every method …"));
  const unsigned number = ++asked_;
  const auto fail = [this, number](const QString& why) {
    if (number != asked_) return;
    asking_ = false;
    dock_->show_note(why);
    window_.log().write(LogKind::warning, MethodsDock::tr("Methods"), why);
  };
  const auto take = [this, number, fail, choice_only, scene = ready->scene,
                     document = document_](client::Answer<client::JobRecord> job) {
    if (number != asked_) return;
    if (!job) return fail(QString::fromStdString(printable(job.error().message)));
    if (!job->last.has_finished() || !job->plan) return fail(why_unexplained(*job));
    asking_ = false;
    if (document) take_job(*document, *scene, *job, choice_only);
  };
  window_.link().submit(this, std::move(submission),
                        [this, fail, take](client::Answer<client::JobHandle> job) {
                          if (!job)
                            return fail(QString::fromStdString(printable(job.error().message)));
                          window_.link().record(
                              this, *job, client::JobParts::plan, [](const v1::JobEvent&) {}, take);
                        });
}

void MethodsRoom::take_job(Document& document, const v1::Scene& scene, const client::JobRecord& job,
                           bool choice_only) {
  KnownMethods* known = find_known(&document);
  if (choice_only && known != nullptr && known->tradeoff() && known->hold_of(scene))
    known->set_choice(scene.settings(), job.plan->method());
  else
    set_known(document, KnownMethods::predicted(scene, *job.plan));
  update();
}

void MethodsRoom::measure(unsigned rounds) {
  show_dock();
  if (measuring_ != nullptr) return;
  const auto ready = sendable(window_);
  if (!ready) return;
  measuring_ =
      new TradeoffJob(window_.link(), ready->scene, ready->assets, ready->name, rounds, this);
  dock_->show_note({});
  dock_->show_progress(1, 1, ready->name);
  connect(measuring_, &TradeoffJob::begun, dock_, &MethodsDock::show_progress);
  const auto end = [this](const QString& note) {
    measuring_->deleteLater();
    measuring_ = nullptr;
    dock_->show_progress(0, 0, {});
    update();
    dock_->show_note(note);
    window_.log().write(LogKind::note, MethodsDock::tr("Methods"),
                        note.isEmpty() ? MethodsDock::tr("All methods are measured.") : note);
  };
  connect(measuring_, &TradeoffJob::stopped, this, [end](const QString& why) {
    end(MethodsDock::tr("The measurement ended early: %1.").arg(why));
  });
  connect(measuring_, &TradeoffJob::finished, this,
          [this, end, scene = ready->scene, document = document_](const Tradeoff& tradeoff) {
            if (document) set_known(*document, KnownMethods::measured(*scene, tradeoff));
            end({});
          });
}

void MethodsRoom::set_method(const v1::Settings& wanted, const QString& text) {
  if (document_ == nullptr || !document_->sound()) return;
  client::Look look = document_->look();
  client::set_method(document_->sound()->scene().settings(), wanted, look);
  document_->undo().push(new LookCommand(*document_, std::move(look), text));
}

Result<void> MethodsRoom::save(const QString& file) const {
  const KnownMethods* known = find_known(document_);
  if (known == nullptr || !known->tradeoff()) return problem("nothing was measured");
  return save_text(file, QString::fromStdString(client::tradeoff_csv(*known->tradeoff())));
}

void MethodsRoom::save_as() {
  const QString file = QFileDialog::getSaveFileName(dock_, MethodsDock::tr("Save the table"),
                                                    QStringLiteral("tradeoff.csv"),
                                                    MethodsDock::tr("Numbers (*.csv)"));
  if (file.isEmpty()) return;
  const Result<void> saved = save(file);
  window_.say(saved ? MethodsDock::tr("wrote %1").arg(file)
                    : QString::fromStdString(saved.error().message));
}

}  // namespace metamer::gui
