#pragma once

#include <QImage>
#include <QString>
#include <memory>
#include <optional>

#include "client/gui/picture/shown_xyz.h"
#include "client/tools/pictures/comparison.h"
#include "client/tools/pictures/difference_map.h"

/// Two pictures compared: values, made in the thread pool.
namespace metamer::gui {

/// Where a picture of a slot comes from: a file, or one that is at hand.
struct PictureSource {
  QString file;  ///< Empty: `picture`.
  std::optional<Picture> picture = {};
  PictureChoice choice = {};  ///< Of a file with several.
  QString title() const;
};

/// A picture of a slot, as X Y Z, and what a screen shows of it.
struct ComparedPicture {
  QString title;
  std::shared_ptr<const XyzPicture> xyz;
  ShownXyz shown;
};

/// How spectra are seen, by words, and what looks white.
struct CompareChoice {
  QString observer = QStringLiteral("cie-1931-2deg"), under = QStringLiteral("D65");
  QString white;  ///< A light's word; empty: that of `under` where it lights one, else sRGB's.
  Metric metric = Metric::de00;
  double top = 0;  ///< Of the map's scale; 0: usual_top.
};

/// What came of it.
struct Comparison {
  ComparedPicture a, b;
  Difference difference;
  client::White white;
  QString observer;
  double top = 1;
  client::Histogram histogram;
  QImage map;
  QStringList notes;
};

/// Reads files. Error: that of the first thing that is wrong, with its file.
Result<ComparedPicture> load_compared(const PictureSource& source, const CompareChoice& choice);

/// Errors: other sizes, other units, words that are no observer or light.
Result<std::shared_ptr<const Comparison>> compared(const ComparedPicture& a,
                                                   const ComparedPicture& b,
                                                   const CompareChoice& choice);

/// The map with its legend, as `metamer compare -o` writes it. Writes a .png.
Result<void> save_map(const Comparison& comparison, Metric metric, const QString& file);

}  // namespace metamer::gui
