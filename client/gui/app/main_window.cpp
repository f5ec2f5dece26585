#include "client/gui/app/main_window.h"

#include <QCloseEvent>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QStatusBar>
#include <QTabBar>

#include "client/gui/app/rooms.h"
#include "client/gui/document/scene_guide.h"
#include "client/gui/files/save_file.h"

namespace metamer::gui {
namespace {

/// A tab at the left: an editor, with what belongs to it. Plain texts have no document and no live
/// page.
struct SceneTab {
  TextFile* file;
  Document* document;
  SceneEditor* editor;
  LivePage* live;
};

SceneTab tab_of(QWidget* editor) {
  auto* file = editor->property("file").value<TextFile*>();
  return {.file = file,
          .document = qobject_cast<Document*>(file),
          .editor = qobject_cast<SceneEditor*>(editor),
          .live = editor->property("live").value<LivePage*>()};
}

QString real_path(const QString& path) {
  const QString canonical = QFileInfo(path).canonicalFilePath();
  return canonical.isEmpty() ? QFileInfo(path).absoluteFilePath() : canonical;
}

}  // namespace

MainWindow::MainWindow(Link& link, QWidget* parent)
    : QMainWindow(parent),
      link_(link),
      actions_(this),
      scenes_(new QTabWidget),
      pictures_(new QTabWidget),
      panes_(new QSplitter(this)),
      server_(new QLabel),
      trouble_(new QLabel) {
  setWindowTitle(QStringLiteral("Metamer"));
  resize(1400, 900);
  setDockNestingEnabled(true);

  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);

  panes_->addWidget(scenes_);
  panes_->addWidget(pictures_);
  panes_->setStretchFactor(1, 1);
  panes_->setChildrenCollapsible(false);
  setCentralWidget(panes_);
  for (QTabWidget* tabs : {scenes_, pictures_}) {
    tabs->setTabsClosable(true);
    tabs->setMovable(true);
    tabs->setDocumentMode(true);
  }
  scenes_->setAccessibleName(tr("Scenes"));
  pictures_->setAccessibleName(tr("Pictures"));
  connect(scenes_, &QTabWidget::tabCloseRequested, this, &MainWindow::close_scene);
  connect(scenes_, &QTabWidget::currentChanged, this, &MainWindow::choose_document);
  connect(pictures_, &QTabWidget::tabCloseRequested, this, [this](int index) {
    QWidget* page = pictures_->widget(index);
    if (qobject_cast<LivePage*>(page) != nullptr) return;
    pictures_->removeTab(index);
    page->deleteLater();
  });

  statusBar()->addWidget(server_);
  statusBar()->addWidget(trouble_, 1);
  make_menus();
  bind_edit_actions();
  bind_view_actions();
  connect(&link_, &Link::status_changed, this, &MainWindow::show_status);
  show_status();
  add_rooms(*this);
  keep_first_layout();
  choose_document();
}

MainWindow::~MainWindow() = default;

void MainWindow::make_menus() {
  QHash<QString, QMenu*> menus;
  for (const ActionRow& row : action_table()) {
    QMenu* menu = nullptr;
    QString path;
    for (const QString& name : QString::fromUtf8(row.menu).split(QLatin1Char('/'))) {
      path += QLatin1Char('/') + name;
      QMenu*& there = menus[path];
      if (there == nullptr)
        there = menu == nullptr ? menuBar()->addMenu(QLatin1Char('&') + name) : menu->addMenu(name);
      menu = there;
    }
    QAction* action = actions_[QString::fromUtf8(row.id)];
    menu->addAction(action);
    // A picture's keys work where pictures are, all others everywhere.
    (row.context == Context::picture ? static_cast<QWidget*>(pictures_) : this)->addAction(action);
  }
}

