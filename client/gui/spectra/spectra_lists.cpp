#include "client/gui/spectra/spectra_lists.h"

#include "client/gui/app/on_pool.h"
#include "client/tools/spectra/scene_spectra.h"

namespace metamer::gui {
namespace {

/// What came of reading spectra.
struct ReadSpectra {
  QList<Listed> rows;
  QStringList faults;

  void add(client::WordedSpectrum&& worded, const Viewer& viewer) {
    Result<Listed> row = listed(std::move(worded), viewer);
    if (row)
      rows << *row;
    else
      faults << QString::fromStdString(row.error().message);
  }
};

ReadSpectra read_words(const QStringList& words, const Viewer& viewer) {
  ReadSpectra read;
  for (const QString& word : words) {
    auto found = client::worded_spectra(word.toStdString());
    if (!found) {
      const client::SpectrumFault& fault = found.error();
      read.faults << QString::fromStdString(fault.choice ? fault.problem.message
                                                         : format(fault.problem, fault.source));
      continue;
    }
    for (client::WordedSpectrum& one : *found) read.add(std::move(one), viewer);
  }
  return read;
}

ReadSpectra read_scene(const v1::Scene& scene, const QString& folder, const Viewer& viewer) {
  client::SceneSpectra found = client::scene_spectra(scene, folder.toStdString());
  ReadSpectra read;
  for (client::WordedSpectrum& one : found.spectra) read.add(std::move(one), viewer);
  for (const Problem& one : found.problems) read.faults << QString::fromStdString(format(one));
  return read;
}

QList<Listed> as_seen_by(const QList<Listed>& rows, const Viewer& viewer) {
  QList<Listed> seen;
  for (const Listed& row : rows) seen << listed(row->worded, viewer).value_or(row);
  return seen;
}

}  // namespace

SpectraLists::SpectraLists(QObject* parent) : QObject(parent) {
  for (SpectraTable* table : {&lights_, &materials_})
    connect(table, &SpectraTable::refused, this, &SpectraLists::refused);
}

void SpectraLists::add(const QStringList& words) {
  on_pool(
      this, [words, viewer = viewer_] { return read_words(words, viewer); },
      [this, view = asked_](const ReadSpectra& read) {
        take(read.rows, view);
        if (!read.faults.isEmpty()) Q_EMIT refused(read.faults.join(QLatin1Char('\n')));
      });
}

void SpectraLists::add_scene(const v1::Scene& scene, const QString& folder) {
  on_pool(
      this, [scene, folder, viewer = viewer_] { return read_scene(scene, folder, viewer); },
      [this, view = asked_](const ReadSpectra& read) {
        take(read.rows, view);
        if (!read.faults.isEmpty()) Q_EMIT refused(read.faults.join(QLatin1Char('\n')));
      });
}

void SpectraLists::take(const QList<Listed>& rows, quint64 view) {
  for (const Listed& row : rows) (row->emission() ? lights_ : materials_).add(row);
  // Somebody else looks meanwhile.
  if (view != asked_) look_again();
  Q_EMIT added(rows);
}

void SpectraLists::set_viewer(const QString& observer, const QString& light) {
  const quint64 mine = ++asked_;
  on_pool(
      this, [observer, light] { return Viewer::of(observer, light); },
      [this, mine](const Result<Viewer>& viewer) {
        if (mine != asked_) return;
        if (!viewer) return Q_EMIT refused(QString::fromStdString(viewer.error().message));
        viewer_ = *viewer;
        look_again();
      });
}

/// Rows that came or changed meanwhile make it start anew.
void SpectraLists::look_again() {
  const QList<Listed> lights = lights_.rows(), materials = materials_.rows();
  using Seen = std::pair<QList<Listed>, QList<Listed>>;
  on_pool(
      this,
      [lights, materials, viewer = viewer_] {
        return Seen(as_seen_by(lights, viewer), as_seen_by(materials, viewer));
      },
      [this, lights, materials, mine = asked_](const Seen& seen) {
        if (mine != asked_) return;
        if (lights_.rows() != lights || materials_.rows() != materials) return look_again();
        lights_.set_viewer(viewer_);
        materials_.set_viewer(viewer_);
        lights_.replace(seen.first);
        materials_.replace(seen.second);
        Q_EMIT viewer_changed();
      });
}

}  // namespace metamer::gui
