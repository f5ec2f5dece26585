#include "client/gui/methods/known_methods.h"

#include <google/protobuf/util/message_differencer.h>

#include <QCoreApplication>

#include <algorithm>
#include <utility>

#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

using google::protobuf::util::MessageDifferencer;

QString known_text(const char* text) { return QCoreApplication::translate("Methods", text); }

v1::Settings goal_of(const v1::Settings& settings) {
  const v1::Settings full = with_defaults(settings);
  v1::Settings goal;
  if (full.has_goal()) *goal.mutable_goal() = full.goal();
  return goal;
}

double pixels_of(std::uint32_t width, std::uint32_t height) {
  return static_cast<double>(width) * height;
}

}  // namespace

KnownMethods::KnownMethods(const v1::Scene& scene)
    : part_(comparable_part(scene)), settings_(with_defaults(scene.settings())) {}

KnownMethods KnownMethods::predicted(const v1::Scene& scene, const v1::Plan& plan) {
  KnownMethods known(scene);
  known.rows_ = predicted_rows(plan);
  known.set_choice(scene.settings(), plan.method());
  const std::uint32_t pixels = plan.prediction().empty() ? 0 : plan.prediction(0).error().pixels();
  known.source_ = known_text("Predicted from %L1 of %L2 pixels")
                      .arg(pixels)
                      .arg(std::uint64_t{plan.width()} * plan.height());
  known.mark_used(scene.settings());
  return known;
}

KnownMethods KnownMethods::measured(const v1::Scene& scene,
                                    std::shared_ptr<const client::Tradeoff> tradeoff) {
  KnownMethods known(scene);
  known.rows_ = measured_rows(*tradeoff);
  known.source_ =
      known_text(tradeoff->rounds == 1 ? "Measured on all of %L1 pixels in %2 round"
                                       : "Measured on all of %L1 pixels, the quickest of %2 rounds")
          .arg(std::uint64_t{tradeoff->plan.width()} * tradeoff->plan.height())
          .arg(tradeoff->rounds);
  known.tradeoff_ = std::move(tradeoff);
  known.mark_used(scene.settings());
  return known;
}

bool KnownMethods::hold_of(const v1::Scene& scene) const { return comparable_part(scene) == part_; }

bool KnownMethods::knows_choice(const v1::Settings& settings) const {
  const v1::Settings goal = goal_of(settings);
  return !goal.has_goal() || MessageDifferencer::Equals(goal, goal_);
}

void KnownMethods::set_choice(const v1::Settings& settings, const v1::Method& choice) {
  goal_ = goal_of(settings);
  choice_ = choice;
  mark_used(settings);
}

void KnownMethods::mark_used(const v1::Settings& settings) {
  const v1::Settings full = with_defaults(settings);
  v1::Method used = full.method();
  if (full.has_goal()) used = knows_choice(settings) ? choice_ : v1::Method();
  const int at = find_row(rows_, used);
  for (int i = 0; i < rows_.size(); ++i) rows_[i].chosen = i == at;
  used_ = QString::fromStdString(method_text(used));
}

void KnownMethods::add_job(const QString& from, const v1::Plan& plan,
                           const v1::Finished& finished) {
  const int at = find_row(rows_, plan.method());
  if (at < 0) return;
  CameOf came{.seconds = finished.timing().prepare() + finished.timing().render(), .from = from};
  if (finished.has_accuracy()) {
    const v1::ColorError& error = finished.accuracy().error();
    came.error = {
        .mean = error.mean(), .percentile_95 = error.percentile_95(), .maximum = error.maximum()};
  }
  rows_[at].came = came;
}

void KnownMethods::add_frame(const v1::Plan& plan, const v1::Frame& frame) {
  const int at = find_row(rows_, plan.method());
  if (at < 0 || !frame.complete() || frame.render() <= 0) return;
  std::optional<CameOf>& came = rows_[at].came;
  if (came && came->from != known_text("live")) return;
  const double seen = pixels_of(plan.width(), plan.height());
  if (seen == 0) return;
  const double size = pixels_of(settings_.width(), settings_.height()) / seen;
  came = CameOf{.seconds = frame.render() * settings_.spp() * size, .from = known_text("live")};
}

QString KnownMethods::heading() const {
  QString text = known_text(
                     "%1; ΔE00 against the reference; white is what faces the dominant "
                     "light.")
                     .arg(source_);
  if (const auto alike = alike_seconds(rows_))
    text += QLatin1Char(' ') +
            known_text("All cost alike, %1: their axis is linear around that.").arg(*alike);
  text += QLatin1Char(' ') + (used_.isEmpty() ? known_text("The server is asked for its choice.")
                                              : known_text("Used: %1.").arg(used_));
  return text;
}

}  // namespace metamer::gui