void MainWindow::open(const QString& path) {
  if (TextFile* there = opened(path, true)) {
    show_text(there);
    show_picture(live(), {});
    return;
  }
  auto* document = new Document(this);
  if (const Result<void> loaded = document->load(path); !loaded) {
    QMessageBox::warning(this, tr("Open"),
                         tr("%1: %2").arg(path, QString::fromStdString(loaded.error().message)));
    delete document;
    return;
  }
  add_scene(document);
}

/// A tab of that file; of a scene that is open as such, or of any text.
TextFile* MainWindow::opened(const QString& path, bool scene) const {
  for (TextFile* file : files())
    if (!file->path().isEmpty() && real_path(file->path()) == real_path(path) &&
        (!scene || qobject_cast<Document*>(file) != nullptr))
      return file;
  return nullptr;
}

QList<TextFile*> MainWindow::files() const {
  QList<TextFile*> files;
  for (int i = 0; i < scenes_->count(); ++i) files << tab_of(scenes_->widget(i)).file;
  return files;
}

TextFile* MainWindow::open_text(const QString& path) {
  if (TextFile* there = opened(path, false)) return there;
  auto* file = new TextFile(this);
  if (const Result<void> loaded = file->load(path); !loaded) {
    say(tr("%1: %2").arg(path, QString::fromStdString(loaded.error().message)));
    delete file;
    return nullptr;
  }
  add_editor(file, nullptr);
  choose_document();
  return file;
}

SceneEditor* MainWindow::show_text(TextFile* file) {
  for (int i = 0; i < scenes_->count(); ++i)
    if (tab_of(scenes_->widget(i)).file == file) scenes_->setCurrentIndex(i);
  return editor();
}

SceneEditor* MainWindow::add_editor(TextFile* file, LivePage* live) {
  const bool scene = qobject_cast<Document*>(file) != nullptr;
  auto* editor =
      new SceneEditor(nullptr, scene ? SceneEditor::Kind::scene : SceneEditor::Kind::plain);
  if (scene) editor->set_providers(scene_guide(file));
  editor->setProperty("file", QVariant::fromValue(file));
  editor->setProperty("live", QVariant::fromValue(live));
  editor->set_text(file->text());
  connect(editor, &SceneEditor::text_changed, file,
          [file, editor] { file->set_text(editor->text()); });
  connect(file, &TextFile::title_changed, editor, [this, editor] { show_titles(editor); });
  scenes_->setCurrentIndex(scenes_->addTab(editor, QString()));
  show_titles(editor);
  Q_EMIT file_added(file, editor);
  return editor;
}

void MainWindow::add_scene(Document* document) {
  auto* live = new LivePage(link_, *document);
  connect(live, &LivePage::troubled, trouble_, &QLabel::setText);
  pictures_->setCurrentIndex(pictures_->addTab(live, QString()));
  add_editor(document, live);
  choose_document();
}

void MainWindow::show_titles(SceneEditor* editor) {
  const SceneTab tab = tab_of(editor);
  const QString star = tab.file->modified() ? QStringLiteral("*") : QString();
  if (const int at = scenes_->indexOf(editor); at >= 0)
    scenes_->setTabText(at, tab.file->title() + star);
  if (const int at = pictures_->indexOf(tab.live); at >= 0)
    pictures_->setTabText(at, tr("Live: %1").arg(tab.file->title()));
}

