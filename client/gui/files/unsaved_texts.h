#pragma once

#include <QHash>
#include <QLockFile>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <QTimer>
#include <memory>
#include <vector>

namespace metamer::gui {

class TextFile;

/// A text that was not saved when the program that had it ended.
struct LostText {
  QString path;  ///< Its file; empty: it had none.
  bool scene;    ///< And no other text.
  QString text;
  QString kept;  ///< Where it is kept.
};

/// Keeps texts that are not saved in a folder, so that a crash loses at most `period` of them. Each
/// run has a folder of its own in there, which is locked while it runs.
class UnsavedTexts : public QObject {
  Q_OBJECT
 public:
  static constexpr std::chrono::seconds period{10};

  /// `root`: the folder for all runs; made when there is something to keep.
  explicit UnsavedTexts(QString root, QObject* parent = nullptr);
  /// Nothing is left of a program that ends as it should.
  ~UnsavedTexts() override;

  void add(TextFile* file);
  /// Writes now, on the thread pool, what has changed.
  void keep();

  /// What runs that are no more have left. Reads files.
  static std::vector<LostText> lost(const QString& root);
  static void forget(const std::vector<LostText>& texts);

 private:
  struct Kept {
    QString name;
    QString text;
  };
  bool open_folder();
  void drop(TextFile* file);

  QString root_, folder_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  QThreadPool writer_;  ///< One thread: what was asked for last is done last.
  QHash<TextFile*, Kept> files_;
};

}  // namespace metamer::gui
