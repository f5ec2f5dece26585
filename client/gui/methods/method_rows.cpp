#include "client/gui/methods/method_rows.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>

#include "client/session/submission.h"
#include "common/scene/methods.h"

namespace metamer::gui {
namespace {

MethodRow row_of_method(const v1::Method& method) {
  MethodRow row;
  row.method = method;
  row.name = QString::fromStdString(method_text(method));
  return row;
}

int family_of(const v1::Method& method) {
  const MethodEntry* entry = method_entry(method);
  return entry == nullptr ? 0 : static_cast<int>(entry - method_entries().data());
}

}  // namespace

double MethodError::operator[](ErrorFigure figure) const {
  switch (figure) {
    case ErrorFigure::maximum:
      return maximum;
    case ErrorFigure::percentile_95:
      return percentile_95;
    case ErrorFigure::mean:
      break;
  }
  return mean;
}

double MethodRow::largest() const { return std::max(error.maximum, bound.value_or(0)); }

QList<MethodRow> predicted_rows(const v1::Plan& plan) {
  QList<MethodRow> rows;
  for (const v1::Prediction& one : plan.prediction()) {
    MethodRow row = row_of_method(one.method());
    row.seconds = one.prepare() + one.render();
    row.error = {.mean = one.error().mean(),
                 .percentile_95 = one.error().percentile_95(),
                 .maximum = one.error().maximum()};
    row.bound = one.bound();
    row.chosen = one.chosen();
    rows << row;
  }
  return rows;
}

QList<MethodRow> measured_rows(const client::Tradeoff& tradeoff) {
  QList<MethodRow> rows;
  for (const client::TradeoffRow& one : tradeoff.rows) {
    MethodRow row = row_of_method(one.what.settings);
    row.failure = QString::fromStdString(one.failure);
    row.seconds = one.seconds();
    row.error = {.mean = one.error.mean,
                 .percentile_95 = one.error.percentile_95,
                 .maximum = one.error.maximum};
    rows << row;
  }
  std::stable_sort(rows.begin(), rows.end(), [](const MethodRow& a, const MethodRow& b) {
    if (a.failure.isEmpty() != b.failure.isEmpty()) return a.failure.isEmpty();
    return a.seconds < b.seconds;
  });
  return rows;
}

v1::Method asked_method(const v1::Method& method) {
  v1::Method asked = method;
  if (asked.has_point()) asked.mutable_point()->clear_lights();
  return asked;
}

int find_row(const QList<MethodRow>& rows, const v1::Method& method) {
  using google::protobuf::util::MessageDifferencer;
  int found = -1;
  for (int i = 0; i < rows.size(); ++i) {
    const v1::Method& one = rows[i].method;
    if (!rows[i].failure.isEmpty()) continue;
    if (MessageDifferencer::Equals(one, method)) return i;
    const bool open =
        method.point().lights() == v1::Point::BETTER || one.point().lights() == v1::Point::BETTER;
    if (open && found < 0 && MessageDifferencer::Equals(asked_method(one), asked_method(method)))
      found = i;
  }
  return found;
}

std::vector<bool> front_of(const QList<MethodRow>& rows, ErrorFigure figure) {
  std::vector<double> seconds, errors;
  for (const MethodRow& row : rows) {
    if (!row.failure.isEmpty()) continue;
    seconds.push_back(row.seconds);
    errors.push_back(row.error[figure]);
  }
  const std::vector<bool> good = client::pareto_front(seconds, errors);
  std::vector<bool> front;
  std::size_t at = 0;
  for (const MethodRow& row : rows) front.push_back(row.failure.isEmpty() && good[at++]);
  return front;
}

QStringList method_families() {
  QStringList words;
  for (const MethodEntry& entry : method_entries()) words << QString::fromUtf8(entry.word);
  return words;
}

QList<ScatterPoint> method_points(const QList<MethodRow>& rows, ErrorFigure figure,
                                  const std::optional<double>& level) {
  QList<ScatterPoint> points;
  const std::vector<bool> front = front_of(rows, figure);
  for (int i = 0; i < rows.size(); ++i) {
    const MethodRow& row = rows[i];
    if (!row.failure.isEmpty()) break;
    ScatterPoint point{.name = row.name,
                       .x = row.seconds,
                       .y = row.error[figure],
                       .whisker = figure == ErrorFigure::maximum ? row.bound.value_or(0) : 0,
                       .family = family_of(row.method),
                       .front = front[static_cast<std::size_t>(i)],
                       .chosen = row.chosen,
                       .faint = level && row.largest() > *level};
    if (row.came)
      point.came =
          QPointF(row.came->seconds, (row.came->error ? *row.came->error : row.error)[figure]);
    points << point;
  }
  return points;
}

std::string comparable_part(const v1::Scene& scene) {
  v1::Scene part = scene;
  part.clear_look();
  v1::Settings& settings = *part.mutable_settings();
  settings.clear_method();
  settings.clear_goal();
  settings.clear_threads();
  settings.clear_verify();
  return client::serialise(part);
}

std::optional<QString> alike_seconds(const QList<MethodRow>& rows) {
  QList<double> seconds;
  for (const MethodRow& row : rows)
    if (row.failure.isEmpty()) seconds << row.seconds;
  if (seconds.isEmpty() || axis_scale(seconds, 1e-9).logarithmic) return std::nullopt;
  const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
  return QObject::tr("%1 to %2 s")
      .arg(QString::number(*least, 'g', 3), QString::number(*most, 'g', 3));
}

}  // namespace metamer::gui
