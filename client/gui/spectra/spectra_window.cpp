#include "client/gui/spectra/spectra_window.h"

#include <QCompleter>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMimeData>
#include <QRegularExpression>
#include <QShortcut>
#include <QSortFilterProxyModel>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>

#include "client/gui/spectra/compact_table.h"
#include "client/gui/spectra/dialog_button.h"
#include "client/gui/spectra/metamer_dialog.h"
#include "client/gui/spectra/resample_dialog.h"
#include "client/gui/spectra/rgb_dialog.h"
#include "client/gui/spectra/spectrum_curve.h"

namespace metamer::gui {
namespace {

QLabel* make_heading(const QString& text, QWidget* buddy) {
  auto* label = new QLabel(text);
  label->setBuddy(buddy);
  return label;
}

}  // namespace

SpectraWindow::SpectraWindow(QWidget* parent)
    : QWidget(parent, Qt::Window), plot_(new SpectrumPlot), told_(new QLabel) {
  setWindowTitle(tr("Spectra – Metamer"));
  setObjectName(QStringLiteral("spectra"));
  setAcceptDrops(true);
  resize(1320, 720);
  lights_ = make_view(lists_.lights(), tr("Lights"));
  materials_ = make_view(lists_.materials(), tr("Materials"));

  auto* tables = new QWidget;
  auto* column = new QVBoxLayout(tables);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(make_heading(tr("&Lights"), lights_));
  column->addWidget(lights_, 1);
  column->addWidget(make_heading(tr("&Materials"), materials_));
  column->addWidget(materials_, 2);
  auto* splitter = new QSplitter;
  splitter->addWidget(tables);
  splitter->addWidget(plot_);
  splitter->setSizes({800, 500});
  splitter->setChildrenCollapsible(false);

  told_->setWordWrap(true);
  told_->setTextFormat(Qt::PlainText);
  told_->setAccessibleName(tr("What was said last"));
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(make_top());
  layout->addWidget(splitter, 1);
  layout->addWidget(told_);
  layout->addWidget(make_buttons());

  connect(&lists_, &SpectraLists::added, this, &SpectraWindow::choose);
  connect(&lists_, &SpectraLists::refused, this, &SpectraWindow::tell);
  connect(&lists_, &SpectraLists::viewer_changed, this, [this] { tell({}); });
  tell(tr("Add spectra by file or by name: D65, TCS09, D:6504K, 2856K, 436nm:0.6+546.1nm."));
  draw();
}

QTableView* SpectraWindow::make_view(SpectraTable& table, const QString& title) {
  auto* sorted = new QSortFilterProxyModel(this);
  sorted->setSourceModel(&table);
  sorted->setSortRole(SpectraTable::value_role);
  auto* view = new QTableView;
  view->setModel(sorted);
  view->setAccessibleName(title);
  view->setSelectionBehavior(QAbstractItemView::SelectRows);
  view->setSortingEnabled(true);
  view->sortByColumn(-1, Qt::AscendingOrder);
  view->setDragEnabled(true);
  view->setDragDropMode(QAbstractItemView::DragOnly);
  view->setWordWrap(false);
  view->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
                        QAbstractItemView::AnyKeyPressed);
  make_compact(*view);
  view->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  view->horizontalHeader()->setStretchLastSection(true);
  connect(view->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &SpectraWindow::draw);
  connect(&table, &QAbstractItemModel::dataChanged, this, &SpectraWindow::draw);
  connect(&table, &QAbstractItemModel::rowsRemoved, this, &SpectraWindow::draw);
  auto* remove = new QShortcut(QKeySequence::Delete, view);
  remove->setContext(Qt::WidgetShortcut);
  connect(remove, &QShortcut::activated, this, &SpectraWindow::remove_chosen);
  return view;
}

QWidget* SpectraWindow::make_top() {
  auto* files = new QPushButton(tr("Add &file…"));
  word_ = new QLineEdit;
  word_->setPlaceholderText(tr("by name: D65 TCS09 D:6504K 2856K"));
  word_->setAccessibleName(tr("Spectra to add, by name"));
  word_->setCompleter(new QCompleter(illuminant_names() + test_color_names(), word_));
  word_->completer()->setCaseSensitivity(Qt::CaseInsensitive);
  word_->setClearButtonEnabled(true);
  auto* add = new QPushButton(tr("&Add"));
  auto* scene = new QPushButton(tr("&Scene's spectra"));
  observer_ = new ObserverBox;
  light_ = new SpectrumBox(illuminant_names(), QStringLiteral("D65"));
  light_->setAccessibleName(tr("Light of materials"));
  light_->setToolTip(
      tr("A CIE illuminant, D:6504K, 2856K, lines such as 436nm:0.6+546.1nm, or a file"));
  connect(files, &QPushButton::clicked, this, &SpectraWindow::add_files);
  const auto add_line = [this] {
    add_words(word_->text());
    word_->clear();
  };
  connect(add, &QPushButton::clicked, this, add_line);
  connect(word_, &QLineEdit::returnPressed, this, add_line);
  connect(scene, &QPushButton::clicked, this, &SpectraWindow::scene_wanted);
  const auto view = [this] { lists_.set_viewer(observer_->word(), light_->word()); };
  connect(observer_, &ObserverBox::chosen, this, view);
  connect(light_, &SpectrumBox::chosen, this, view);

  auto* top = new QWidget;
  auto* row = new QHBoxLayout(top);
  row->setContentsMargins(0, 0, 0, 0);
  for (QWidget* one : std::initializer_list<QWidget*>{files, word_, add, scene})
    row->addWidget(one, one == word_ ? 1 : 0);
  row->addSpacing(16);
  row->addWidget(make_heading(tr("&Observer"), observer_));
  row->addWidget(observer_);
  row->addWidget(make_heading(tr("Materials &under"), light_));
  row->addWidget(light_);
  return top;
}

