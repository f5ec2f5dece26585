#include "client/gui/sheet/sheet_page.h"

#include <QFileDialog>
#include <QFormLayout>
#include <QHeaderView>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QVBoxLayout>
#include <utility>

#include "client/gui/app/number_box.h"
#include "client/gui/app/on_pool.h"

namespace metamer::gui {

SheetPage::SheetPage(QWidget* parent)
    : PicturePage(parent),
      canvas_(new Canvas),
      lights_(new QListWidget),
      light_(new QLineEdit),
      painted_(new QComboBox),
      limit_(new NumberBox(0.01, 100, 1)),
      make_(new QPushButton(tr("&Make the sheet"))),
      verdict_(new QLabel),
      state_(new QLabel),
      table_(new QTableWidget),
      png_(new QPushButton(tr("Save P&NG…"))),
      pdf_(new QPushButton(tr("Save &PDF…"))) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* splitter = new QSplitter;
  splitter->addWidget(canvas_);
  auto* side = new QWidget;
  auto* column = new QVBoxLayout(side);
  column->addWidget(make_choices());
  column->addWidget(make_answers(), 1);
  auto* scroll = new QScrollArea;
  scroll->setWidget(side);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setMinimumWidth(side->minimumSizeHint().width() +
                          scroll->verticalScrollBar()->sizeHint().width());
  splitter->addWidget(scroll);
  splitter->setStretchFactor(0, 1);
  splitter->setChildrenCollapsible(false);
  layout->addWidget(splitter);
  setFocusProxy(paints_[0]);  // what is chosen first
  connect(canvas_, &Canvas::wheeled, canvas_, &Canvas::zoom);
  connect(canvas_, &Canvas::dragged, canvas_, &Canvas::shift);
}

QWidget* SheetPage::make_choices() {
  auto* box = new QWidget;
  auto* form = new QFormLayout(box);
  form->setContentsMargins(0, 0, 0, 0);
  lights_->setMinimumHeight(64);
  lights_->setMaximumHeight(110);
  lights_->setDragDropMode(QAbstractItemView::InternalMove);
  lights_->setToolTip(tr("The first is the reference; drag to reorder, Delete removes"));
  form->addRow(tr("&Lights:"), lights_);
  auto* line = new QHBoxLayout;
  auto* add = new QPushButton(tr("&Add"));
  auto* remove = new QPushButton(tr("&Remove"));
  light_->setPlaceholderText(tr("F11, D:6504K, 2856K, lamps.csv#warm"));
  light_->setAccessibleName(tr("A light more"));
  for (QWidget* one : std::initializer_list<QWidget*>{light_, add, remove}) line->addWidget(one);
  form->addRow(line);
  const QStringList names{tr("Paint A (&reference):"), tr("Paint &B:"), tr("Paint &C, or none:")};
  for (std::size_t i = 0; i < paints_.size(); ++i) {
    paints_[i] = new QComboBox;
    paints_[i]->setEditable(true);
    form->addRow(names[static_cast<int>(i)], paints_[i]);
    connect(paints_[i], &QComboBox::activated, this, [this] { chosen_ = true; });
  }
  form->addRow(tr("Painte&d:"), painted_);
  limit_->setSuffix(tr(" ΔE00"));
  form->addRow(tr("L&imit:"), limit_);
  form->addRow(make_);
  connect(add, &QPushButton::clicked, this, [this] { add_light(light_->text().trimmed()); });
  connect(light_, &QLineEdit::returnPressed, add, &QPushButton::click);
  connect(remove, &QPushButton::clicked, this, [this] { delete lights_->currentItem(); });
  auto* key = new QShortcut(QKeySequence::Delete, lights_);
  key->setContext(Qt::WidgetShortcut);
  connect(key, &QShortcut::activated, remove, &QPushButton::click);
  connect(make_, &QPushButton::clicked, this, &SheetPage::asked);
  return box;
}

