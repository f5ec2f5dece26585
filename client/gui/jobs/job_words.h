#pragma once

#include <QList>
#include <QString>
#include <optional>
#include <utility>

#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/session.pb.h"

/// How a job reads in the window.
namespace metamer::gui {

/// Where the time went, in the order in which it went there: a name and seconds. What took none is
/// left out but for the total.
QList<std::pair<QString, double>> timing_rows(const v1::Timing& timing);

/// "0.031 s"; three places.
QString seconds_text(double seconds);

/// "bad.ply:3: object[2].mesh.file: it is no mesh"; on one line, whoever wrote it.
QString problem_line(const v1::Problem& problem);

/// What an event says of how the job stands: "queued, 2 ahead"; empty: nothing new.
QString state_text(const v1::JobEvent& event);

/// A promise and what came of it.
struct Promise {
  bool kept;
  QString text;    ///< "✓ promise kept: ΔE00 at most 0.31; at most 0.5 was asked for"
  QString detail;  ///< promise_text: on how many pixels, by whose eyes.
};
/// Nothing where nothing was measured.
std::optional<Promise> promise_of(const v1::Plan& plan, const v1::Finished& finished);

/// Why a job that was asked for with factors gets none, or nothing where it gets them: the backend
/// has none to give, or there are too many.
std::optional<QString> no_factors(const v1::Scene& scene, const v1::Capabilities& capabilities);
inline constexpr double most_factor_bytes = 4.0 * 1024 * 1024 * 1024;

}  // namespace metamer::gui
