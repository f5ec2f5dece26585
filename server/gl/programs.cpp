#include "server/gl/programs.h"

#include "server/gl/lights.h"
#include "server/gl/materials.h"

namespace metamer::gl {
namespace {

Result<Program> compile(const std::string& source) { return Program::compute(source); }
Result<Program> compile(const RasterSource& source) {
  return Program::raster(source.vertex, source.fragment);
}

bool is_wanted(const std::string& source) { return !source.empty(); }
bool is_wanted(const RasterSource& source) { return !source.fragment.empty(); }

/// One program after the other, until one does not compile.
Result<Programs> compile_all(const ProgramSources& sources) {
  Programs programs;
  Result<void> done;
  const auto keep = [&](Program& to, const auto& source) {
    if (!done || !is_wanted(source)) return;
    Result<Program> program = compile(source);
    if (program)
      to = std::move(*program);
    else
      done = tl::unexpected(program.error());
  };
  keep(programs.triangles, sources.triangles);
  keep(programs.spheres, sources.spheres);
  keep(programs.shade, sources.shade);
  keep(programs.finish, sources.finish);
  keep(programs.places, sources.places);
  keep(programs.pass_triangles, sources.pass_triangles);
  keep(programs.pass_spheres, sources.pass_spheres);
  keep(programs.combine, sources.combine);
  if (!done) return tl::unexpected(done.error());
  return programs;
}

}  // namespace

Result<std::shared_ptr<const Programs>> ProgramCache::get(const RenderScene& scene, Wanted wanted) {
  const std::string key = std::string(wanted.places ? "places " : "") +
                          (wanted.passes ? "passes " : "") + material_source(scene) +
                          light_source(scene);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  ++compiled_;
  auto compiled = compile_all(program_sources(scene, wanted));
  if (!compiled) return tl::unexpected(compiled.error());
  if (known_.size() >= most) known_.clear();
  return known_[key] = std::make_shared<const Programs>(std::move(*compiled));
}

}  // namespace metamer::gl