QWidget* SheetPage::make_answers() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  for (QLabel* label : {state_, verdict_}) {
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(label);
  }
  QFont bold = verdict_->font();
  bold.setBold(true);
  verdict_->setFont(bold);
  table_->setAccessibleName(tr("Paints under the lights"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->verticalHeader()->hide();
  table_->setTabKeyNavigation(false);
  table_->setMinimumSize(320, 110);
  column->addWidget(table_, 1);
  auto* line = new QHBoxLayout;
  line->addStretch();
  for (QPushButton* button : {png_, pdf_}) {
    button->setEnabled(false);
    line->addWidget(button);
  }
  column->addLayout(line);
  connect(png_, &QPushButton::clicked, this, [this] { save_as(QStringLiteral("png")); });
  connect(pdf_, &QPushButton::clicked, this, [this] { save_as(QStringLiteral("pdf")); });
  return box;
}

void SheetPage::add_light(const QString& word) {
  if (word.isEmpty()) return;
  if (lights_->count() >= most_lights)
    return show_fault(tr("a sheet has %1 lights at most").arg(most_lights));
  lights_->addItem(word);
  light_->clear();
}

void SheetPage::set_choices(const QStringList& paints, const QStringList& lights) {
  for (std::size_t i = 0; i < paints_.size(); ++i) {
    const QString before = paints_[i]->currentText();
    paints_[i]->clear();
    if (i == 2) paints_[i]->addItem(QString());
    paints_[i]->addItems(paints);
    if (!before.isEmpty())
      paints_[i]->setCurrentText(before);
    else if (i < 2)
      paints_[i]->setCurrentIndex(std::min(static_cast<int>(i), paints_[i]->count() - 1));
  }
  painted_->clear();
  painted_->addItem(tr("the materials of these paints"), QString());
  for (const QString& paint : paints) painted_->addItem(paint, paint);
  if (lights_->count() == 0) lights_->addItems(lights);
}

void SheetPage::suggest(const QString& a, const QString& b) {
  if (chosen_) return;
  paints_[0]->setCurrentText(a);
  paints_[1]->setCurrentText(b);
}

SheetWish SheetPage::wish() const {
  SheetWish wish{.lights = {},
                 .paints = {},
                 .painted = painted_->currentData().toString(),
                 .limit = limit_->value()};
  for (int i = 0; i < lights_->count(); ++i) wish.lights << lights_->item(i)->text();
  for (const QComboBox* paint : paints_)
    if (const QString word = paint->currentText().trimmed(); !word.isEmpty()) wish.paints << word;
  return wish;
}

void SheetPage::set_wish(const SheetWish& wish) {
  chosen_ = true;
  lights_->clear();
  lights_->addItems(wish.lights);
  for (std::size_t i = 0; i < paints_.size(); ++i)
    paints_[i]->setCurrentText(wish.paints.value(static_cast<qsizetype>(i)));
  painted_->setCurrentIndex(std::max(0, painted_->findData(wish.painted)));
  limit_->setValue(wish.limit);
}

void SheetPage::show_busy(const QString& what) {
  make_->setEnabled(false);
  state_->setText(what);
}

void SheetPage::show_fault(const QString& why) {
  make_->setEnabled(true);
  state_->setText(why);
}

void SheetPage::show_sheet(const std::shared_ptr<const MadeSheet>& sheet) {
  make_->setEnabled(true);
  sheet_ = sheet;
  canvas_->set_image(sheet->shown, color_space(sheet->made.developing));
  state_->setText(sheet->title);
  verdict_->setText(verdict_of(sheet->wish, sheet->made.matches));
  canvas_->setAccessibleDescription(verdict_->text());
  show_table();
  for (QPushButton* button : {png_, pdf_}) button->setEnabled(true);
}

void SheetPage::show_table() {
  const QStringList headings = sheet_headings();
  const QList<QStringList> rows = sheet_rows(sheet_->wish, sheet_->made.matches);
  table_->setColumnCount(static_cast<int>(headings.size()));
  table_->setHorizontalHeaderLabels(headings);
  table_->setRowCount(static_cast<int>(rows.size()));
  for (int r = 0; r < rows.size(); ++r)
    for (int c = 0; c < rows[r].size(); ++c)
      table_->setItem(r, c, new QTableWidgetItem(rows[r][c]));
  table_->resizeColumnsToContents();
}

void SheetPage::save_as(const QString& ending) {
  QString file = QFileDialog::getSaveFileName(this, tr("Save the sheet"), {},
                                              QStringLiteral("*.%1").arg(ending));
  if (file.isEmpty()) return;
  if (!file.endsWith(QLatin1Char('.') + ending)) file += QLatin1Char('.') + ending;
  save(file);
}

bool SheetPage::save_own() {
  if (sheet_) save_as(QStringLiteral("png"));
  return sheet_ != nullptr;
}

void SheetPage::save(const QString& file) {
  if (!sheet_) return;
  const auto work = [sheet = sheet_, file] {
    const Result<void> done = file.endsWith(QStringLiteral(".pdf")) ? save_sheet_pdf(*sheet, file)
                                                                    : save_sheet_png(*sheet, file);
    return done ? QString() : QString::fromStdString(done.error().message);
  };
  on_pool(this, work, [this, file](const QString& fault) {
    state_->setText(fault.isEmpty() ? tr("saved %1").arg(file)
                                    : QStringLiteral("%1: %2").arg(file, fault));
    Q_EMIT saved(file, fault);
  });
}

}  // namespace metamer::gui
