#include "client/gui/spectra/metamer_dialog.h"

#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMessageBox>

#include "client/gui/plot/plot_style.h"
#include "client/gui/spectra/compact_table.h"
#include "client/gui/spectra/spectrum_curve.h"

namespace metamer::gui {

MetamerDialog::MetamerDialog(const Listed& original, const Viewer& viewer, QWidget* parent)
    : QDialog(parent),
      given_(original),
      plot_(new SpectrumPlot),
      table_(new QTableWidget),
      told_(new QLabel) {
  setWindowTitle(tr("Make a metamer"));
  setObjectName(QStringLiteral("metamer"));
  resize(940, 560);
  table_->setColumnCount(4);
  table_->setHorizontalHeaderLabels({tr("Under"), tr("ΔE00"), tr("ΔE*ab"), tr("ΔE*uv")});
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setAccessibleName(tr("Differences by light"));
  make_compact(*table_);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->setMinimumWidth(280);
  told_->setWordWrap(true);
  told_->setTextFormat(Qt::PlainText);
  auto* row = new QHBoxLayout;
  row->addWidget(plot_, 3);
  row->addWidget(table_, 2);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(make_choices(viewer));
  layout->addLayout(row, 1);
  layout->addWidget(told_);
  layout->addWidget(make_buttons());
  connect(&maker_, &MetamerMaker::made, this, &MetamerDialog::take);
  connect(&maker_, &MetamerMaker::failed, this, &MetamerDialog::refuse);
  draw_spectra(*plot_, given_ ? QList<Listed>{given_} : QList<Listed>());
}

QWidget* MetamerDialog::make_choices(const Viewer& viewer) {
  original_ =
      new SpectrumBox(test_color_names(), given_ ? given_->label() : QStringLiteral("TCS05"));
  original_->setAccessibleName(tr("Original"));
  const bool daylight = viewer.light_word != QStringLiteral("A");
  under_ = new SpectrumBox(illuminant_names(), viewer.light_word);
  against_ =
      new SpectrumBox(illuminant_names(), daylight ? QStringLiteral("A") : QStringLiteral("D65"));
  observer_ = new ObserverBox;
  observer_->set_word(viewer.observer_word);
  auto* choices = new QWidget;
  auto* row = new QHBoxLayout(choices);
  row->setContentsMargins(0, 0, 0, 0);
  auto* left = new QFormLayout;
  left->addRow(tr("O&riginal"), original_);
  left->addRow(tr("&Observer"), observer_);
  auto* right = new QFormLayout;
  right->addRow(tr("Looks alike &under"), under_);
  right->addRow(tr("&Differs under"), against_);
  row->addLayout(left, 1);
  row->addSpacing(16);
  row->addLayout(right, 1);
  return choices;
}

QWidget* MetamerDialog::make_buttons() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  make_ = new QPushButton(tr("&Make"));
  make_->setDefault(true);
  save_ = new QPushButton(tr("&Save…"));
  save_->setAutoDefault(false);
  save_->setEnabled(false);
  auto* close = new QPushButton(tr("Close"));
  close->setAutoDefault(false);
  row->addStretch();
  for (QPushButton* one : {make_, save_, close}) row->addWidget(one);
  connect(make_, &QPushButton::clicked, this, &MetamerDialog::make);
  connect(save_, &QPushButton::clicked, this, &MetamerDialog::save);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  return buttons;
}

void MetamerDialog::make() {
  MetamerOrder order{.original = original_->word(),
                     .samples = {},
                     .under = under_->word(),
                     .against = against_->word(),
                     .observer = observer_->word()};
  if (given_ && order.original == given_->label()) {
    order.original = given_->word();
    order.samples = {given_, &given_->spectrum()};
  }
  make_->setEnabled(false);
  told_->setText(tr("looking for a metamer…"));
  maker_.make(order);
}

void MetamerDialog::take(const std::shared_ptr<const MadeMetamer>& metamer) {
  made_ = metamer;
  make_->setEnabled(true);
  save_->setEnabled(true);
  told_->setText(tr("They look alike under %1.").arg(under_->word()));
  const QString label = QString::fromStdString(made_->original.label);
  plot_->set_curves({curve_of(made_->original.spectrum(), label),
                     curve_of(made_->metamer.spectrum(), tr("metamer of %1").arg(label))},
                    tr("reflectance"));
  table_->setRowCount(static_cast<int>(made_->differences.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const LightDifference& one = made_->differences[row];
    table_->setItem(row, 0, new QTableWidgetItem(one.light));
    int column = 0;
    for (const double value : {one.de00, one.deab, one.deuv}) {
      auto* item = new QTableWidgetItem(QString::number(value, 'f', 2));
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(row, ++column, item);
    }
  }
  Q_EMIT shown();
}

void MetamerDialog::refuse(const QString& why) {
  make_->setEnabled(true);
  told_->setText(why);
  Q_EMIT shown();
}

void MetamerDialog::save() {
  QString file = QFileDialog::getSaveFileName(this, tr("Save the metamer"), {},
                                              tr("CGATS (*.sp);;All files (*)"));
  if (file.isEmpty()) return;
  if (const Result<void> done = save_text(file, made_->text); !done) {
    QMessageBox::warning(this, windowTitle(), QString::fromStdString(done.error().message));
    return;
  }
  Q_EMIT saved(file);
}

}  // namespace metamer::gui
