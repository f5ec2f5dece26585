#pragma once

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <array>

#include "client/gui/compare/ramp_legend.h"
#include "client/gui/compare/slot_box.h"
#include "client/gui/picture/picture_page.h"
#include "client/gui/plot/histogram_plot.h"
#include "client/gui/spectra/choice_boxes.h"

namespace metamer::gui {

/// Two pictures of one size, and how far they are apart: side by side under a divider, as a map,
/// as numbers.
class ComparePage : public PicturePage {
  Q_OBJECT
 public:
  enum class Side { a, b, wipe };

  explicit ComparePage(PicturesAtHand at_hand, QWidget* parent = nullptr);

  Canvas& canvas() override { return *canvas_; }
  Canvas& map() { return *map_; }
  SlotBox& slot_box(std::size_t i) { return *slots_[i]; }
  /// Into the first slot that is empty, else the second.
  void add(const PictureSource& source);
  void set_metric(Metric metric);
  void set_limit(double limit);
  void show_side(Side side);
  Side side() const;
  /// Null: there is none yet.
  std::shared_ptr<const Comparison> comparison() const { return comparison_; }
  QString statistics() const { return numbers_->text(); }
  QString verdict() const { return verdict_->text(); }
  QString told() const { return told_->text(); }
  void go_to_maximum();
  void save();

 Q_SIGNALS:
  /// Comparison, or what keeps from it, is that of what is chosen.
  void shown();
  void side_changed();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;

 private:
  QWidget* make_slots(const PicturesAtHand& at_hand);
  QWidget* make_choices();
  QWidget* make_pictures();
  QWidget* make_numbers();
  void link_canvases();
  CompareChoice choice() const;
  Metric metric() const;
  void swap();
  void load(std::size_t i);
  void load_both();
  void ask();
  void take(const std::shared_ptr<const Comparison>& comparison);
  void refuse(const QString& why);
  void show_pictures();
  void judge();
  void read_out(const std::optional<QPoint>& pixel);
  void tell(const QString& text);

  std::array<SlotBox*, 2> slots_;
  std::array<std::optional<ComparedPicture>, 2> pictures_;
  std::array<quint64, 2> loads_{};
  quint64 asked_ = 0;
  std::shared_ptr<const Comparison> comparison_;
  Canvas *canvas_, *map_;
  RampLegend* legend_;
  HistogramPlot* histogram_;
  QComboBox* metric_;
  SpectrumBox *under_, *white_;
  ObserverBox* observer_;
  QDoubleSpinBox *top_, *limit_;
  QButtonGroup* sides_;
  QLabel *numbers_, *verdict_, *pixel_, *told_;
  QPushButton* save_;
};

}  // namespace metamer::gui
