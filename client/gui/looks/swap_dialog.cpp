#include "client/gui/looks/swap_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/gui/looks/look_command.h"
#include "client/tools/scene/light_words.h"
#include "client/tools/scene/look_change.h"
#include "common/spectral/cie.h"

namespace metamer::gui {
namespace {

constexpr int material_role = Qt::UserRole;  ///< Of a row of the list that is another's paint.

/// The spectra that a material has, by their place in the list of properties.
const v1::Spectrum* property_of(const v1::Material& material, int property) {
  if (property == 0) return material.has_diffuse() ? &material.diffuse() : nullptr;
  return material.has_specular() ? &material.specular() : nullptr;
}

}  // namespace

/// What a word means.
struct SwapDialog::Found {
  v1::Spectrum message;
  Spectrum curve;  ///< To be drawn.
};

SwapDialog::SwapDialog(Document& document, Swapped what, QWidget* parent)
    : QDialog(parent),
      document_(document),
      what_(what),
      before_(document.look()),
      target_(new QComboBox),
      property_(new QComboBox),
      word_(new QLineEdit),
      list_(new QListWidget),
      plot_(new SpectrumPlot),
      fault_(new QLabel) {
  const bool light = what == Swapped::light;
  setWindowTitle(light ? tr("Light") : tr("Swap paint"));
  auto* form = new QFormLayout(this);
  form->addRow(light ? tr("&Light:") : tr("&Material:"), target_);
  property_->addItems({tr("diffuse"), tr("specular")});
  if (!light) form->addRow(tr("&Property:"), property_);
  property_->setVisible(!light);
  auto* line = new QHBoxLayout;
  auto* file = new QPushButton(tr("&File…"));
  line->addWidget(word_);
  line->addWidget(file);
  auto* name = new QLabel(tr("&Spectrum:"));
  name->setBuddy(word_);
  form->addRow(name, line);
  word_->setAccessibleName(tr("Spectrum"));
  word_->setPlaceholderText(light ? tr("F11, D:6504K, 2856K, 436nm:0.6+546nm, lamps.csv#warm")
                                  : tr("TCS09, red.txt, paints.sp#red, red.csv@percent"));
  form->addRow(tr("&or one of:"), list_);
  plot_->setMinimumHeight(200);
  form->addRow(plot_);
  fault_->setWordWrap(true);
  form->addRow(fault_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  use_ = buttons->button(QDialogButtonBox::Ok);
  use_->setText(tr("&Use"));
  use_->setEnabled(false);
  form->addRow(buttons);
  fill_targets();
  fill_list();
  resize(480, 620);

  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(target_, &QComboBox::currentIndexChanged, this, &SwapDialog::preview);
  connect(property_, &QComboBox::currentIndexChanged, this, &SwapDialog::start_reading);
  connect(file, &QPushButton::clicked, this, &SwapDialog::browse);
  connect(word_, &QLineEdit::textEdited, this, &SwapDialog::set_word);
  connect(list_, &QListWidget::currentItemChanged, this, &SwapDialog::choose_row);
}

void SwapDialog::fill_targets() {
  if (!document_.sound()) return;
  const v1::Scene& scene = document_.sound()->scene();
  if (what_ == Swapped::light) {
    target_->addItem(tr("all lights"), QStringLiteral("*"));
    for (const v1::Light& light : scene.light())
      target_->addItem(QString::fromStdString(light.name()), QString::fromStdString(light.name()));
    return;
  }
  for (const v1::Material& material : scene.material())
    target_->addItem(QString::fromStdString(material.name()),
                     QString::fromStdString(material.name()));
}

void SwapDialog::fill_list() {
  const bool light = what_ == Swapped::light;
  for (const std::string& name : light ? cie::illuminant_names() : cie::test_color_names())
    list_->addItem(QString::fromStdString(name));
  if (light || !document_.sound()) return;
  for (const v1::Material& material : document_.sound()->scene().material()) {
    const QString name = QString::fromStdString(material.name());
    auto* row = new QListWidgetItem(tr("the paint of %1").arg(name), list_);
    row->setData(material_role, name);
  }
}

void SwapDialog::set_target(const QString& name) {
  target_->setCurrentIndex(std::max(0, target_->findData(name)));
}

void SwapDialog::set_word(const QString& word) {
  copied_.clear();
  if (word_->text() != word) word_->setText(word);
  start_reading();
}

void SwapDialog::choose_row(QListWidgetItem* row) {
  if (row == nullptr) return;
  const QString material = row->data(material_role).toString();
  if (material.isEmpty()) return set_word(row->text());
  word_->clear();
  copied_ = material;
  start_reading();
}

void SwapDialog::browse() {
  const QString folder =
      document_.sound() ? QString::fromStdString(document_.sound()->folder().string()) : QString();
  const QString file = QFileDialog::getOpenFileName(this, tr("A spectrum"), folder);
  if (!file.isEmpty()) set_word(file);
}

/// On the thread pool, as it may be a file.
void SwapDialog::start_reading() {
  const auto scene = document_.sound();
  if (!scene) return;
  const unsigned number = ++asked_;
  std::optional<v1::Spectrum> copied;
  for (const v1::Material& material : scene->scene().material())
    if (material.name() == copied_.toStdString())
      if (const v1::Spectrum* there = property_of(material, property_->currentIndex()))
        copied = *there;
  const auto work = [scene, copied, word = word_->text().trimmed().toStdString(),
                     role = what_ == Swapped::light ? SpectrumRole::emission
                                                    : SpectrumRole::property] {
    const Result<v1::Spectrum> message =
        copied ? *copied : client::embedded_spectrum(word, role, scene->folder());
    return message.and_then([&](const v1::Spectrum& one) {
      return load_spectrum(one, {}, role,
                           [&](const std::string& name) { return scene->read_asset(name); })
          .map([&](Spectrum&& curve) {
            return Found{one, std::move(curve)};
          });
    });
  };
  on_pool(this, work, [this, number](const Result<Found>& found) {
    if (number == asked_) take(found);
  });
}

void SwapDialog::take(const Result<Found>& found) {
  chosen_.reset();
  if (found) {
    chosen_ = found->message;
    plot_->set_curves({{.name = copied_.isEmpty() ? word_->text() : copied_,
                        .wavelengths = found->curve.nm,
                        .values = found->curve.values}},
                      what_ == Swapped::light ? tr("power, relative") : tr("reflectance"));
  }
  fault_->setText(found ? QString() : QString::fromStdString(found.error().message));
  use_->setEnabled(is_chosen());
  preview();
  Q_EMIT settled();
}

client::Look SwapDialog::changed() const {
  client::Look look = before_;
  const std::string name = target_->currentData().toString().toStdString();
  if (what_ == Swapped::light) {
    v1::LookLight light;
    light.set_name(name);
    *light.mutable_spectrum() = *chosen_;
    client::set_light(light, look);
  } else {
    v1::LookMaterial material;
    material.set_name(name);
    *(property_->currentIndex() == 0 ? material.mutable_diffuse() : material.mutable_specular()) =
        *chosen_;
    client::set_material(material, look);
  }
  return look;
}

void SwapDialog::preview() { document_.set_look(is_chosen() ? changed() : before_); }

QString SwapDialog::command_text() const {
  const QString what = copied_.isEmpty() ? word_->text() : copied_;
  return tr("%1: %2").arg(target_->currentText(), what);
}

void SwapDialog::done(int result) {
  document_.set_look(before_);
  if (result == QDialog::Accepted && is_chosen())
    document_.undo().push(new LookCommand(document_, changed(), command_text()));
  QDialog::done(result);
}

}  // namespace metamer::gui
