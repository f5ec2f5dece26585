#pragma once

#include <span>

#include "metamer/v1/scene.pb.h"

namespace metamer::gui {

/// How much work a picture is worth. Size, colour and method stay as they are.
struct Preset {
  const char* name;  ///< "Draft"
  const char* text;  ///< What it sets, for a tool tip.
  std::uint32_t spp, depth;
};
std::span<const Preset> presets();
void apply(const Preset& preset, v1::Settings& settings);

}  // namespace metamer::gui
