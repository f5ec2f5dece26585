#pragma once

#include <QObject>
#include <QStringList>
#include <memory>

#include "client/gui/spectra/spectra_table.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::gui {

/// The two lists, lights and materials. Spectra are read and looked at in the thread pool.
class SpectraLists : public QObject {
  Q_OBJECT
 public:
  explicit SpectraLists(QObject* parent = nullptr);

  SpectraTable& lights() { return lights_; }
  SpectraTable& materials() { return materials_; }
  const Viewer& viewer() const { return viewer_; }

  /// Files, or names: words as parse_spectrum_word takes them, each with all its spectra.
  void add(const QStringList& words);
  /// Those of a scene whose files are named from `folder`.
  void add_scene(const v1::Scene& scene, const QString& folder);
  /// Shows all as others see them; refused() where there is no such observer or light.
  void set_viewer(const QString& observer, const QString& light);

 Q_SIGNALS:
  /// After add and add_scene: what is in the lists now.
  void added(const QList<Listed>& rows);
  void viewer_changed();
  void refused(const QString& why);

 private:
  void take(const QList<Listed>& rows, quint64 view);
  void look_again();

  SpectraTable lights_{SpectraTable::Kind::lights}, materials_{SpectraTable::Kind::materials};
  Viewer viewer_ = Viewer::usual();
  quint64 asked_ = 0;  ///< Viewers; the newest counts.
};

}  // namespace metamer::gui
