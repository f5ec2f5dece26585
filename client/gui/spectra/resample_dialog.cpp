#include "client/gui/spectra/resample_dialog.h"

#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QFontDatabase>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMessageBox>
#include <QPushButton>
#include <QSplitter>
#include <algorithm>
#include <cmath>

#include "client/gui/app/number_box.h"
#include "client/gui/app/on_pool.h"
#include "client/gui/plot/plot_style.h"
#include "client/gui/spectra/compact_table.h"
#include "client/gui/spectra/dialog_button.h"
#include "client/gui/spectra/spectrum_curve.h"
#include "client/tools/scene/observers.h"

namespace metamer::gui {
namespace {

QDoubleSpinBox* make_nm_box(double value, const QString& name) {
  auto* box = new NumberBox(0.001, 1e5, value);
  box->setSuffix(QStringLiteral(" nm"));
  box->setAccessibleName(name);
  return box;
}

QString percents(double share) { return QStringLiteral("%1 %").arg(100 * share, 0, 'g', 3); }

QString significant(double value) { return QString::number(value, 'g', 6); }

/// What became of it between which of the new samples.
QString worst_change(const EnergyCheck& energy) {
  if (!(energy.before > 0) || energy.worst == 0) return QStringLiteral("–");
  return ResampleDialog::tr("%1 between %2 and %3 nm")
      .arg(percents(energy.worst / energy.before), significant(energy.worst_from),
           significant(energy.worst_to));
}

QStringList energy_row(const client::LoadedSpectrum& one, const client::ResampledRow& row) {
  const EnergyCheck& energy = row.made.energy;
  const double whole = energy.before + energy.outside;
  const QString none = QStringLiteral("–");
  return {QString::fromStdString(one.label),
          significant(energy.before),
          significant(energy.after),
          energy.before > 0 ? percents((energy.after - energy.before) / energy.before) : none,
          worst_change(energy),
          whole > 0 ? percents(energy.outside / whole) : none,
          QString::number(row.made.without_data)};
}

}  // namespace

ResampleDialog::ResampleDialog(const QList<Listed>& rows, const Viewer& viewer, QWidget* parent)
    : QDialog(parent), plot_(new SpectrumPlot), energies_(new QTableWidget), told_(new QLabel) {
  setWindowTitle(tr("Resample"));
  setObjectName(QStringLiteral("resample"));
  resize(1040, 700);
  for (const Listed& row : rows) spectra_.push_back(row->spectrum());

  energies_->setColumnCount(7);
  energies_->setHorizontalHeaderLabels({tr("Spectrum"), tr("∫ before"), tr("∫ after"), tr("Change"),
                                        tr("Most"), tr("Outside"), tr("Without data")});
  energies_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  energies_->setAccessibleName(tr("Energy before and after"));
  make_compact(*energies_);
  energies_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  told_->setWordWrap(true);
  told_->setTextFormat(Qt::PlainText);
  text_ = new QPlainTextEdit;
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text_->setAccessibleName(tr("Text of the spectra"));
  text_->setTabChangesFocus(true);

  auto* right = new QSplitter(Qt::Vertical);
  for (QWidget* one : std::initializer_list<QWidget*>{plot_, energies_, text_})
    right->addWidget(one);
  right->setSizes({300, 140, 180});
  auto* row = new QHBoxLayout;
  row->addWidget(make_choices(viewer));
  row->addWidget(right, 1);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(row, 1);
  layout->addWidget(told_);
  layout->addWidget(make_format());

  quiet_.setSingleShot(true);
  quiet_.setInterval(120);
  connect(&quiet_, &QTimer::timeout, this, &ResampleDialog::ask);
  ask();
}

QWidget* ResampleDialog::make_choices(const Viewer& viewer) {
  auto* choices = new QWidget;
  choices->setMaximumWidth(280);
  auto* form = new QFormLayout(choices);
  form->setContentsMargins(0, 0, 8, 0);
  uniform_ = new QRadioButton(tr("&Uniform"));
  listed_ = new QRadioButton(tr("&Listed"));
  uniform_->setChecked(true);
  from_ = make_nm_box(400, tr("From"));
  to_ = make_nm_box(700, tr("To"));
  step_ = make_nm_box(5, tr("Step"));
  wavelengths_ = new QPlainTextEdit;
  wavelengths_->setAccessibleName(tr("Wavelengths in nm"));
  wavelengths_->setPlaceholderText(QStringLiteral("400 436 546 700"));
  wavelengths_->setTabChangesFocus(true);
  lights_first_ = new QCheckBox(tr("Lights &first"));
  lights_first_->setChecked(true);
  normalised_ = new QCheckBox(tr("Lights &normalised to"));
  luminance_ = new NumberBox(1e-6, 1e9, 1);
  luminance_->setAccessibleName(tr("Luminance"));
  observer_ = new ObserverBox;
  observer_->set_word(viewer.observer_word);

  form->addRow(uniform_);
  form->addRow(tr("From"), from_);
  form->addRow(tr("To"), to_);
  form->addRow(tr("Step"), step_);
  form->addRow(listed_);
  form->addRow(wavelengths_);
  form->addRow(lights_first_);
  form->addRow(normalised_);
  form->addRow(tr("Lu&minance"), luminance_);
  form->addRow(tr("&Observer"), observer_);

  const auto again = [this] { quiet_.start(); };
  connect(uniform_, &QRadioButton::toggled, this, again);
  for (QDoubleSpinBox* box : {from_, to_, step_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] {
      uniform_->setChecked(true);
      quiet_.start();
    });
  connect(wavelengths_, &QPlainTextEdit::textChanged, this, [this] {
    listed_->setChecked(true);
    quiet_.start();
  });
  connect(luminance_, &QDoubleSpinBox::valueChanged, this, again);
  for (QCheckBox* box : {lights_first_, normalised_})
    connect(box, &QCheckBox::toggled, this, again);
  connect(observer_, &ObserverBox::chosen, this, again);
  return choices;
}

QWidget* ResampleDialog::make_format() {
  auto* bottom = new QWidget;
  auto* row = new QHBoxLayout(bottom);
  row->setContentsMargins(0, 0, 0, 0);
  format_ = new QComboBox;
  format_->setAccessibleName(tr("Format"));
  format_->addItem(tr("Pairs"), static_cast<int>(SpectrumFormat::pairs));
  format_->addItem(tr("Uniform"), static_cast<int>(SpectrumFormat::uniform));
  format_->addItem(tr("CGATS"), static_cast<int>(SpectrumFormat::cgats));
  format_->setCurrentIndex(spectra_.size() > 1 ? 2 : 0);
  connect(format_, &QComboBox::activated, this, &ResampleDialog::ask);
  auto* label = new QLabel(tr("Te&xt as"));
  label->setBuddy(format_);
  row->addWidget(label);
  row->addWidget(format_);
  row->addStretch();
  add_button(*row, tr("&Copy"), this, &ResampleDialog::copy);
  add_button(*row, tr("&Save…"), this, &ResampleDialog::save);
  add_button(*row, tr("Save plo&t…"), this, [this] { plot_->save_as(); });
  add_button(*row, tr("Close"), this, &QDialog::reject);
  return bottom;
}

void ResampleDialog::set_uniform(double from, double to, double step) {
  from_->setValue(from);
  to_->setValue(to);
  step_->setValue(step);
  uniform_->setChecked(true);
  ask();
}

void ResampleDialog::set_listed(const QString& wavelengths) {
  wavelengths_->setPlainText(wavelengths);
  listed_->setChecked(true);
  ask();
}

Result<Wavelengths> ResampleDialog::wavelengths() const {
  return uniform_->isChecked()
             ? Wavelengths::uniform(from_->value(), to_->value(), step_->value())
             : client::listed_wavelengths(wavelengths_->toPlainText().toStdString());
}

void ResampleDialog::ask() {
  quiet_.stop();
  const quint64 mine = ++asked_;
  const Result<Wavelengths> nm = wavelengths();
  if (!nm) return refuse(QString::fromStdString(nm.error().message));
  if (spectra_.empty()) return refuse(tr("there are no spectra"));
  client::ResampleChoice choice{
      .wavelengths = *nm,
      .lights_first = lights_first_->isChecked(),
      .format = static_cast<SpectrumFormat>(format_->currentData().toInt())};
  if (normalised_->isChecked()) choice.luminance = luminance_->value();
  using Made = Result<Shown>;
  on_pool(
      this,
      [spectra = spectra_, choice, word = observer_->word().toStdString()]() mutable -> Made {
        const auto observer = client::load_observer(word);
        if (!observer) return tl::unexpected(observer.error().problem);
        choice.observer = *observer;
        return std::make_shared<const client::ResampledSet>(client::resampled_set(spectra, choice));
      },
      [this, mine](const Made& made) {
        if (mine != asked_) return;
        if (!made) return refuse(QString::fromStdString(made.error().message));
        show_set(**made);
      });
}

void ResampleDialog::show_set(const client::ResampledSet& set) {
  tell(set.text ? QString() : QString::fromStdString(set.text.error().message));
  text_->setPlainText(QString::fromStdString(set.text.value_or(std::string())));
  draw(set);
  list(set);
  Q_EMIT shown();
}

void ResampleDialog::draw(const client::ResampledSet& set) {
  const auto is_light = [](const client::LoadedSpectrum& one) { return one.emission(); };
  const bool lights = std::any_of(spectra_.begin(), spectra_.end(), is_light);
  const bool both = lights && !std::all_of(spectra_.begin(), spectra_.end(), is_light);
  QList<Curve> curves;
  for (const client::ResampledRow& row : set.rows) {
    const client::LoadedSpectrum& one = spectra_[row.original];
    Curve before = curve_of(one.spectrum(), QString::fromStdString(one.label));
    Curve after = curve_of(row.made.spectrum.spectrum, tr("%1, resampled").arg(before.name));
    before.right = after.right = both && one.emission();
    after.dashed = true;
    curves << before << after;
  }
  const QString power = tr("relative power"), share = tr("reflectance");
  plot_->set_curves(curves, both || !lights ? share : power, both ? power : QString());
}

void ResampleDialog::list(const client::ResampledSet& set) {
  energies_->setRowCount(static_cast<int>(set.rows.size()));
  for (int row = 0; row < energies_->rowCount(); ++row) {
    const client::ResampledRow& one = set.rows[static_cast<std::size_t>(row)];
    const QStringList texts = energy_row(spectra_[one.original], one);
    for (int column = 0; column < texts.size(); ++column)
      energies_->setItem(row, column, new QTableWidgetItem(texts[column]));
  }
}

void ResampleDialog::tell(const QString& text) {
  told_->setText(text);
  told_->setVisible(!text.isEmpty());
}

void ResampleDialog::refuse(const QString& why) {
  tell(why);
  text_->clear();
  energies_->setRowCount(0);
  Q_EMIT shown();
}

void ResampleDialog::copy() { QApplication::clipboard()->setText(text()); }

void ResampleDialog::save() {
  const bool cgats = format_->currentData().toInt() == static_cast<int>(SpectrumFormat::cgats);
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Save the spectra"), {},
      cgats ? tr("CGATS (*.sp);;All files (*)") : tr("Text (*.txt);;All files (*)"));
  if (file.isEmpty()) return;
  if (const Result<void> saved = save_text(file, text()); !saved)
    QMessageBox::warning(this, windowTitle(), QString::fromStdString(saved.error().message));
}

}  // namespace metamer::gui
