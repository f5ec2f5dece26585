#include "client/gui/spectra/rgb_dialog.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMessageBox>
#include <QPushButton>

#include "client/gui/app/number_box.h"
#include "client/gui/app/on_pool.h"
#include "client/gui/plot/plot_style.h"
#include "client/gui/spectra/compact_table.h"
#include "client/gui/spectra/dialog_button.h"
#include "client/tools/scene/words.h"

namespace metamer::gui {
namespace {

/// What came of it: a row for each spectrum, or why there is none.
struct RgbRows {
  QList<RgbRow> rows;
  QStringList said;
};

RgbRows rgb_rows(const std::vector<client::LoadedSpectrum>& spectra, const QString& observer,
                 const QString& light, double luminance, const v1::Development& development) {
  RgbRows made;
  const Result<Viewer> viewer = Viewer::of(observer, light);
  if (!viewer) return {{}, {QString::fromStdString(viewer.error().message)}};
  for (const client::LoadedSpectrum& one : spectra) {
    const auto rgb =
        client::spectrum_rgb(one, viewer->light, viewer->observer, luminance, development);
    if (!rgb) return {{}, {QString::fromStdString(rgb.error().message)}};
    const QString label = QString::fromStdString(one.label);
    if (rgb->dark) made.said << RgbDialog::tr("%1: its light is dark: all is 0").arg(label);
    if (!rgb->unadapted.empty())
      made.said << RgbDialog::tr("%1: not adapted: %2")
                       .arg(label, QString::fromStdString(rgb->unadapted));
    if (!rgb->shown_white.empty())
      made.said << QStringLiteral("%1: %2").arg(label, QString::fromStdString(rgb->shown_white));
    made.rows << RgbRow{label, *rgb};
  }
  return made;
}

}  // namespace

RgbDialog::RgbDialog(const QList<Listed>& rows, const Viewer& viewer, QWidget* parent)
    : QDialog(parent), view_(new QTableView), told_(new QLabel) {
  setWindowTitle(tr("RGB of spectra"));
  setObjectName(QStringLiteral("rgb"));
  resize(1000, 480);
  for (const Listed& row : rows) spectra_.push_back(row->spectrum());
  view_->setModel(&table_);
  view_->setAccessibleName(tr("X Y Z and RGB"));
  make_compact(*view_);
  view_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  told_->setWordWrap(true);
  told_->setTextFormat(Qt::PlainText);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(make_choices(viewer));
  layout->addWidget(view_, 1);
  layout->addWidget(told_);
  layout->addWidget(make_buttons());
  ask();
}

QWidget* RgbDialog::make_choices(const Viewer& viewer) {
  observer_ = new ObserverBox;
  observer_->set_word(viewer.observer_word);
  light_ = new SpectrumBox(illuminant_names(), viewer.light_word);
  light_->setAccessibleName(tr("Light of materials"));
  luminance_ = new NumberBox(1e-6, 1e6, 1);
  space_ = new QComboBox;
  for (const std::string& word : client::words_of(*v1::RgbSpace_descriptor()))
    space_->addItem(
        QString::fromStdString(find_rgb_space(word) ? find_rgb_space(word)->name : word),
        QString::fromStdString(word));
  adaptation_ = new QComboBox;
  adaptation_->addItem(tr("As a screen of D65 shows it"), QString());
  for (const std::string& word : client::words_of(*v1::Adaptation_descriptor()))
    adaptation_->addItem(QString::fromStdString(word), QString::fromStdString(word));
  linear_ = new QCheckBox(tr("&Linear"));

  auto* choices = new QWidget;
  auto* row = new QHBoxLayout(choices);
  row->setContentsMargins(0, 0, 0, 0);
  auto* left = new QFormLayout;
  left->addRow(tr("&Observer"), observer_);
  left->addRow(tr("Materials &under"), light_);
  left->addRow(tr("Lu&minance of the light"), luminance_);
  auto* right = new QFormLayout;
  right->addRow(tr("&Space"), space_);
  right->addRow(tr("&Adaptation"), adaptation_);
  right->addRow(linear_);
  row->addLayout(left, 1);
  row->addSpacing(16);
  row->addLayout(right, 1);

  connect(observer_, &ObserverBox::chosen, this, &RgbDialog::ask);
  connect(light_, &SpectrumBox::chosen, this, &RgbDialog::ask);
  connect(luminance_, &QDoubleSpinBox::valueChanged, this, &RgbDialog::ask);
  for (QComboBox* box : {space_, adaptation_})
    connect(box, &QComboBox::currentIndexChanged, this, &RgbDialog::ask);
  connect(linear_, &QCheckBox::toggled, this, &RgbDialog::ask);
  return choices;
}

QWidget* RgbDialog::make_buttons() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch();
  add_button(*row, tr("&Copy"), this, &RgbDialog::copy);
  add_button(*row, tr("Sa&ve…"), this, &RgbDialog::save);
  add_button(*row, tr("Close"), this, &QDialog::reject);
  return buttons;
}

void RgbDialog::set_space(const QString& word) { space_->setCurrentIndex(space_->findData(word)); }

void RgbDialog::set_adaptation(const QString& word) {
  adaptation_->setCurrentIndex(adaptation_->findData(word));
}

v1::Development RgbDialog::development() const {
  v1::Development development;
  if (const auto space = client::rgb_space_named(space_->currentData().toString().toStdString()))
    development.set_rgb_space(*space);
  const std::string adaptation = adaptation_->currentData().toString().toStdString();
  if (!adaptation.empty())
    if (const auto named = client::adaptation_named(adaptation)) development.set_adaptation(*named);
  development.set_linear(linear_->isChecked());
  return development;
}

void RgbDialog::ask() {
  const quint64 mine = ++asked_;
  on_pool(
      this,
      [spectra = spectra_, observer = observer_->word(), light = light_->word(),
       luminance = luminance_->value(), development = development()] {
        return rgb_rows(spectra, observer, light, luminance, development);
      },
      [this, mine](const RgbRows& made) {
        if (mine != asked_) return;
        table_.set_rows(made.rows);
        told_->setText(made.said.join(QLatin1Char('\n')));
        told_->setVisible(!made.said.isEmpty());
        Q_EMIT shown();
      });
}

void RgbDialog::copy() { QApplication::clipboard()->setText(table_.text()); }

void RgbDialog::save() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save the table"), {}, tr("Text, tabs (*.tsv)"));
  if (file.isEmpty()) return;
  if (const Result<void> saved = save_text(file, table_.text()); !saved)
    QMessageBox::warning(this, windowTitle(), QString::fromStdString(saved.error().message));
}

}  // namespace metamer::gui
