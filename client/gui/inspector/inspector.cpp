#include "client/gui/inspector/inspector.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSaveFile>
#include <QVBoxLayout>
#include <utility>

#include "common/scene/probed.h"

namespace metamer::gui {
namespace {

Curve probed_curve(const QString& name, const google::protobuf::RepeatedField<double>& values) {
  Curve curve{.name = name, .wavelengths = {}, .values = {values.begin(), values.end()}};
  for (int i = 0; i < values.size(); ++i) curve.wavelengths.push_back(probed_first_nm + i);
  return curve;
}

QString spot_color_text(const Spot& spot) {
  if (!spot.color) return {};
  const client::PixelReading& color = *spot.color;
  QString text = Inspector::tr("X %1  Y %2  Z %3")
                     .arg(color.xyz[0], 0, 'f', 4)
                     .arg(color.xyz[1], 0, 'f', 4)
                     .arg(color.xyz[2], 0, 'f', 4);
  if (spot.spread)
    text += Inspector::tr("\n± %1    %2    %3")
                .arg((*spot.spread)[0], 0, 'f', 4)
                .arg((*spot.spread)[1], 0, 'f', 4)
                .arg((*spot.spread)[2], 0, 'f', 4);
  if (color.lab)
    text += Inspector::tr("\nL* %1  a* %2  b* %3  (white: %4)")
                .arg(color.lab->l, 0, 'f', 2)
                .arg(color.lab->a, 0, 'f', 2)
                .arg(color.lab->b, 0, 'f', 2)
                .arg(spot.white);
  const auto code = [&](std::size_t c) { return qRound(255 * color.encoded[c]); };
  return text +
         Inspector::tr("\nRGB %1 %2 %3  %4")
             .arg(code(0))
             .arg(code(1))
             .arg(code(2))
             .arg(color.in_gamut ? Inspector::tr("in gamut") : Inspector::tr("✗ out of gamut"));
}

QString spot_object_text(const v1::Probed& probed) {
  const QString material = QString::fromStdString(probed.material()).toHtmlEscaped();
  if (probed.object().empty())
    return material.isEmpty() ? QString() : Inspector::tr("material %1").arg(material);
  const QString name = QString::fromStdString(probed.object()).toHtmlEscaped();
  return QStringLiteral("<a href=\"%1\">%1</a> · %2").arg(name, material);
}

}  // namespace

Inspector::Inspector(QWidget* parent)
    : QWidget(parent),
      place_(new QLabel),
      object_(new QLabel),
      color_(new QLabel),
      missing_(new QLabel),
      pair_(new QLabel),
      chip_(new QLabel),
      parts_(new QVBoxLayout(this)),
      side_(new QSpinBox),
      light_plot_(new SpectrumPlot),
      surface_plot_(new SpectrumPlot),
      pins_(new PinTable(this)),
      table_(new QTableView) {
  parts_->addWidget(make_spot());
  light_plot_->setAccessibleName(tr("Light at this place"));
  surface_plot_->setAccessibleName(tr("Reflectance at this place"));
  parts_->addWidget(light_plot_, 1);
  parts_->addWidget(surface_plot_, 1);
  parts_->addWidget(make_pins(), 1);
  connect(side_, &QSpinBox::valueChanged, this, &Inspector::side_changed);
  connect(object_, &QLabel::linkActivated, this, &Inspector::object_clicked);
  show_spot(std::nullopt);
}

QWidget* Inspector::make_spot() {
  auto* box = new QWidget;
  box->setMinimumWidth(240);
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* top = new QHBoxLayout;
  chip_->setFixedSize(28, 28);
  chip_->setAutoFillBackground(true);
  side_->setRange(1, static_cast<int>(max_probe_side));
  side_->setPrefix(tr("mean of "));
  side_->setSuffix(tr(" px"));
  side_->setAccessibleName(tr("Side of the square"));
  top->addWidget(chip_);
  top->addWidget(place_, 1);
  top->addWidget(side_);
  layout->addLayout(top);
  object_->setTextFormat(Qt::RichText);
  object_->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
  color_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  // What is under the cursor does not move the window's panes.
  for (QLabel* label : {place_, object_, color_, missing_}) {
    label->setWordWrap(true);
    label->setMinimumWidth(1);
  }
  for (QLabel* label : {object_, color_, missing_}) layout->addWidget(label);
  layout->addStretch();
  return box;
}

/// Below the pictures it is wide, beside them it is high.
void Inspector::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  parts_->setDirection(width() > 2 * height() ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

QWidget* Inspector::make_pins() {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  table_->setModel(pins_);
  table_->setAccessibleName(tr("Pins"));
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->verticalHeader()->hide();
  table_->setTabKeyNavigation(false);
  table_->resizeColumnsToContents();
  table_->setMinimumHeight(90);
  layout->addWidget(table_, 1);
  auto* line = new QHBoxLayout;
  auto* remove = new QPushButton(tr("&Remove"));
  auto* csv = new QPushButton(tr("&CSV…"));
  pair_->setWordWrap(true);
  line->addWidget(pair_, 1);
  line->addWidget(remove);
  line->addWidget(csv);
  layout->addLayout(line);
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &Inspector::show_pair);
  connect(remove, &QPushButton::clicked, this, [this] {
    pins_->remove(table_->selectionModel()->selectedRows());
    show_pair();
    Q_EMIT pins_changed();
  });
  connect(csv, &QPushButton::clicked, this, &Inspector::save);
  show_pair();
  return box;
}

void Inspector::show_spot(const std::optional<Spot>& spot) {
  spot_ = spot;
  show_missing({});
  const Spot shown = spot.value_or(Spot{});
  place_->setText(!spot ? tr("Point at a picture")
                        : QStringLiteral("%1 (%2, %3)")
                              .arg(shown.from)
                              .arg(shown.pixel.x())
                              .arg(shown.pixel.y()));
  object_->setText(spot_object_text(shown.probed));
  color_->setText(spot_color_text(shown));
  QPalette palette = chip_->palette();
  palette.setColor(QPalette::Window, shown.color ? chip_of(shown) : QColor(119, 119, 119));
  chip_->setPalette(palette);
  light_plot_->setVisible(!shown.probed.eye().empty());
  surface_plot_->setVisible(!shown.probed.surface().empty());
  if (!shown.probed.eye().empty()) {
    QList<Curve> curves{probed_curve(tr("reaches the eye"), shown.probed.eye())};
    if (!shown.probed.light().empty()) curves << probed_curve(tr("light"), shown.probed.light());
    light_plot_->set_curves(curves, tr("power per nm"));
  }
  if (!shown.probed.surface().empty())
    surface_plot_->set_curves({probed_curve(tr("surface"), shown.probed.surface())},
                              tr("reflectance"));
}

void Inspector::show_missing(const QString& why) {
  missing_->setText(why);
  missing_->setVisible(!why.isEmpty());
}

bool Inspector::pin() {
  if (!spot_ || !spot_->color) return false;
  pins_->add(*spot_);
  table_->resizeColumnsToContents();
  show_pair();
  Q_EMIT pins_changed();
  return true;
}

void Inspector::show_pair() {
  const QModelIndexList rows = table_->selectionModel()->selectedRows();
  if (rows.size() != 2) {
    pair_->setText(tr("Select two pins for their ΔE00"));
    return;
  }
  const Pin &one = pins_->pins()[rows[0].row()], &other = pins_->pins()[rows[1].row()];
  const std::optional<double> apart = delta_e(one.spot, other.spot);
  pair_->setText(apart
                     ? tr("ΔE00 %1–%2: %3").arg(one.number).arg(other.number).arg(*apart, 0, 'f', 2)
                     : tr("no ΔE00: a white is not known"));
}

void Inspector::save() {
  const QString name =
      QFileDialog::getSaveFileName(this, tr("Save the pins"), {}, tr("Tables (*.csv)"));
  if (name.isEmpty()) return;
  QSaveFile file(name);
  const bool saved =
      file.open(QIODevice::WriteOnly) && file.write(to_csv(pins_->pins())) >= 0 && file.commit();
  if (!saved) show_missing(tr("%1: %2").arg(name, file.errorString()));
}

}  // namespace metamer::gui
