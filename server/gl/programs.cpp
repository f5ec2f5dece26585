#include "server/gl/programs.h"

#include "server/gl/materials.h"
#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

std::string stages(std::initializer_list<const char*> names) {
  std::string text;
  for (const char* name : names) text += shader_text("stages/" + std::string(name) + ".glsl");
  return text;
}

/// Draws four wavelengths of everything at a time.
Result<void> add_passes(const std::string& models, Programs& programs) {
  const std::string version = "#version 450\n";
  const std::string fragment =
      stages({"camera", "geometry", "angles", "surface", "shadow", "color", "reflect"});
  auto triangles = Program::raster(
      version + stages({"camera", "geometry", "triangles.vert"}),
      models + fragment + "#define PRIMITIVE uint(gl_PrimitiveID)\n" + stages({"passes.frag"}));
  auto spheres = Program::raster(
      version + stages({"camera", "geometry", "spheres.vert"}),
      models + fragment + "flat in uint sphere;\n#define PRIMITIVE (first_sphere | sphere)\n" +
          stages({"passes.frag"}));
  auto combine = Program::compute(version + stages({"camera", "combine.comp"}));
  for (const auto* program : {&triangles, &spheres, &combine})
    if (!*program) return tl::unexpected(program->error());
  programs.pass_triangles = std::move(*triangles);
  programs.pass_spheres = std::move(*spheres);
  programs.combine = std::move(*combine);
  return {};
}

Result<Programs> compile(const std::string& models, bool multi_pass) {
  const std::string version = "#version 450\n";
  auto triangles = Program::raster(version + stages({"camera", "geometry", "triangles.vert"}),
                                   version + stages({"triangles.frag"}));
  auto spheres = Program::raster(version + stages({"camera", "geometry", "spheres.vert"}),
                                 version + stages({"camera", "geometry", "spheres.frag"}));
  auto shade =
      Program::compute(models + stages({"camera", "geometry", "angles", "surface", "shadow",
                                        "color", "gather", "reflect", "shade.comp"}));
  auto finish = Program::compute(models + stages({"camera", "color", "gather", "finish.comp"}));
  for (const auto* program : {&triangles, &spheres, &shade, &finish})
    if (!*program) return tl::unexpected(program->error());
  Programs programs;
  programs.triangles = std::move(*triangles);
  programs.spheres = std::move(*spheres);
  programs.shade = std::move(*shade);
  programs.finish = std::move(*finish);
  if (multi_pass)
    if (auto done = add_passes(models, programs); !done) return tl::unexpected(done.error());
  return programs;
}

}  // namespace

Result<std::shared_ptr<const Programs>> ProgramCache::get(const RenderScene& scene,
                                                          bool multi_pass) {
  const std::string models = material_source(scene);
  const std::string key = (multi_pass ? "passes" : "") + models;
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  auto compiled = compile(models, multi_pass);
  if (!compiled) return tl::unexpected(compiled.error());
  if (known_.size() >= most) known_.clear();
  return known_[key] = std::make_shared<const Programs>(std::move(*compiled));
}

}  // namespace metamer::gl
