#include "server/gl/program_sources.h"

#include <initializer_list>

#include "server/gl/lights.h"
#include "server/gl/materials.h"
#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

std::string texts(const std::string& folder, std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += shader_text(folder + name + ".glsl");
  return text;
}

std::string stages(std::initializer_list<const char*> names) { return texts("stages/", names); }

}  // namespace

ProgramSources program_sources(const RenderScene& scene, Wanted wanted) {
  const std::string models = material_source(scene);
  // What evaluates a model at a point, but for the stage itself.
  const std::string surface = models + light_source(scene) +
                              texts("surface/", {"angles", "lift", "places"}) +
                              stages({"camera", "geometry", "surface", "shadow", "color"});
  const std::string triangles = prelude() + stages({"camera", "geometry", "triangles.vert"});
  const std::string spheres = prelude() + stages({"camera", "geometry", "spheres.vert"});

  ProgramSources sources;
  sources.triangles = {triangles, prelude() + stages({"triangles.frag"})};
  sources.spheres = {spheres, prelude() + stages({"camera", "geometry", "spheres.frag"})};
  sources.shade = surface + stages({"gather", "reflect", "shade.comp"});
  sources.finish = models + stages({"camera", "color", "gather", "finish.comp"});
  if (wanted.places) sources.places = surface + stages({"reflect", "places.comp"});
  if (wanted.passes) {
    const std::string pass = stages({"reflect", "passes.frag"});
    sources.pass_triangles = {triangles,
                              surface + "#define PRIMITIVE uint(gl_PrimitiveID)\n" + pass};
    sources.pass_spheres = {
        spheres,
        surface + "flat in uint sphere;\n#define PRIMITIVE (first_sphere | sphere)\n" + pass};
    sources.combine = prelude() + stages({"camera", "combine.comp"});
  }
  return sources;
}

}  // namespace metamer::gl
