#pragma once

#include <map>
#include <memory>
#include <string>

#include "server/gl/program.h"
#include "server/scene/render_scene.h"

namespace metamer::gl {

/// What a renderer runs.
struct Programs {
  Program triangles, spheres;                     ///< Names of what is seen.
  Program shade, finish;                          ///< For each light.
  Program pass_triangles, pass_spheres, combine;  ///< Of MultiPass, where it is asked for.
};

/// Compiled programs, for all jobs of a context. Compiling takes longer than many a picture, and
/// what a program depends on is only which models a scene uses.
class ProgramCache {
 public:
  /// For the scene's models and no others. Errors: the compiler's words.
  Result<std::shared_ptr<const Programs>> get(const RenderScene& scene, bool multi_pass);

 private:
  static constexpr std::size_t most = 32;                         ///< Then it begins anew.
  std::map<std::string, std::shared_ptr<const Programs>> known_;  ///< By what they depend on.
};

}  // namespace metamer::gl
