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
  Program places;                                 ///< For each light, where it is wanted.
  Program pass_triangles, pass_spheres, combine;  ///< Of MultiPass, where it is wanted.
};

/// Compiled programs, for all jobs of a context. Compiling takes longer than many a picture, and
/// what a program depends on is only which models a scene uses.
class ProgramCache {
 public:
  /// What not every picture needs.
  struct Wanted {
    bool places = false;  ///< A shading interpolates over triangles.
    bool passes = false;
  };
  /// For the scene's models and no others. Errors: the compiler's words.
  Result<std::shared_ptr<const Programs>> get(const RenderScene& scene, Wanted wanted);

 private:
  static constexpr std::size_t most = 32;                         ///< Then it begins anew.
  std::map<std::string, std::shared_ptr<const Programs>> known_;  ///< By what they depend on.
};

}  // namespace metamer::gl
