#include "client/gui/log/log.h"

#include <QApplication>
#include <QStyle>

#include "common/printable.h"

namespace metamer::gui {
namespace {

QString one_line(const QString& text) {
  return QString::fromStdString(printable(text.simplified().toStdString()));
}

QString clock_text(const QDateTime& time) { return time.toString(QStringLiteral("HH:mm:ss")); }

}  // namespace

void Log::write(LogKind kind, const QString& from, const QString& text) {
  const Line line{QDateTime::currentDateTime(), kind, one_line(from), one_line(text)};
  if (line.text.isEmpty()) return;
  if (!lines_.empty()) {
    Line& last = lines_.back();
    if (last.kind == kind && last.from == line.from && last.text == line.text) {
      last.time = line.time;
      Q_EMIT dataChanged(index(rowCount() - 1, time), index(rowCount() - 1, time));
      return;
    }
  }
  if (rowCount() == most) {
    beginRemoveRows({}, 0, 0);
    lines_.pop_front();
    endRemoveRows();
  }
  beginInsertRows({}, rowCount(), rowCount());
  lines_.push_back(line);
  endInsertRows();
}

void Log::clear() {
  beginResetModel();
  lines_.clear();
  endResetModel();
}

QString Log::kind_text(LogKind kind) {
  switch (kind) {
    case LogKind::note:
      return tr("note");
    case LogKind::warning:
      return tr("warning");
    case LogKind::error:
      break;
  }
  return tr("error");
}

QString Log::line(int row) const {
  const Line& one = lines_[static_cast<std::size_t>(row)];
  return QStringLiteral("%1  %2  %3%4")
      .arg(clock_text(one.time), kind_text(one.kind),
           one.from.isEmpty() ? QString() : one.from + QStringLiteral(": "), one.text);
}

int Log::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(lines_.size());
}

int Log::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : columns; }

QVariant Log::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Line& one = lines_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DecorationRole && index.column() == kind && one.kind != LogKind::note)
    return QApplication::style()->standardIcon(
        one.kind == LogKind::error ? QStyle::SP_MessageBoxCritical : QStyle::SP_MessageBoxWarning);
  if (role == Qt::ToolTipRole)
    return QStringLiteral("%1 %2").arg(one.time.date().toString(Qt::ISODate), line(index.row()));
  if (role != Qt::DisplayRole) return {};
  switch (static_cast<Column>(index.column())) {
    case time:
      return clock_text(one.time);
    case kind:
      return kind_text(one.kind);
    case from:
      return one.from;
    case text:
      return one.text;
    case columns:
      break;
  }
  return {};
}

QVariant Log::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const char* const names[] = {QT_TR_NOOP("Time"), QT_TR_NOOP("Kind"), QT_TR_NOOP("From"),
                               QT_TR_NOOP("What")};
  return section >= 0 && section < columns ? tr(names[section]) : QVariant();
}

}  // namespace metamer::gui
