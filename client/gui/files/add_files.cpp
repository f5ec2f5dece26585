#include "client/gui/files/add_files.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>

#include "client/gui/app/main_window.h"
#include "client/gui/document/scene_guide.h"
#include "client/gui/files/file_drop.h"
#include "client/gui/files/file_watch.h"
#include "client/gui/files/lost_texts.h"
#include "client/gui/files/open_files.h"
#include "client/gui/files/recent_files.h"
#include "client/gui/files/save_file.h"
#include "client/gui/files/unsaved_texts.h"

namespace metamer::gui {
namespace {

void open_by_dialog(MainWindow& window) {
  const QString near = window.file() == nullptr ? QString() : window.file()->path();
  const QString path =
      QFileDialog::getOpenFileName(&window, MainWindow::tr("Open a scene"), QFileInfo(near).path(),
                                   MainWindow::tr("Scenes (*.txtpb);;All files (*)"));
  if (!path.isEmpty()) window.open(path);
}

void bind_files(MainWindow& window) {
  Actions& actions = window.actions();
  actions.bind(QStringLiteral("file.new"), [&window] {
    auto* document = new Document(&window);
    document->start_with(new_scene_text());
    window.add_scene(document);
  });
  actions.bind(QStringLiteral("file.open"), [&window] { open_by_dialog(window); });
  actions.bind(QStringLiteral("file.save"),
               [&window] { save_file(&window, *window.file(), false); });
  actions.bind(QStringLiteral("file.save_as"),
               [&window] { save_file(&window, *window.file(), true); });
  actions.bind(QStringLiteral("file.close"),
               [&window] { window.close_scene(window.scenes().currentIndex()); });
  actions.bind(QStringLiteral("file.quit"), [&window] { window.close(); });
}

void bind_recent(MainWindow& window, RecentFiles& recent) {
  QMenu* menu = recent.make_menu(&window, [&window](const QString& path) { window.open(path); });
  window.actions()[QStringLiteral("file.recent")]->setMenu(menu);
  // Out of the palette, which has no menus.
  window.actions().bind(QStringLiteral("file.recent"), [&window, menu] {
    menu->popup(window.mapToGlobal(window.rect().center()));
  });
}

}  // namespace

void add_files(MainWindow& window) {
  bind_files(window);
  auto* recent = new RecentFiles(&window);
  bind_recent(window, *recent);
  auto* drop = new FileDrop(&window, [&window](const QString& path) { window.open(path); });
  window.setAcceptDrops(true);
  window.installEventFilter(drop);
  auto* unsaved = new UnsavedTexts(unsaved_folder(), &window);
  new OpenFiles(window);
  QObject::connect(&window, &MainWindow::file_added, &window,
                   [drop, recent, unsaved](TextFile* file, SceneEditor* editor) {
                     new FileWatch(file, editor);
                     unsaved->add(file);
                     editor->viewport().installEventFilter(drop);
                     if (qobject_cast<Document*>(file) == nullptr) return;
                     if (!file->path().isEmpty()) recent->add(file->path());
                     QObject::connect(file, &TextFile::saved, recent,
                                      [recent, file] { recent->add(file->path()); });
                   });
}

}  // namespace metamer::gui
