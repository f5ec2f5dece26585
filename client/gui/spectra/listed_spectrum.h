#pragma once

#include <QString>
#include <memory>

#include "client/tools/spectra/spectrum_facts.h"
#include "client/tools/spectra/worded_spectra.h"

namespace metamer::gui {

/// Who looks at spectra, and by which light at reflectances.
struct Viewer {
  QString observer_word, light_word;  ///< As the command line has them.
  Observer observer;
  Spectrum light;

  /// The CIE's observer of 1931, and D65.
  static Viewer usual();
  /// Reads files. Error: that of the first word that has one.
  static Result<Viewer> of(const QString& observer, const QString& light);
};

/// A spectrum of a list, and what is to be said of it. Never changed: copies share it.
struct ListedSpectrum {
  client::WordedSpectrum worded;
  client::SpectrumFacts facts;

  const client::LoadedSpectrum& spectrum() const { return worded.spectrum; }
  QString label() const { return QString::fromStdString(spectrum().label); }
  QString word() const { return QString::fromStdString(worded.word); }
  bool emission() const { return spectrum().emission(); }
};
using Listed = std::shared_ptr<const ListedSpectrum>;

/// Errors: those of spectrum_facts.
Result<Listed> listed(client::WordedSpectrum worded, const Viewer& viewer);

/// A light as the viewer's observer sees it.
const client::ObservedLight& seen_by(const client::EmissionFacts& facts, const Viewer& viewer);

}  // namespace metamer::gui
