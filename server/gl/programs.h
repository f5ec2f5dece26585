#pragma once

#include <map>
#include <memory>
#include <string>

#include "server/gl/program.h"
#include "server/scene/render_scene.h"

namespace metamer::gl {

/// What a renderer runs: two for the rasteriser, two for each light.
struct Programs {
  Program triangles, spheres, shade, finish;
};

/// Compiled programs, for all jobs of a context. Compiling takes longer than many a picture, and
/// what a program depends on is only which models a scene uses.
class ProgramCache {
 public:
  /// For the scene's models and no others. Errors: the compiler's words.
  Result<std::shared_ptr<const Programs>> get(const RenderScene& scene);

 private:
  static constexpr std::size_t most = 32;                         ///< Then it begins anew.
  std::map<std::string, std::shared_ptr<const Programs>> known_;  ///< By the models' source.
};

}  // namespace metamer::gl
