#include "client/gui/log/log_dock.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QScrollBar>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>

#include "client/gui/spectra/compact_table.h"

namespace metamer::gui {

LogFilter::LogFilter(Log& log, QObject* parent) : QSortFilterProxyModel(parent), log_(log) {
  setSourceModel(&log);
}

void LogFilter::set_words(const QString& words) {
  words_ = words.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  invalidateFilter();
}

void LogFilter::set_no_notes(bool no_notes) {
  no_notes_ = no_notes;
  invalidateFilter();
}

bool LogFilter::filterAcceptsRow(int row, const QModelIndex&) const {
  if (no_notes_ && log_.kind_of(row) == LogKind::note) return false;
  const QString line = log_.line(row);
  return std::all_of(words_.begin(), words_.end(),
                     [&](const QString& word) { return line.contains(word, Qt::CaseInsensitive); });
}

LogDock::LogDock(Log& log, QWidget* parent)
    : QWidget(parent),
      log_(log),
      filter_(log),
      view_(new QTableView),
      words_(new QLineEdit),
      no_notes_(new QCheckBox(tr("&Warnings and errors only"))) {
  words_->setPlaceholderText(tr("Filter"));
  words_->setAccessibleName(tr("Filter of the log"));
  words_->setClearButtonEnabled(true);
  view_->setModel(&filter_);
  view_->setAccessibleName(tr("Log"));
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setShowGrid(false);
  view_->setWordWrap(false);
  make_compact(*view_);
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  view_->horizontalHeader()->setStretchLastSection(true);
  view_->setColumnWidth(Log::from, 180);
  auto* copy_button = new QPushButton(tr("C&opy"));
  copy_button->setToolTip(tr("The lines that are chosen, else all that are shown"));
  auto* clear_button = new QPushButton(tr("C&lear"));
  auto* line = new QHBoxLayout;
  line->addWidget(words_, 1);
  line->addWidget(no_notes_);
  line->addWidget(copy_button);
  line->addWidget(clear_button);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addLayout(line);
  layout->addWidget(view_, 1);

  connect(words_, &QLineEdit::textChanged, &filter_, &LogFilter::set_words);
  connect(no_notes_, &QCheckBox::toggled, &filter_, &LogFilter::set_no_notes);
  connect(copy_button, &QPushButton::clicked, this, &LogDock::copy);
  connect(clear_button, &QPushButton::clicked, &log_, &Log::clear);
  auto* keys = new QShortcut(QKeySequence::Copy, view_);
  keys->setContext(Qt::WidgetShortcut);
  connect(keys, &QShortcut::activated, this, &LogDock::copy);
  // Who reads further up is left there.
  connect(&filter_, &QAbstractItemModel::rowsAboutToBeInserted, this, [this] {
    at_end_ = view_->verticalScrollBar()->value() == view_->verticalScrollBar()->maximum();
  });
  connect(&filter_, &QAbstractItemModel::rowsInserted, this, [this] {
    if (at_end_) view_->scrollToBottom();
  });
}

void LogDock::showEvent(QShowEvent*) {
  if (at_end_) QMetaObject::invokeMethod(view_, &QTableView::scrollToBottom, Qt::QueuedConnection);
}

void LogDock::copy() const {
  QModelIndexList chosen = view_->selectionModel()->selectedRows();
  if (chosen.isEmpty())
    for (int row = 0; row < filter_.rowCount(); ++row) chosen << filter_.index(row, 0);
  std::sort(chosen.begin(), chosen.end());
  QString text;
  for (const QModelIndex& one : chosen)
    text += log_.line(filter_.mapToSource(one).row()) + QLatin1Char('\n');
  QGuiApplication::clipboard()->setText(text);
}

}  // namespace metamer::gui
