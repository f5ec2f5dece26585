#pragma once

#include <QList>
#include <QPointF>
#include <QString>
#include <QWidget>
#include <optional>
#include <vector>

#include "client/gui/plot/axis_scale.h"
#include "common/problem.h"

class QCPItemText;
class QCustomPlot;

namespace metamer::gui {

/// A thing of two numbers.
struct ScatterPoint {
  QString name;
  double x = 0, y = 0;
  double whisker = 0;                ///< A thin line goes up to there; below y: there is none.
  int family = 0;                    ///< Those of one family share a mark and a colour.
  std::optional<QPointF> came = {};  ///< What came of it, with a thin line from the point.
  bool front = false;                ///< On the line of the front, with its name beside it.
  bool chosen = false;               ///< With a ring.
  bool faint = false;
};

/// Points over two axes, each logarithmic where its values differ by more than twice; their front;
/// a level that can be dragged. A click chooses a point; the mouse is told what is under it. A menu
/// saves the plot.
class ScatterPlot : public QWidget {
  Q_OBJECT
 public:
  explicit ScatterPlot(QWidget* parent = nullptr);

  void set_axes(const QString& x, const QString& y, const QStringList& families);
  /// `floor`: smaller values of y, down to 0, stand there.
  void set_points(const QList<ScatterPoint>& points, double floor);
  const QList<ScatterPoint>& points() const { return points_; }
  /// Of x and y, as the points need them.
  const AxisScale& x_scale() const { return x_; }
  const AxisScale& y_scale() const { return y_; }

  /// A horizontal line; nothing: there is none. `solid`: it counts, and is not only an offer.
  void set_level(const std::optional<double>& level, const QString& name, bool solid);
  const std::optional<double>& level() const { return level_; }
  /// The point with the frame of who walks through them; -1: none.
  void set_current(int point);

  /// Where a point and a level are, in pixels of this widget.
  QPoint place_of(int point) const;
  QPoint place_of_level() const;

  /// Into a .pdf, a .png (both as on paper) or a .csv, a line a point. Errors: another extension;
  /// it can't be written.
  Result<void> save(const QString& file);
  void save_as();

 Q_SIGNALS:
  void clicked(int point);
  void level_dragged(double level);  ///< On its way.
  void level_dropped(double level);

 protected:
  void changeEvent(QEvent*) override;
  void contextMenuEvent(QContextMenuEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void draw(const QPalette& palette);
  void draw_points(const QPalette& palette);
  void draw_front(const QPalette& palette);
  void draw_marks(const QPalette& palette);
  void draw_beyond(double x, const QPointF& end, const QColor& ink);
  void draw_level(const QPalette& palette);
  void wrap_legend();
  void scale_axes();
  void place_names();
  QPointF pixel(const QPointF& point) const;
  QPointF shown(const ScatterPoint& point) const;
  int point_at(const QPointF& place) const;
  bool is_on_level(const QPointF& place) const;
  void move_mouse(const QPointF& place);
  double level_at(const QPointF& place) const;
  QString csv() const;

  QCustomPlot* plot_;
  QStringList families_;
  QList<ScatterPoint> points_;
  AxisScale x_, y_;
  double floor_ = 0;
  std::optional<double> level_;
  QString level_name_;
  bool level_counts_ = false, dragging_ = false;
  int current_ = -1, pressed_ = -1;
  std::vector<std::pair<int, QCPItemText*>> names_;  ///< Of the front's points.
};

}  // namespace metamer::gui
