#pragma once

#include <string>

namespace metamer::extremes {

/// Markdown: the largest errors of every form, and of every form at every extreme, in each build;
/// then the hemispherical reflectances. Without GLSL where this machine has no GL.
std::string report();

}  // namespace metamer::extremes
