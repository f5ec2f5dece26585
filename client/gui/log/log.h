#pragma once

#include <QAbstractTableModel>
#include <QDateTime>
#include <deque>

namespace metamer::gui {

enum class LogKind { note, warning, error };

/// What was said, to be read later: by the server, by jobs, of files that were read, and in the
/// status bar. The one place where the window's rooms write a line. Oldest first; of the window's
/// thread.
class Log : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { time, kind, from, text, columns };
  using QAbstractTableModel::QAbstractTableModel;

  /// `from` is the scene, file or server that it is of; empty: the window. Each goes on one line,
  /// whoever wrote it. What was just said is not said again: it only has a newer time. Of more than
  /// `most` lines the oldest go.
  void write(LogKind kind, const QString& from, const QString& text);
  void clear();
  LogKind kind_of(int row) const { return lines_[static_cast<std::size_t>(row)].kind; }
  /// "14:03:21  warning  booth.txtpb: 21 of 81 wavelengths lie below its first sample"
  QString line(int row) const;
  static constexpr int most = 5000;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Line {
    QDateTime time;
    LogKind kind;
    QString from, text;
  };
  static QString kind_text(LogKind kind);

  std::deque<Line> lines_;
};

}  // namespace metamer::gui
