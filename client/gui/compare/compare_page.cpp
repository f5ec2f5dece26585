#include "client/gui/compare/compare_page.h"

#include <QDropEvent>
#include <QFileDialog>
#include <QMimeData>
#include <QVBoxLayout>
#include <utility>

#include "client/gui/app/on_pool.h"

namespace metamer::gui {
namespace {

QString xyz_text(const float* xyz) {
  return QStringLiteral("%1 %2 %3")
      .arg(static_cast<double>(xyz[0]), 0, 'f', 4)
      .arg(static_cast<double>(xyz[1]), 0, 'f', 4)
      .arg(static_cast<double>(xyz[2]), 0, 'f', 4);
}

}  // namespace

ComparePage::ComparePage(PicturesAtHand at_hand, QWidget* parent)
    : PicturePage(parent),
      canvas_(new Canvas),
      map_(new Canvas),
      legend_(new RampLegend),
      histogram_(new HistogramPlot),
      numbers_(new QLabel),
      verdict_(new QLabel),
      pixel_(new QLabel),
      told_(new QLabel) {
  setObjectName(QStringLiteral("compare"));
  setAcceptDrops(true);
  canvas_->setAccessibleName(tr("Pictures A and B"));
  map_->setAccessibleName(tr("Map of the differences"));
  setFocusProxy(canvas_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addWidget(make_slots(at_hand));
  layout->addWidget(make_choices());
  layout->addWidget(told_);
  layout->addWidget(make_pictures(), 1);
  layout->addWidget(make_numbers());
  told_->setWordWrap(true);
  told_->setTextFormat(Qt::PlainText);
  told_->setAccessibleName(tr("What was said last"));
  link_canvases();
  tell(tr("Choose two pictures of one size, or drop them here."));
}

Metric ComparePage::metric() const { return static_cast<Metric>(metric_->currentData().toInt()); }

CompareChoice ComparePage::choice() const {
  return {.observer = observer_->word(),
          .under = under_->word(),
          .white = white_->word(),
          .metric = metric(),
          .top = top_->value()};
}

void ComparePage::add(const PictureSource& source) {
  slots_[slots_[0]->source() ? 1 : 0]->set_source(source);
}

void ComparePage::set_metric(Metric metric) {
  metric_->setCurrentIndex(metric_->findData(static_cast<int>(metric)));
}

void ComparePage::set_limit(double limit) { limit_->setValue(limit); }

void ComparePage::swap() {
  const auto a = slots_[0]->source(), b = slots_[1]->source();
  if (!a || !b) return;
  slots_[0]->set_source(*b);
  slots_[1]->set_source(*a);
}

void ComparePage::load_both() {
  for (std::size_t i = 0; i < 2; ++i)
    if (slots_[i]->source()) load(i);
}

void ComparePage::load(std::size_t i) {
  pictures_[i].reset();
  on_pool(
      this,
      [source = *slots_[i]->source(), choice = choice()] { return load_compared(source, choice); },
      [this, i, mine = ++loads_[i]](const Result<ComparedPicture>& picture) {
        if (mine != loads_[i]) return;
        if (!picture) return refuse(QString::fromStdString(format(picture.error())));
        pictures_[i] = *picture;
        slots_[i]->tell(QString::fromStdString(picture->xyz->what));
        ask();
      });
}

void ComparePage::ask() {
  ++asked_;
  show_pictures();
  if (!pictures_[0] || !pictures_[1]) return;
  on_pool(
      this,
      [a = *pictures_[0], b = *pictures_[1], choice = choice()] { return compared(a, b, choice); },
      [this, mine = asked_](const Result<std::shared_ptr<const Comparison>>& made) {
        if (mine != asked_) return;
        if (!made) return refuse(QString::fromStdString(made.error().message));
        take(*made);
      });
}

void ComparePage::take(const std::shared_ptr<const Comparison>& comparison) {
  comparison_ = comparison;
  tell(comparison_->notes.join(QLatin1Char('\n')));
  map_->set_image(comparison_->map);
  map_->set_view(canvas_->view());
  legend_->set_scale(comparison_->top, metric_->currentText());
  const ErrorStatistics& all = comparison_->difference.statistics;
  const client::Pixel at = client::pixel_at(all.at, comparison_->difference.width);
  const auto text = [](double value) { return QString::number(value, 'g', 4); };
  const QString place = QStringLiteral("(%1, %2)").arg(at.x).arg(at.y);
  QString lines =
      tr("<b>%1</b>, white %2, %3<br>mean %4 · median %5 · 95 % %6 · 99 % %7 · "
         "<a href=\"maximum\">maximum %8 at %9</a>")
          .arg(metric_->currentText(),
               QString::fromStdString(comparison_->white.name).toHtmlEscaped(),
               comparison_->observer.toHtmlEscaped(), text(all.mean), text(all.median),
               text(all.percentile_95), text(all.percentile_99), text(all.maximum), place);
  if (all.not_finite > 0)
    lines += tr("<br>%L1 pixels have no finite colour (red)").arg(all.not_finite);
  numbers_->setText(lines);
  save_->setEnabled(true);
  judge();
  Q_EMIT shown();
}

void ComparePage::judge() {
  if (!comparison_) return;
  std::optional<double> limit;
  if (limit_->value() > 0) limit = limit_->value();
  const client::Histogram& histogram = comparison_->histogram;
  histogram_->set_histogram(histogram.counts, histogram.top, metric_->currentText(), limit);
  if (!limit) return verdict_->clear();
  if (!client::is_over(comparison_->difference.statistics, *limit))
    return verdict_->setText(tr("✓ pass: no pixel is above it"));
  const std::size_t over = client::pixels_over(comparison_->difference, *limit);
  verdict_->setText(over == 1 ? tr("✗ fail: 1 pixel is above it")
                              : tr("✗ fail: %L1 pixels are above it").arg(over));
}

void ComparePage::refuse(const QString& why) {
  ++asked_;
  comparison_.reset();
  map_->set_image({});
  numbers_->clear();
  verdict_->clear();
  save_->setEnabled(false);
  show_pictures();
  tell(why);
  Q_EMIT shown();
}

ComparePage::Side ComparePage::side() const { return static_cast<Side>(sides_->checkedId()); }

void ComparePage::show_side(Side side) {
  if (side == this->side()) return;
  sides_->button(static_cast<int>(side))->setChecked(true);
  show_pictures();
}

void ComparePage::show_pictures() {
  const auto shown = [&](std::size_t i) { return pictures_[i] ? pictures_[i]->shown : ShownXyz{}; };
  const ShownXyz a = shown(0), b = shown(1);
  const bool both =
      a.xyz && b.xyz && a.xyz->width == b.xyz->width && a.xyz->height == b.xyz->height;
  const bool second = side() == Side::b ? b.xyz != nullptr : a.xyz == nullptr;
  canvas_->set_picture(second ? b : a);
  canvas_->set_wipe(side() == Side::wipe && both ? b : ShownXyz{});
  Q_EMIT side_changed();
}

void ComparePage::go_to_maximum() {
  if (!comparison_) return;
  const Difference& difference = comparison_->difference;
  const client::Pixel at = client::pixel_at(difference.statistics.at, difference.width);
  const QPoint pixel(static_cast<int>(at.x), static_cast<int>(at.y));
  canvas_->show_pixel(pixel);
  read_out(pixel);
}

void ComparePage::read_out(const std::optional<QPoint>& pixel) {
  if (!pixel || !comparison_) return pixel_->clear();
  const auto x = pixel->x(), y = pixel->y();
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(comparison_->map.width()) +
                  static_cast<std::size_t>(x);
  pixel_->setText(tr("(%1, %2)  A %3  B %4  %5 %6")
                      .arg(x)
                      .arg(y)
                      .arg(xyz_text(comparison_->a.xyz->image.at(x, y)),
                           xyz_text(comparison_->b.xyz->image.at(x, y)), metric_->currentText())
                      .arg(comparison_->difference.values[at], 0, 'g', 4));
}

void ComparePage::save() {
  if (!comparison_) return;
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save the map"), {}, tr("Pictures (*.png)"));
  if (file.isEmpty()) return;
  on_pool(
      this,
      [comparison = comparison_, metric = metric(), file] {
        return save_map(*comparison, metric, file);
      },
      [this, file](const Result<void>& saved) {
        tell(saved ? tr("%1 is written").arg(file) : QString::fromStdString(format(saved.error())));
      });
}

void ComparePage::tell(const QString& text) {
  told_->setText(text);
  told_->setVisible(!text.isEmpty());
}

void ComparePage::dragEnterEvent(QDragEnterEvent* event) {
  if (!dragged_picture(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void ComparePage::dropEvent(QDropEvent* event) {
  add({dragged_picture(*event->mimeData())});
  event->acceptProposedAction();
}

}  // namespace metamer::gui
