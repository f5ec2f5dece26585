#pragma once

#include <map>
#include <memory>
#include <string>

#include "server/gl/program.h"
#include "server/gl/program_sources.h"

namespace metamer::gl {

/// What a renderer runs: program_sources.h says what each is for.
struct Programs {
  Program triangles, spheres, shade, finish, places, pass_triangles, pass_spheres, combine;
};

/// Compiled programs, for all jobs of a context. Compiling takes longer than many a picture, and
/// what a program depends on is only which models a scene uses.
class ProgramCache {
 public:
  /// For the scene's models and no others. Errors: the compiler's words.
  Result<std::shared_ptr<const Programs>> get(const RenderScene& scene, Wanted wanted);
  /// How often it had to compile.
  std::size_t compiled() const { return compiled_; }

 private:
  static constexpr std::size_t most = 32;  ///< Then it begins anew.
  std::size_t compiled_ = 0;
  std::map<std::string, std::shared_ptr<const Programs>> known_;  ///< By what they depend on.
};

}  // namespace metamer::gl