QWidget* SpectraWindow::make_buttons() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  remove_ = add_button(*row, tr("&Remove"), this, &SpectraWindow::remove_chosen);
  row->addStretch();
  of_spectra_ << add_button(*row, tr("Resam&ple…"), this, &SpectraWindow::resample);
  of_spectra_ << add_button(*row, tr("R&GB…"), this, &SpectraWindow::show_rgb);
  add_button(*row, tr("Make a m&etamer…"), this, &SpectraWindow::make_metamer);
  of_spectra_ << add_button(*row, tr("Save plo&t…"), this, [this] { plot_->save_as(); });
  return buttons;
}

QList<Listed> SpectraWindow::selected(const QTableView& view, const SpectraTable& table) const {
  QList<int> rows;
  const auto* sorted = qobject_cast<const QSortFilterProxyModel*>(view.model());
  for (const QModelIndex& index : view.selectionModel()->selectedRows())
    rows << sorted->mapToSource(index).row();
  std::sort(rows.begin(), rows.end());
  QList<Listed> found;
  for (const int row : rows) found << table.rows()[row];
  return found;
}

QList<Listed> SpectraWindow::chosen() const {
  auto& lists = const_cast<SpectraLists&>(lists_);
  const QList<Listed> found =
      selected(*lights_, lists.lights()) + selected(*materials_, lists.materials());
  return found.isEmpty() ? lists.lights().rows() + lists.materials().rows() : found;
}

/// Selects what was added, in its list; of a whole scene nothing, which shows all.
void SpectraWindow::choose(const QList<Listed>& rows) {
  constexpr int few = 8;
  if (!rows.isEmpty()) tell({});
  for (QTableView* view : {lights_, materials_}) {
    const auto* sorted = qobject_cast<const QSortFilterProxyModel*>(view->model());
    const auto* table = qobject_cast<const SpectraTable*>(sorted->sourceModel());
    QItemSelection selection;
    for (int row = 0; row < table->rowCount(); ++row)
      if (rows.size() <= few && rows.contains(table->rows()[row])) {
        const QModelIndex index = sorted->mapFromSource(table->index(row, 0));
        selection.select(index, index);
      }
    view->selectionModel()->select(selection,
                                   QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  }
  draw();
}

void SpectraWindow::draw() {
  const QList<Listed> rows = chosen();
  for (QPushButton* button : of_spectra_) button->setEnabled(!rows.isEmpty());
  remove_->setEnabled(lights_->selectionModel()->hasSelection() ||
                      materials_->selectionModel()->hasSelection());
  draw_spectra(*plot_, rows);
}

void SpectraWindow::add_words(const QString& line) {
  const QString whole = line.trimmed();
  if (whole.isEmpty()) return;
  static const QRegularExpression blanks(QStringLiteral("[\\s,]+"));
  lists_.add(QFileInfo::exists(whole) ? QStringList{whole}
                                      : whole.split(blanks, Qt::SkipEmptyParts));
}

void SpectraWindow::add_files() {
  lists_.add(QFileDialog::getOpenFileNames(
      this, tr("Add spectra"), {},
      tr("Spectra (*.sp *.txt *.csv *.tsv *.cxf *.spdx *.xml *.ti3 *.cmf *.exr);;All files (*)")));
}

void SpectraWindow::remove_chosen() {
  for (QTableView* view : {lights_, materials_}) {
    QList<QPersistentModelIndex> rows;
    for (const QModelIndex& index : view->selectionModel()->selectedRows()) rows << index;
    for (const QPersistentModelIndex& index : rows) view->model()->removeRow(index.row());
  }
}

void SpectraWindow::resample() {
  auto* dialog = new ResampleDialog(chosen(), lists_.viewer(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->show();
}

void SpectraWindow::show_rgb() {
  auto* dialog = new RgbDialog(chosen(), lists_.viewer(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->show();
}

void SpectraWindow::make_metamer() {
  const QList<Listed> materials = selected(*materials_, lists_.materials());
  auto* dialog =
      new MetamerDialog(materials.isEmpty() ? nullptr : materials.front(), lists_.viewer(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &MetamerDialog::saved, this, [this](const QString& file) { lists_.add({file}); });
  dialog->show();
  dialog->make();
}

void SpectraWindow::tell(const QString& text) {
  told_->setText(text);
  told_->setVisible(!text.isEmpty());
}

void SpectraWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->source() != nullptr && isAncestorOf(qobject_cast<QWidget*>(event->source()))) return;
  if (event->mimeData()->hasUrls() || event->mimeData()->hasText()) event->acceptProposedAction();
}

void SpectraWindow::dropEvent(QDropEvent* event) {
  QStringList words;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) words << url.toLocalFile();
  if (words.isEmpty())
    words = event->mimeData()->text().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
  if (!words.isEmpty()) lists_.add(words);
  event->acceptProposedAction();
}

}  // namespace metamer::gui
