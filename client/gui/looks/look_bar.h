#pragma once

#include <QPointer>
#include <QToolBar>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The looks of the scene in front as buttons, with what else of its look is chosen from a list.
/// The button that is down is the one which would change nothing.
class LookBar : public QToolBar {
  Q_OBJECT
 public:
  explicit LookBar(MainWindow& window);

  /// Of the scene's looks, from 0; where it has none, of the standard ones.
  void choose(int index);
  void choose_none();
  /// The look as it is now becomes one of the scene, in its text, by a name that is asked for.
  void keep();
  void keep_as(const QString& name);
  /// The look as it is now, with all that was set by hand, into the scene's text as one edit: in
  /// the place of the one of that name, which is asked for. What no look can say becomes the
  /// scene's own settings.
  void write();
  void write_as(const QString& name);
  /// What the buttons show: the scene without its objects, with standard looks where it has none.
  const v1::Scene& scene() const { return scene_; }

 private:
  void add_choice(const QString& name, const QStringList& ids);
  void follow_document();
  void list();
  void mark();
  bool is_shown(const client::Look& chosen) const;
  void mark_settings(const v1::Settings& settings);

  MainWindow& window_;
  QPointer<Document> document_;
  QAction* keep_;
  QList<QAction*> looks_;  ///< Of the window's table, then others without a key.
  v1::Scene scene_;
};

}  // namespace metamer::gui
