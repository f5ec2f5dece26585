#include "server/worker/scene_import.h"

#include <chrono>
#include <utility>

#include "server/scene/compile.h"

namespace metamer::worker {
namespace {

using Clock = std::chrono::steady_clock;
using Outcome = tl::expected<ImportedScene, std::vector<Problem>>;

Outcome import(v1::Scene message, AssetNames names, int of_objects, KnownFiles known,
               const WorkerOptions& options, const std::atomic<bool>& cancelled) {
  const auto start = Clock::now();
  auto compiled = compile_scene(message, options.assets(names),
                                known.meshes.reusing(options.meshes(names, cancelled), names),
                                known.textures.reusing(options.textures(names), names), cancelled,
                                known.skies.reusing(options.skies(names), names));
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  ImportedScene result;
  const auto compiled_at = Clock::now();
  result.timing.set_compile(std::chrono::duration<double>(compiled_at - start).count());
  result.space = CameraSpace::of(*compiled);
  result.objects_key = objects_key(message, *compiled, {names.begin(), names.begin() + of_objects});
  result.scene = std::make_unique<RenderScene>(std::move(*compiled));
  result.space.place(*result.scene);
  result.renderer =
      options.backend->make_renderer(*result.scene, geometry_key(result.objects_key, result.space));
  if (!result.renderer->prepare(cancelled)) return tl::unexpected(std::vector<Problem>());
  result.timing.set_acceleration(std::chrono::duration<double>(Clock::now() - compiled_at).count());
  result.message = std::move(message);
  result.names = std::move(names);
  result.of_objects = of_objects;
  result.known = {std::move(known.meshes).asked(), std::move(known.textures).asked(),
                  std::move(known.skies).asked()};
  return result;
}

}  // namespace

SceneImport::SceneImport(v1::Scene message, AssetNames names, int of_objects, KnownFiles known,
                         const WorkerOptions& options, std::function<void()> done) {
  outcome_ = std::async(std::launch::async,
                        [this, message = std::move(message), names = std::move(names), of_objects,
                         known = std::move(known), &options, done = std::move(done)]() mutable {
                          // Also where something is thrown.
                          struct Last {
                            std::atomic<bool>& is_done;
                            const std::function<void()>& tell;
                            ~Last() {
                              is_done = true;
                              tell();
                            }
                          } const last{done_, done};
                          return import(std::move(message), std::move(names), of_objects,
                                        std::move(known), options, cancelled_);
                        });
}

SceneImport::~SceneImport() {
  cancel();
  if (outcome_.valid()) outcome_.wait();
}

}  // namespace metamer::worker
