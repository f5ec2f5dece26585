#include "client/gui/forms/presets.h"

#include <QtGlobal>

namespace metamer::gui {

std::span<const Preset> presets() {
  static constexpr Preset all[] = {
      {QT_TRANSLATE_NOOP("Presets", "Draft"),
       QT_TRANSLATE_NOOP("Presets", "1 sample per pixel, 1 reflection"), 1, 1},
      {QT_TRANSLATE_NOOP("Presets", "Check"),
       QT_TRANSLATE_NOOP("Presets", "16 samples per pixel, 4 reflections"), 16, 4},
      {QT_TRANSLATE_NOOP("Presets", "Final"),
       QT_TRANSLATE_NOOP("Presets", "64 samples per pixel, 8 reflections"), 64, 8},
  };
  return all;
}

void apply(const Preset& preset, v1::Settings& settings) {
  settings.set_spp(preset.spp);
  settings.set_depth(preset.depth);
}

}  // namespace metamer::gui
