#pragma once

#include <QImage>
#include <QString>
#include <QStringList>
#include <memory>

#include "client/gui/picture/picture.h"
#include "client/tools/pictures/metamerism_sheet.h"
#include "client/tools/scene/checked_scene.h"

/// What is done for a metamerism sheet; in the thread pool.
namespace metamer::gui {

/// What is asked for.
struct SheetWish {
  QStringList lights;  ///< Words, 2 to 8; the first is the reference.
  QStringList paints;  ///< Materials of the scene, or words; 2 or 3, the first is the reference.
  QString painted;     ///< The material that is painted; empty: those that `paints` names.
  double limit = 1;    ///< ΔE00 up to which a paint passes.
};
inline constexpr int least_lights = 2, most_lights = 8;

/// A sheet, with what it was made of.
struct MadeSheet {
  SheetWish wish;
  client::MetamerismSheet made;
  Image picture;  ///< X Y Z, as contact_sheet gives it.
  QImage shown;
  QString title;  ///< Scene, observer, white.
};

/// A scene as it looks now, and a finished picture of it with factors.
struct SheetBase {
  Picture picture;
  v1::Scene wanted;
  std::shared_ptr<const client::CheckedScene> files;
};

/// Errors: a word that is no light or no paint; nothing that is painted; those of relit_scene.
Result<MadeSheet> make_sheet(const SheetBase& base, const SheetWish& wish);

/// Which paint is nearer, and whether it passes, in a sentence.
QString verdict_of(const SheetWish& wish, const std::vector<client::PaintMatch>& matches);

/// The names of two materials that are a metameric pair under these lights; nothing: none are.
std::optional<std::pair<QString, QString>> pair_of(const v1::Scene& scene,
                                                   const client::CheckedScene& files,
                                                   const QStringList& lights);

Result<void> save_sheet_png(const MadeSheet& sheet, const QString& file);
/// A page with title, sentence, sheet and table.
Result<void> save_sheet_pdf(const MadeSheet& sheet, const QString& file);

/// The table as rows of text: paint, light, ΔE00, ΔE*ab, metamerism index (with the additive
/// correction under the reference), whether it passes.
QStringList sheet_headings();
QList<QStringList> sheet_rows(const SheetWish& wish,
                              const std::vector<client::PaintMatch>& matches);

}  // namespace metamer::gui
