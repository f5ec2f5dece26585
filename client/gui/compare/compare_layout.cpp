// What the page that compares pictures is put together from.
#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QRadioButton>
#include <QSplitter>
#include <QVBoxLayout>
#include <utility>

#include "client/gui/app/number_box.h"
#include "client/gui/compare/compare_page.h"

namespace metamer::gui {
namespace {

QDoubleSpinBox* make_delta_box(const QString& name, const QString& none) {
  auto* box = new NumberBox(0, 1e4, 0);
  box->setSpecialValueText(none);
  box->setAccessibleName(name);
  return box;
}

/// Two widgets side by side, as one row of a form.
QWidget* beside(QWidget* one, QWidget* other) {
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(one);
  row->addWidget(other, 1);
  return both;
}

}  // namespace

QWidget* ComparePage::make_slots(const PicturesAtHand& at_hand) {
  auto* both = new QWidget;
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  slots_ = {new SlotBox(tr("A"), at_hand), new SlotBox(tr("B"), at_hand)};
  auto* turn = new QPushButton(tr("⇄ Swap"));
  connect(turn, &QPushButton::clicked, this, &ComparePage::swap);
  row->addWidget(slots_[0], 1);
  row->addWidget(turn);
  row->addWidget(slots_[1], 1);
  for (std::size_t i = 0; i < 2; ++i)
    connect(slots_[i], &SlotBox::chosen, this, [this, i] { load(i); });
  return both;
}

QWidget* ComparePage::make_choices() {
  metric_ = new QComboBox;
  metric_->setAccessibleName(tr("Difference"));
  for (const Metric one : {Metric::de00, Metric::deuv, Metric::deab})
    metric_->addItem(QString::fromUtf8(name_of(one)), static_cast<int>(one));
  white_ = new SpectrumBox(QStringList{QString()} + illuminant_names(), QString());
  white_->setAccessibleName(tr("White"));
  white_->lineEdit()->setPlaceholderText(tr("auto"));
  white_->setToolTip(tr("What looks white; empty: the light of spectra, else sRGB's"));
  under_ = new SpectrumBox(illuminant_names(), QStringLiteral("D65"));
  under_->setAccessibleName(tr("Light of reflectances"));
  observer_ = new ObserverBox;
  top_ = make_delta_box(tr("End of the map's scale"), tr("auto"));
  save_ = new QPushButton(tr("Save &map…"));
  save_->setEnabled(false);
  connect(metric_, &QComboBox::currentIndexChanged, this, &ComparePage::ask);
  connect(top_, &QDoubleSpinBox::valueChanged, this, &ComparePage::ask);
  connect(white_, &SpectrumBox::chosen, this, &ComparePage::ask);
  connect(under_, &SpectrumBox::chosen, this, &ComparePage::load_both);
  connect(observer_, &ObserverBox::chosen, this, &ComparePage::load_both);
  connect(save_, &QPushButton::clicked, this, &ComparePage::save);

  auto* choices = new QWidget;
  auto* rows = new QGridLayout(choices);
  rows->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](int row, int column, const QString& name, QWidget* widget) {
    auto* label = new QLabel(name);
    label->setBuddy(widget);
    rows->addWidget(label, row, column);
    rows->addWidget(widget, row, column + 1);
  };
  rows->addWidget(metric_, 0, 0);
  add(0, 1, tr("&White"), white_);
  add(0, 3, tr("S&cale to"), top_);
  rows->addWidget(save_, 1, 0);
  add(1, 1, tr("Spectra &under"), under_);
  add(1, 3, tr("&Observer"), observer_);
  rows->setColumnStretch(5, 1);
  return choices;
}

QWidget* ComparePage::make_pictures() {
  sides_ = new QButtonGroup(this);
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(canvas_, 1);
  // As high as the legend beside it: both pictures are then alike in size.
  auto* below_left = new QWidget;
  below_left->setFixedHeight(legend_->sizeHint().height());
  auto* row = new QHBoxLayout(below_left);
  row->setContentsMargins(0, 0, 0, 0);
  for (const auto& [text, side] :
       {std::pair(tr("A"), Side::a), {tr("B"), Side::b}, {tr("Wipe"), Side::wipe}}) {
    auto* button = new QRadioButton(text);
    sides_->addButton(button, static_cast<int>(side));
    row->addWidget(button);
  }
  sides_->button(static_cast<int>(Side::wipe))->setChecked(true);
  connect(sides_, &QButtonGroup::idClicked, this, [this] { show_pictures(); });
  row->addWidget(pixel_, 1);
  pixel_->setTextFormat(Qt::PlainText);
  column->addWidget(below_left);

  auto* right = new QWidget;
  auto* below = new QVBoxLayout(right);
  below->setContentsMargins(0, 0, 0, 0);
  below->addWidget(map_, 1);
  below->addWidget(legend_);
  auto* splitter = new QSplitter;
  splitter->addWidget(left);
  splitter->addWidget(right);
  splitter->setChildrenCollapsible(false);
  return splitter;
}

QWidget* ComparePage::make_numbers() {
  limit_ = make_delta_box(tr("Limit"), tr("none"));
  numbers_->setTextFormat(Qt::RichText);
  numbers_->setTextInteractionFlags(Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard |
                                    Qt::TextSelectableByMouse);
  numbers_->setAccessibleName(tr("Statistics"));
  connect(numbers_, &QLabel::linkActivated, this, &ComparePage::go_to_maximum);
  connect(limit_, &QDoubleSpinBox::valueChanged, this, &ComparePage::judge);
  auto* numbers = new QWidget;
  auto* form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  form->addRow(numbers_);
  form->addRow(tr("&Limit"), beside(limit_, verdict_));
  verdict_->setAccessibleName(tr("Verdict"));
  auto* row = new QHBoxLayout(numbers);
  row->setContentsMargins(0, 0, 0, 0);
  row->addLayout(form, 1);
  row->addWidget(histogram_, 1);
  numbers->setMaximumHeight(150);
  return numbers;
}

/// Both show the same place.
void ComparePage::link_canvases() {
  for (const auto& [one, other] : {std::pair(canvas_, map_), std::pair(map_, canvas_)}) {
    connect(one, &Canvas::wheeled, one,
            [one = one](double steps, const QPointF& place) { one->zoom(steps, place); });
    connect(one, &Canvas::dragged, one, [one = one](const QPointF& by) { one->shift(by); });
    connect(one, &Canvas::view_changed, other,
            [one = one, other = other] { other->set_view(one->view()); });
    connect(one, &Canvas::hovered, this, &ComparePage::read_out);
  }
}

}  // namespace metamer::gui
