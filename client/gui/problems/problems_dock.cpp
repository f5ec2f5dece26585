#include "client/gui/problems/problems_dock.h"

#include <QFileInfo>
#include <QHeaderView>
#include <QVBoxLayout>

#include "client/gui/app/main_window.h"
#include "client/gui/problems/fix_delegate.h"
#include "client/gui/problems/locate_file.h"
#include "client/tools/scene/problem_fix.h"

namespace metamer::gui {

ProblemsDock::ProblemsDock(MainWindow& window)
    : window_(window), table_(new ProblemTable(this)), view_(new QTableView(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(view_);
  view_->setModel(table_);
  view_->setAccessibleName(tr("Problems"));
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setSelectionMode(QAbstractItemView::SingleSelection);
  view_->setTabKeyNavigation(false);
  view_->setShowGrid(false);
  view_->setWordWrap(false);
  view_->verticalHeader()->hide();
  view_->verticalHeader()->setDefaultSectionSize(view_->fontMetrics().height() + 8);
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  view_->horizontalHeader()->setSectionResizeMode(ProblemTable::sentence, QHeaderView::Stretch);
  auto* fixes = new FixDelegate(view_);
  view_->setItemDelegateForColumn(ProblemTable::fix, fixes);
  connect(fixes, &FixDelegate::clicked, this, &ProblemsDock::fix);
  connect(view_, &QTableView::clicked, this, [this](const QModelIndex& at) {
    if (at.column() != ProblemTable::fix || table_->fix_text(at.row()).isEmpty()) go_to(at.row());
  });
  // Enter, in the style that activates by it.
  connect(view_, &QTableView::activated, this, [this](const QModelIndex& at) { go_to(at.row()); });
  connect(&window, &MainWindow::document_chosen, this, &ProblemsDock::follow);
}

void ProblemsDock::follow() {
  Document* front = window_.document();
  // A text that a problem led to leaves the list as it is.
  if (front == document_ || (front == nullptr && document_ && window_.file() != nullptr)) return;
  if (document_) disconnect(document_, nullptr, this, nullptr);
  document_ = front;
  if (front != nullptr) {
    connect(front, &Document::problems_changed, this, &ProblemsDock::show_problems);
    connect(front, &QObject::destroyed, this, &ProblemsDock::show_problems);
  }
  show_problems();
}

void ProblemsDock::show_problems() {
  if (document_ && document_->checked())
    table_->set_problems(document_->problems(),
                         QString::fromStdString(document_->checked()->file()));
  else
    table_->set_problems({}, {});
  for (int tab = 0; tab < window_.scenes().count(); ++tab) mark(tab);
  view_->resizeColumnToContents(ProblemTable::place);
  view_->resizeColumnToContents(ProblemTable::field);
  view_->resizeColumnToContents(ProblemTable::fix);
  Q_EMIT counted(table_->rowCount());
}

/// Shows at their places what lies in a tab's text, which is the scene's or that of one of its
/// files.
void ProblemsDock::mark(int tab) {
  auto* editor = qobject_cast<SceneEditor*>(window_.scenes().widget(tab));
  const auto* file = editor == nullptr ? nullptr : editor->property("file").value<TextFile*>();
  if (file == nullptr) return;
  const bool own = file == document_;
  if (!own && qobject_cast<const Document*>(file) != nullptr) return;
  const std::string name =
      own && document_->checked() ? document_->checked()->file() : file->path().toStdString();
  QList<EditorProblem> marks;
  for (const Problem& one : table_->problems())
    if (one.file == name)
      marks << EditorProblem{one.line, one.column, QString::fromStdString(one.message)};
  editor->show_problems(marks);
}

void ProblemsDock::go_to(int row) {
  if (!document_ || row < 0 || row >= table_->rowCount()) return;
  const Problem problem = table_->problems()[static_cast<std::size_t>(row)];
  const bool own = document_->checked() && problem.file == document_->checked()->file();
  TextFile* file = own ? document_ : window_.open_text(QString::fromStdString(problem.file));
  if (file == nullptr) return;
  SceneEditor* editor = window_.show_text(file);
  mark(window_.scenes().currentIndex());
  editor->go_to(problem.line, problem.column);
  view_->selectRow(row);
}

void ProblemsDock::step(bool backwards) {
  const TextFile* file = window_.file();
  SceneEditor* editor = window_.editor();
  if (!document_ || file == nullptr || !document_->checked()) return;
  const QString name =
      file == document_ ? QString::fromStdString(document_->checked()->file()) : file->path();
  go_to(table_->next(name, editor->line(), editor->column(), backwards));
}

void ProblemsDock::fix(int row) {
  if (!document_ || row < 0 || row >= table_->rowCount() || table_->fix_text(row).isEmpty()) return;
  const Problem problem = table_->problems()[static_cast<std::size_t>(row)];
  if (!problem.meant.empty()) return put(problem, QString::fromStdString(problem.meant));
  locate_file(this, QFileInfo(document_->path()).absolutePath(),
              QString::fromStdString(problem.was),
              [this, problem, document = document_](const QString& name) {
                if (document && document == document_) put(problem, name);
              });
}

void ProblemsDock::put(const Problem& problem, const QString& by) {
  const std::string text = document_->text().toStdString();
  const auto edit = client::replacement(text, problem, by.toStdString());
  if (!edit) return window_.say(tr("it does not stand there any more"));
  window_.show_text(document_)->replace(static_cast<int>(edit->begin), static_cast<int>(edit->end),
                                        QString::fromStdString(edit->text));
  window_.editor()->setFocus();
}

void ProblemsDock::fix_here() {
  if (view_->hasFocus()) return fix(view_->currentIndex().row());
  const int row = window_.file() != nullptr && window_.file() == document_
                      ? table_->fix_at(window_.editor()->line(), window_.editor()->column())
                      : -1;
  if (row < 0) return window_.say(tr("there is nothing to mend on this line"));
  fix(row);
}

}  // namespace metamer::gui
