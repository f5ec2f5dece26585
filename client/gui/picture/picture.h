#pragma once

#include <QMetaType>
#include <QString>
#include <memory>

#include "client/relight/factors.h"
#include "common/image/image.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::gui {

/// A complete picture, as rooms hand it to each other. Never changed: copies share it, in any
/// thread.
struct Picture {
  QString title;                                     ///< "Job 12", "booth.exr"
  QString from;                                      ///< Of what: a scene's name, a file's path.
  std::shared_ptr<const Image> xyz;                  ///< X Y Z, as rendered; never null.
  std::shared_ptr<const v1::Plan> plan;              ///< Null: of a file that has none.
  std::shared_ptr<const client::Factors> factors{};  ///< Null: they were not kept.
  std::shared_ptr<const v1::Scene> scene{};          ///< As it was sent; null: others sent it.
  /// Of a picture that was given another look: the spectra that its factors are multiplied by.
  std::shared_ptr<const v1::SceneFactors> relit{};

  /// Told from others of that title: "booth.txtpb, job 12".
  QString name() const {
    return from.isEmpty() || title.contains(from) ? title
                                                  : QStringLiteral("%1, %2").arg(title, from);
  }
};

}  // namespace metamer::gui

Q_DECLARE_METATYPE(metamer::gui::Picture)
