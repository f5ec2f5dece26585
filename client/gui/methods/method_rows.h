#pragma once

#include <QList>
#include <QString>
#include <optional>
#include <string>

#include "client/gui/plot/scatter_plot.h"
#include "client/tools/tradeoff/tradeoff.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/scene.pb.h"

/// What methods cost and how far they are off: predicted for a scene, measured on it, and what came
/// of those that were used.
namespace metamer::gui {

/// Which of an error's figures is shown.
enum class ErrorFigure { maximum, percentile_95, mean };

/// ΔE00 against the reference.
struct MethodError {
  double mean = 0, percentile_95 = 0, maximum = 0;
  double operator[](ErrorFigure figure) const;
};

/// What came of a method that was used.
struct CameOf {
  double seconds = 0;                     ///< Tables and picture, of the scene's own size.
  std::optional<MethodError> error = {};  ///< Where it was measured.
  QString from = {};                      ///< "job 12", "live"
};

struct MethodRow {
  v1::Method method;  ///< With every default filled in.
  QString name;       ///< "linear 4 observer"
  QString failure;    ///< Why there are no figures; empty: there are.
  double seconds = 0;
  MethodError error;
  std::optional<double> bound = {};  ///< Of predictions: Prediction.bound.
  bool chosen = false;               ///< The scene's own, or its goal's choice.
  std::optional<CameOf> came = {};

  /// The largest ΔE00 that is known of it: what a tolerance asks for.
  double largest() const;
};

QList<MethodRow> predicted_rows(const v1::Plan& plan);
/// The quickest first, those that failed last.
QList<MethodRow> measured_rows(const client::Tradeoff& tradeoff);

/// The row of a method that has figures; -1: there is none. A point method whose lights are the
/// BETTER of two (Point.lights) is also the one that a server made of it.
int find_row(const QList<MethodRow>& rows, const v1::Method& method);
/// As one asks for it: a server chooses the lights of a point method for each scene anew.
v1::Method asked_method(const v1::Method& method);

/// Which of them nothing beats in both; those that failed are not.
std::vector<bool> front_of(const QList<MethodRow>& rows, ErrorFigure figure);

/// The words of the methods, each a family of points.
QStringList method_families();
/// As a plot has them, a point a row: the rows that failed, which have none, are the last. Those
/// whose largest error is above `level` are faint.
QList<ScatterPoint> method_points(const QList<MethodRow>& rows, ErrorFigure figure,
                                  const std::optional<double>& level);

/// What two scenes have in common whose methods can be compared: all but method, goal, threads and
/// the check of every pixel.
std::string comparable_part(const v1::Scene& scene);

/// Whether seconds are so alike that their axis is linear, by axis_scale; "2.46 to 2.56 s" then.
std::optional<QString> alike_seconds(const QList<MethodRow>& rows);

}  // namespace metamer::gui
