#include "client/gui/methods/methods_dock.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>

#include "client/gui/spectra/compact_table.h"

namespace metamer::gui {
namespace {

/// ΔE00 that nobody sees and f32 hardly tells: a logarithm has no zero.
constexpr double floor_of_errors = 1e-4;

QLabel* plain_label() {
  auto* label = new QLabel;
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  return label;
}

}  // namespace

MethodsDock::MethodsDock(QWidget* parent)
    : QWidget(parent),
      plot_(new ScatterPlot),
      view_(new QTableView),
      heading_(plain_label()),
      note_(plain_label()),
      figure_(new QComboBox),
      tolerance_(new NumberBox(1e-4, 100, 0.5)),
      rounds_(new QSpinBox),
      explain_(new QPushButton(tr("Predict"))),
      measure_(new QPushButton(tr("Measure all methods"))),
      cancel_(new QPushButton(tr("Cancel"))),
      save_(new QPushButton(tr("Save CSV…"))),
      bar_(new QProgressBar) {
  figure_->addItem(tr("largest"), static_cast<int>(ErrorFigure::maximum));
  figure_->addItem(tr("95 %"), static_cast<int>(ErrorFigure::percentile_95));
  figure_->addItem(tr("mean"), static_cast<int>(ErrorFigure::mean));
  rounds_->setRange(1, 100);
  sorted_.setSourceModel(&table_);
  sorted_.setSortRole(MethodTable::sort_role);
  view_->setModel(&sorted_);
  view_->setAccessibleName(tr("Methods"));
  view_->setSelectionBehavior(QAbstractItemView::SelectRows);
  view_->setSelectionMode(QAbstractItemView::SingleSelection);
  view_->setTabKeyNavigation(false);
  view_->setSortingEnabled(true);
  view_->sortByColumn(MethodTable::seconds, Qt::AscendingOrder);
  view_->verticalHeader()->hide();
  view_->horizontalHeader()->setHighlightSections(false);
  view_->horizontalHeader()->setStretchLastSection(true);
  make_compact(*view_);
  plot_->setAccessibleName(tr("Cost against error"));
  bar_->setAccessibleName(tr("Progress of the measurement"));
  make_layout();
  show_progress(0, 0, {});
  show_rows({}, first_heading(), std::nullopt);
  set_can_save(false);

  connect(explain_, &QPushButton::clicked, this, &MethodsDock::explain_asked);
  connect(measure_, &QPushButton::clicked, this, [this] { Q_EMIT measure_asked(chosen_rounds()); });
  connect(cancel_, &QPushButton::clicked, this, &MethodsDock::cancel_asked);
  connect(save_, &QPushButton::clicked, this, &MethodsDock::save_asked);
  connect(figure_, &QComboBox::currentIndexChanged, this, &MethodsDock::show_figure);
  connect(tolerance_, &QDoubleSpinBox::valueChanged, this, &MethodsDock::show_under);
  connect(tolerance_, &QDoubleSpinBox::editingFinished, this, [this] {
    // Leaving the box is no wish.
    if (tolerance_->hasFocus()) Q_EMIT tolerance_asked(tolerance_->value());
  });
  connect(plot_, &ScatterPlot::clicked, this, &MethodsDock::choose);
  connect(plot_, &ScatterPlot::level_dragged, tolerance_, &QDoubleSpinBox::setValue);
  connect(plot_, &ScatterPlot::level_dropped, this, [this](double level) {
    tolerance_->setValue(level);
    Q_EMIT tolerance_asked(tolerance_->value());
  });
  connect(view_, &QTableView::activated, this,
          [this](const QModelIndex& at) { choose(sorted_.mapToSource(at).row()); });
  connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& at) {
            const int row = at.isValid() ? sorted_.mapToSource(at).row() : -1;
            plot_->set_current(row < plot_->points().size() ? row : -1);
          });
}

QString MethodsDock::first_heading() {
  return tr(
      "Predict (Ctrl+M) asks the server what each method would cost on this scene, and how far it "
      "would be off.");
}

