#pragma once

#include <QMenu>
#include <functional>

namespace metamer::gui {

/// The files that were opened or saved last, in the program's settings.
class RecentFiles : public QObject {
  Q_OBJECT
 public:
  static constexpr int most = 10;

  explicit RecentFiles(QObject* parent = nullptr) : QObject(parent) {}

  void add(const QString& path);
  QStringList files() const;  ///< The newest first.
  /// Filled whenever it opens.
  QMenu* make_menu(QWidget* parent, std::function<void(const QString&)> open);
};

}  // namespace metamer::gui