bool MainWindow::may_lose(TextFile& file) {
  if (!file.modified()) return true;
  const auto answer = QMessageBox::question(
      this, tr("Close"), tr("%1 has changes that are not saved.").arg(file.title()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save) save_file(this, file, false);
  return answer == QMessageBox::Discard || (answer == QMessageBox::Save && !file.modified());
}

bool MainWindow::close_scene(int index) {
  QWidget* widget = scenes_->widget(index);
  if (widget == nullptr) return false;
  const SceneTab tab = tab_of(widget);
  if (!may_lose(*tab.file)) return false;
  scenes_->removeTab(index);
  if (tab.live != nullptr) pictures_->removeTab(pictures_->indexOf(tab.live));
  delete tab.live;
  delete tab.editor;
  delete tab.file;
  choose_document();
  return true;
}

TextFile* MainWindow::file() const {
  QWidget* front = scenes_->currentWidget();
  return front == nullptr ? nullptr : tab_of(front).file;
}

Document* MainWindow::document() const {
  QWidget* front = scenes_->currentWidget();
  return front == nullptr ? nullptr : tab_of(front).document;
}

SceneEditor* MainWindow::editor() const {
  return qobject_cast<SceneEditor*>(scenes_->currentWidget());
}

LivePage* MainWindow::live() const {
  QWidget* front = scenes_->currentWidget();
  return front == nullptr ? nullptr : tab_of(front).live;
}

PicturePage* MainWindow::picture_page() const {
  return qobject_cast<PicturePage*>(pictures_->currentWidget());
}

void MainWindow::choose_document() {
  actions_.set_context(file() != nullptr, document() != nullptr, pictures_->count() > 0);
  Q_EMIT document_chosen();
}

void MainWindow::bind_edit_actions() {
  actions_.bind(QStringLiteral("edit.undo"), [this] { undo(); });
  actions_.bind(QStringLiteral("edit.redo"), [this] { redo(); });
  actions_.bind(QStringLiteral("edit.complete"), [this] { editor()->complete(); });
  actions_.bind(QStringLiteral("edit.find"), [this] { editor()->find(false); });
  actions_.bind(QStringLiteral("edit.replace"), [this] { editor()->find(true); });
}

void MainWindow::undo() { editor_focused() ? editor()->undo() : document()->undo().undo(); }

void MainWindow::redo() { editor_focused() ? editor()->redo() : document()->undo().redo(); }

bool MainWindow::editor_focused() const {
  return document() == nullptr || scenes_->isAncestorOf(focusWidget());
}

void MainWindow::bind_view_actions() {
  actions_.bind(QStringLiteral("view.fit"), [this] {
    if (PicturePage* page = picture_page()) page->canvas().fit();
  });
  actions_.bind(QStringLiteral("view.one_to_one"), [this] {
    if (PicturePage* page = picture_page()) page->canvas().one_to_one();
  });
  actions_.bind_toggle(QStringLiteral("view.full_screen"),
                       [this](bool full) { full ? showFullScreen() : showNormal(); });
  actions_.bind(QStringLiteral("window.reset"), [this] { reset_layout(); });
}

void MainWindow::show_picture(QWidget* page, const QString& title) {
  const int there = pictures_->indexOf(page);
  pictures_->setCurrentIndex(there >= 0 ? there : pictures_->addTab(page, title));
  choose_document();
}

void MainWindow::say(const QString& text) {
  statusBar()->showMessage(text, 8000);
  log_.write(LogKind::note, {}, text);
}

void MainWindow::show_status() {
  const client::LinkStatus& status = link_.status();
  const QString name =
      status.server.empty() ? tr("private server") : QString::fromStdString(status.server);
  switch (status.kind) {
    case client::LinkStatus::Kind::connecting:
      return server_->setText(tr("○ connecting to %1").arg(name));
    case client::LinkStatus::Kind::ready: {
      QStringList backends;
      for (const std::string& backend : status.welcome.capabilities().backend())
        backends << QString::fromStdString(backend);
      return server_->setText(tr("● %1 · %2").arg(name, backends.join(QStringLiteral(", "))));
    }
    case client::LinkStatus::Kind::lost:
      return server_->setText(
          tr("✗ %1: %2").arg(name, QString::fromStdString(status.error.message)));
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  for (TextFile* file : files()) {
    if (file->modified()) show_text(file);
    if (!may_lose(*file)) return event->ignore();
  }
  keep_layout();
  Q_EMIT closing();
  event->accept();
}

}  // namespace metamer::gui
