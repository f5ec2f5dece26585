#pragma once

#include <memory>

#include "client/gui/picture/picture.h"

namespace metamer::gui {

/// X Y Z and what numbers become of them on a screen. Never changed: copies share it, in any
/// thread.
struct ShownXyz {
  std::shared_ptr<const Image> xyz;  ///< Null: nothing is shown.
  Developing developing = {};
};

/// As its plan says.
ShownXyz shown_xyz(const Picture& picture);
/// As a plan says; as sRGB where there is none, or none that can be.
Developing developing_of(const v1::Plan* plan);

}  // namespace metamer::gui
