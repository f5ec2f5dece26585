#include "client/gui/problems/problem_table.h"

#include <QApplication>
#include <QFileInfo>
#include <QStyle>
#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace metamer::gui {

void ProblemTable::set_problems(std::vector<Problem> problems, const QString& own) {
  const std::string scene = own.toStdString();
  const auto place = [&](const Problem& one) {
    return std::tuple(one.file != scene, one.file, one.line, one.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  beginResetModel();
  problems_ = std::move(problems);
  own_ = own;
  endResetModel();
}

int ProblemTable::next(const QString& file, int line, int column, bool backwards) const {
  if (problems_.empty()) return -1;
  const std::string name = file.toStdString();
  const std::string own = own_.toStdString();
  const auto key = [&](const std::string& of, int at_line, int at_column) {
    return std::tuple(of != own, of, at_line, at_column);
  };
  const auto here = key(name, line, column);
  const int count = static_cast<int>(problems_.size());
  const auto at = [&](int row) {
    const Problem& one = problems_[static_cast<std::size_t>(row)];
    return key(one.file, one.line, one.column);
  };
  if (backwards) {
    for (int row = count; row-- > 0;)
      if (at(row) < here) return row;
    return count - 1;
  }
  for (int row = 0; row < count; ++row)
    if (at(row) > here) return row;
  return 0;
}

QString ProblemTable::fix_text(int row) const {
  const Problem& problem = problems_[static_cast<std::size_t>(row)];
  if (problem.was.empty() || problem.line <= 0 || problem.file != own_.toStdString()) return {};
  return problem.meant.empty() ? tr("Locate…")
                               : tr("Write %1").arg(QString::fromStdString(problem.meant));
}

int ProblemTable::fix_at(int line, int column) const {
  int nearest = -1, distance = 0;
  for (int row = 0; row < rowCount(); ++row) {
    const Problem& problem = problems_[static_cast<std::size_t>(row)];
    if (problem.line != line || fix_text(row).isEmpty()) continue;
    const int away = std::abs(problem.column - column);
    if (nearest < 0 || away < distance) {
      nearest = row;
      distance = away;
    }
  }
  return nearest;
}

int ProblemTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(problems_.size());
}

int ProblemTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString ProblemTable::place_text(const Problem& problem) const {
  const QString file = QString::fromStdString(problem.file);
  const QString name = file == own_ ? QString() : QFileInfo(file).fileName();
  if (problem.line <= 0) return name;
  const QString line = QStringLiteral("%1:%2").arg(problem.line).arg(problem.column);
  return name.isEmpty() ? line : name + QLatin1Char(':') + line;
}

QVariant ProblemTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Problem& problem = problems_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DecorationRole && index.column() == place)
    return QApplication::style()->standardIcon(QStyle::SP_MessageBoxCritical);
  if (role == Qt::ToolTipRole) return QString::fromStdString(format(problem));
  if (role != Qt::DisplayRole) return {};
  switch (static_cast<Column>(index.column())) {
    case place:
      return place_text(problem);
    case field:
      return QString::fromStdString(problem.field);
    case sentence:
      return QString::fromStdString(problem.message);
    case fix:
      return fix_text(index.row());
    case columns:
      break;
  }
  return {};
}

QVariant ProblemTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  switch (static_cast<Column>(section)) {
    case place:
      return tr("Place");
    case field:
      return tr("Field");
    case sentence:
      return tr("Problem");
    case fix:
      return tr("Fix");
    case columns:
      break;
  }
  return {};
}

}  // namespace metamer::gui
