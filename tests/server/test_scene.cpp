#include "tests/server/test_scene.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/methods/method.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "server/scene/compile.h"

namespace metamer::test {

v1::Scene parse_scene(const std::string& text) {
  v1::Scene scene;
  if (!google::protobuf::TextFormat::ParseFromString(text, &scene))
    throw std::invalid_argument("the test's scene has a mistake");
  return scene;
}

RenderScene compile_text(const std::string& text, const Files& files) {
  const std::atomic<bool> never = false;
  const AssetReader assets = [&](const std::string& name) -> Result<std::string> {
    const auto found = files.find(name);
    if (found == files.end()) return problem("no such asset here");
    return found->second;
  };
  auto compiled =
      compile_scene(parse_scene(text), assets, import_here(assets), textures_of(assets), never);
  if (!compiled)
    throw std::invalid_argument(compiled.error().front().field + ": " +
                                compiled.error().front().message);
  return std::move(*compiled);
}

std::array<float, 3> resolve(const Method& method, const Gather& gather) {
  return method.resolve(gather, 1, *method.make_scratch());
}

Rendered render(const std::string& scene_text, const Files& files) {
  const RenderScene scene = to_camera_space(compile_text(scene_text, files));
  const v1::Settings settings = with_defaults(parse_scene(scene_text).settings());
  const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
  const auto method = make_method(plan, scene);
  const std::atomic<bool> never = false;
  std::atomic<std::uint64_t> work = 0;
  const auto geometry = cpu::EmbreeScene::build(scene, never);
  const cpu::Tracer tracer(scene, *geometry, plan);

  Rendered picture{plan.width(), plan.height(), {}, 0};
  picture.xyz.assign(std::size_t{plan.width()} * plan.height() * 3, -1.0f);
  const Film film{picture.xyz.data(), plan.width(), plan.height()};
  auto workspace = tracer.make_workspace();
  FilmSink sink(*method, film, plan.spp());
  const std::uint32_t size = plan.tile_size();
  for (std::uint32_t y = 0; y < plan.height(); y += size)
    for (std::uint32_t x = 0; x < plan.width(); x += size)
      tracer.render({x, y, std::min(size, plan.width() - x), std::min(size, plan.height() - y)},
                    sink, workspace, never, work);
  picture.rays = workspace.rays.rays();
  return picture;
}

}  // namespace metamer::test
