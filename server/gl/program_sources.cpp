#include "server/gl/program_sources.h"

#include <initializer_list>

#include "server/gl/materials.h"
#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

constexpr const char* version = "#version 450\n";

std::string stages(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += shader_text("stages/" + std::string(name) + ".glsl");
  return text;
}

}  // namespace

ProgramSources program_sources(const RenderScene& scene, Wanted wanted) {
  const std::string models = material_source(scene);
  // What evaluates a model at a point, but for the stage itself.
  const std::string surface =
      models + stages({"camera", "geometry", "angles", "surface", "shadow", "color"});
  const std::string triangles = version + stages({"camera", "geometry", "triangles.vert"});
  const std::string spheres = version + stages({"camera", "geometry", "spheres.vert"});

  ProgramSources sources;
  sources.triangles = {triangles, version + stages({"triangles.frag"})};
  sources.spheres = {spheres, version + stages({"camera", "geometry", "spheres.frag"})};
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
    sources.combine = version + stages({"camera", "combine.comp"});
  }
  return sources;
}

}  // namespace metamer::gl
