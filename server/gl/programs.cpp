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

Result<Programs> compile(const std::string& models) {
  const std::string version = "#version 450\n";
  auto triangles = Program::raster(version + stages({"camera", "geometry", "triangles.vert"}),
                                   version + stages({"triangles.frag"}));
  auto spheres = Program::raster(version + stages({"camera", "geometry", "spheres.vert"}),
                                 version + stages({"camera", "geometry", "spheres.frag"}));
  auto shade = Program::compute(models + stages({"camera", "geometry", "angles", "surface",
                                                 "shadow", "color", "gather", "shade.comp"}));
  auto finish = Program::compute(models + stages({"camera", "color", "gather", "finish.comp"}));
  for (const auto* program : {&triangles, &spheres, &shade, &finish})
    if (!*program) return tl::unexpected(program->error());
  return Programs{std::move(*triangles), std::move(*spheres), std::move(*shade),
                  std::move(*finish)};
}

}  // namespace

Result<std::shared_ptr<const Programs>> ProgramCache::get(const RenderScene& scene) {
  const std::string models = material_source(scene);
  if (const auto found = known_.find(models); found != known_.end()) return found->second;
  auto compiled = compile(models);
  if (!compiled) return tl::unexpected(compiled.error());
  if (known_.size() >= most) known_.clear();
  return known_[models] = std::make_shared<const Programs>(std::move(*compiled));
}

}  // namespace metamer::gl
