#include "client/gui/spectra/listed_spectrum.h"

#include <algorithm>

#include "client/tools/scene/observers.h"

namespace metamer::gui {

Viewer Viewer::usual() {
  return {.observer_word = QString::fromStdString(cie::observer_1931().name()),
          .light_word = QStringLiteral("D65"),
          .observer = cie::observer_1931(),
          .light = *cie::illuminant("D65")};
}

Result<Viewer> Viewer::of(const QString& observer, const QString& light) {
  const auto seeing = client::load_observer(observer.toStdString());
  if (!seeing) return tl::unexpected(seeing.error().problem);
  const auto shining = client::load_one(light.toStdString(), {.use = Use::emission});
  if (!shining) return tl::unexpected(shining.error().problem);
  if (!shining->emission()) return problem(quoted(shining->label) + " is a reflectance, no light");
  if (const std::string fault = client::emission_fault(shining->samples); !fault.empty())
    return problem(quoted(shining->label) + ": " + fault);
  return Viewer{observer, light, *seeing, shining->spectrum()};
}

Result<Listed> listed(client::WordedSpectrum worded, const Viewer& viewer) {
  auto facts = client::spectrum_facts(worded.spectrum, viewer.light, viewer.observer);
  if (!facts) return problem(worded.spectrum.label + ": " + facts.error().message);
  return std::make_shared<const ListedSpectrum>(
      ListedSpectrum{std::move(worded), *std::move(facts)});
}

const client::ObservedLight& seen_by(const client::EmissionFacts& facts, const Viewer& viewer) {
  const auto found = std::find_if(
      facts.observed.begin(), facts.observed.end(),
      [&](const client::ObservedLight& one) { return one.observer == viewer.observer; });
  return found == facts.observed.end() ? facts.observed.front() : *found;
}

}  // namespace metamer::gui
