#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QMainWindow>
#include <QSplitter>
#include <QTabWidget>

#include "client/gui/app/actions.h"
#include "client/gui/document/document.h"
#include "client/gui/editor/scene_editor.h"
#include "client/gui/link/link.h"
#include "client/gui/live/live_page.h"
#include "client/gui/log/log.h"

namespace metamer::gui {

/// The window: scenes as tabs at the left, pictures as tabs in the centre, docks around. What
/// belongs to one room is made and bound by that room's `add_…` function.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(Link& link, QWidget* parent = nullptr);
  ~MainWindow() override;

  Actions& actions() { return actions_; }
  Link& link() { return link_; }
  Log& log() { return log_; }

  /// Opens a scene in tabs of its own, or shows those that it has; a message box says why where it
  /// can't be read.
  void open(const QString& path);
  /// A scene in tabs of its own, in front. The window owns it.
  void add_scene(Document* document);
  /// Closes a tab at the left with all that belongs to it, once its changes are saved or not
  /// wanted.
  bool close_scene(int index);
  /// The tab of a file that is open, else a new one with its text alone. Null: it can't be read, as
  /// the status bar says.
  TextFile* open_text(const QString& path);
  /// Brings its tab to the front.
  SceneEditor* show_text(TextFile* file);
  /// In the order of their tabs.
  QList<TextFile*> files() const;
  /// Of the tab that is in front; null: none is open. A plain text has no document and no live
  /// page.
  TextFile* file() const;
  Document* document() const;
  SceneEditor* editor() const;
  LivePage* live() const;
  /// The picture tab that is in front; null: there is none.
  PicturePage* picture_page() const;

  QTabWidget& scenes() { return *scenes_; }
  QTabWidget& pictures() { return *pictures_; }
  /// Adds a dock, which can be closed and moved but not floated, and its entry in the Window menu
  /// (Alt+1 …). One at the right is a tab below while the window is narrower than `narrow`.
  QDockWidget* add_dock(const QString& id, const QString& title, QWidget* content,
                        Qt::DockWidgetArea area);
  /// Adds a picture tab that can be closed, and shows it.
  void show_picture(QWidget* page, const QString& title);
  /// A line in the status bar, for a while, and in the log.
  void say(const QString& text);
  /// As it is at the first start.
  void reset_layout();
  /// As it was left last.
  void restore_layout();
  static constexpr int narrow = 1100;  // px

 Q_SIGNALS:
  /// Another scene is in front, or none.
  void document_chosen();
  /// A text has a tab at the left now.
  void file_added(TextFile* file, SceneEditor* editor);
  /// All is saved, or not wanted: the window closes.
  void closing();

 protected:
  void closeEvent(QCloseEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void showEvent(QShowEvent*) override;

 private:
  void make_menus();
  void bind_edit_actions();
  void bind_view_actions();
  SceneEditor* add_editor(TextFile* file, LivePage* live);
  /// Of the side that has the focus: the text has its own, the editor's.
  void undo();
  void redo();
  bool editor_focused() const;
  TextFile* opened(const QString& path, bool scene) const;
  void show_titles(SceneEditor* editor);
  bool may_lose(TextFile& file);
  void show_status();
  void choose_document();
  void put_dock(QDockWidget* dock, Qt::DockWidgetArea area);
  void put_side_docks();
  void size_panes();
  void keep_first_layout();
  void keep_layout() const;

  Link& link_;
  Actions actions_;
  Log log_;
  QTabWidget *scenes_, *pictures_;
  QSplitter* panes_;
  QLabel *server_, *trouble_;
  QList<QDockWidget*> docks_;
  QByteArray first_layout_;
  bool narrow_ = false, restored_ = false;
};

}  // namespace metamer::gui