void MethodsDock::make_layout() {
  auto* controls = new QHBoxLayout;
  const auto add_named = [&](const QString& name, QWidget* box, const QString& tip) {
    auto* label = new QLabel(name);
    label->setBuddy(box);
    label->setToolTip(tip);
    box->setToolTip(tip);
    controls->addWidget(label);
    controls->addWidget(box);
  };
  explain_->setToolTip(tr("Ctrl+M; some pixels of the scene by every method"));
  measure_->setToolTip(tr("The whole picture by every method, one after the other"));
  controls->addWidget(explain_);
  controls->addWidget(measure_);
  add_named(tr("&rounds"), rounds_, tr("Renderings of each method; the quickest counts"));
  controls->addWidget(bar_, 1);
  controls->addWidget(cancel_);
  controls->addWidget(save_);
  controls->addStretch();
  add_named(tr("Δ&E00"), figure_, tr("Which figure of the error the plot shows"));
  add_named(tr("&Tolerance"), tolerance_,
            tr("ΔE00 at most: the server chooses the quickest method that keeps to it"));
  auto* split = new QSplitter;
  split->addWidget(plot_);
  split->addWidget(view_);
  split->setSizes({500, 500});
  split->setChildrenCollapsible(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addLayout(controls);
  layout->addWidget(heading_);
  layout->addWidget(note_);
  layout->addWidget(split, 1);
}

ErrorFigure MethodsDock::shown_figure() const {
  return static_cast<ErrorFigure>(figure_->currentData().toInt());
}

void MethodsDock::show_rows(const QList<MethodRow>& rows, const QString& heading,
                            const std::optional<double>& tolerance) {
  table_.set_rows(rows, front_of(rows, shown_figure()));
  heading_->setText(heading);
  // What is being typed stays, and so does the line where there is no goal any more.
  if (std::exchange(goal_, tolerance) != tolerance && tolerance) {
    const QSignalBlocker quiet(tolerance_);
    tolerance_->setValue(*tolerance);
  }
  tolerance_->setEnabled(!rows.isEmpty());
  view_->setColumnHidden(MethodTable::bound,
                         std::none_of(rows.begin(), rows.end(),
                                      [](const MethodRow& row) { return row.bound.has_value(); }));
  show_figure();
  for (int column = 0; column < MethodTable::came; ++column) view_->resizeColumnToContents(column);
}

void MethodsDock::show_figure() {
  const ErrorFigure figure = shown_figure();
  table_.set_rows(QList<MethodRow>(rows()), front_of(rows(), figure));
  plot_->set_axes(tr("seconds"), tr("ΔE00, %1").arg(figure_->currentText()), method_families());
  show_under(tolerance_->value());
}

/// A tolerance is of the largest error, and so is its line.
void MethodsDock::show_under(double tolerance) {
  const ErrorFigure figure = shown_figure();
  plot_->set_points(
      method_points(rows(), figure, rows().isEmpty() ? std::nullopt : std::optional(tolerance)),
      floor_of_errors);
  const bool has_line = figure == ErrorFigure::maximum && !rows().isEmpty();
  plot_->set_level(has_line ? std::optional(tolerance) : std::nullopt,
                   goal_
                       ? tr("tolerance %1").arg(tolerance, 0, 'g', 3)
                       : tr("no tolerance is set; drag to choose by %1").arg(tolerance, 0, 'g', 3),
                   goal_.has_value());
  QStringList front;
  for (const ScatterPoint& point : plot_->points())
    if (point.front) front << point.name;
  plot_->setAccessibleDescription(
      tr("%1 methods; on the Pareto front, the cheapest first: %2")
          .arg(QString::number(plot_->points().size()), front.join(QStringLiteral(", "))));
}

void MethodsDock::show_note(const QString& note) {
  note_->setText(note);
  note_->setVisible(!note.isEmpty());
}

void MethodsDock::show_progress(unsigned job, unsigned jobs, const QString& method) {
  const bool busy = jobs > 0;
  bar_->setVisible(busy);
  cancel_->setVisible(busy);
  measure_->setEnabled(!busy);
  explain_->setEnabled(!busy);
  rounds_->setEnabled(!busy);
  if (!busy) return;
  bar_->setRange(0, static_cast<int>(jobs));
  bar_->setValue(static_cast<int>(job) - 1);
  bar_->setFormat(tr("%1 of %2: %3").arg(job).arg(jobs).arg(method));
}

void MethodsDock::choose(int row) {
  if (row < 0 || row >= rows().size() || !rows()[row].failure.isEmpty()) return;
  view_->setCurrentIndex(sorted_.mapFromSource(table_.index(row, 0)));
  Q_EMIT method_asked(rows()[row].method);
}

}  // namespace metamer::gui
