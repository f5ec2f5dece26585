#include "server/gl/programs.h"

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

/// Compiles one program after the other until one does not.
class Compiler {
 public:
  explicit Compiler(std::string models)
      : models_(std::move(models)),
        surface_(models_ + stages({"camera", "geometry", "angles", "surface", "shadow", "color"})) {
  }

  void add_basics() {
    const std::string triangles = stages({"camera", "geometry", "triangles.vert"});
    keep(programs_.triangles, [&] {
      return Program::raster(version + triangles, version + stages({"triangles.frag"}));
    });
    keep(programs_.spheres, [&] {
      return Program::raster(version + stages({"camera", "geometry", "spheres.vert"}),
                             version + stages({"camera", "geometry", "spheres.frag"}));
    });
    keep(programs_.shade, [&] {
      return Program::compute(surface_ + stages({"gather", "reflect", "shade.comp"}));
    });
    keep(programs_.finish, [&] {
      return Program::compute(models_ + stages({"camera", "color", "gather", "finish.comp"}));
    });
  }

  void add_places() {
    keep(programs_.places, [&] {
      return Program::compute(surface_ + stages({"reflect", "places.comp"}));
    });
  }

  void add_passes() {
    const auto draw = [&](const char* vertex, const char* primitive) {
      return Program::raster(version + stages({"camera", "geometry", vertex}),
                             surface_ + primitive + stages({"reflect", "passes.frag"}));
    };
    keep(programs_.pass_triangles,
         [&] { return draw("triangles.vert", "#define PRIMITIVE uint(gl_PrimitiveID)\n"); });
    keep(programs_.pass_spheres, [&] {
      return draw("spheres.vert",
                  "flat in uint sphere;\n#define PRIMITIVE (first_sphere | sphere)\n");
    });
    keep(programs_.combine, [&] {
      return Program::compute(version + stages({"camera", "combine.comp"}));
    });
  }

  Result<Programs> finish() {
    if (!done_) return tl::unexpected(done_.error());
    return std::move(programs_);
  }

 private:
  void keep(Program& to, const auto& compile) {
    if (!done_) return;
    Result<Program> program = compile();
    if (program)
      to = std::move(*program);
    else
      done_ = tl::unexpected(program.error());
  }

  std::string models_;
  std::string surface_;  ///< What evaluates a model at a point, but for the stage itself.
  Programs programs_;
  Result<void> done_;
};

}  // namespace

Result<std::shared_ptr<const Programs>> ProgramCache::get(const RenderScene& scene, Wanted wanted) {
  const std::string models = material_source(scene);
  const std::string key =
      std::string(wanted.places ? "places " : "") + (wanted.passes ? "passes " : "") + models;
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  Compiler compiler(models);
  compiler.add_basics();
  if (wanted.places) compiler.add_places();
  if (wanted.passes) compiler.add_passes();
  auto compiled = compiler.finish();
  if (!compiled) return tl::unexpected(compiled.error());
  if (known_.size() >= most) known_.clear();
  return known_[key] = std::make_shared<const Programs>(std::move(*compiled));
}

}  // namespace metamer::gl
