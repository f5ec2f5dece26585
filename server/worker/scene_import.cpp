#include "server/worker/scene_import.h"

#include <utility>

#include "server/scene/compile.h"

namespace metamer::worker {
namespace {

using Outcome = tl::expected<ImportedScene, std::vector<Problem>>;

Outcome import(v1::Scene message, AssetNames names, int of_objects, const WorkerOptions& options,
               const std::atomic<bool>& cancelled) {
  auto compiled = compile_scene(message, stored_assets(names, options.store),
                                options.meshes(names, cancelled), cancelled);
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  ImportedScene result;
  result.space = CameraSpace::of(*compiled);
  result.objects_key = objects_key(message, *compiled, {names.begin(), names.begin() + of_objects});
  result.scene = std::make_unique<RenderScene>(std::move(*compiled));
  result.space.place(*result.scene);
  result.renderer =
      options.backend->make_renderer(*result.scene, geometry_key(result.objects_key, result.space));
  if (!result.renderer->prepare(cancelled)) return tl::unexpected(std::vector<Problem>());
  result.message = std::move(message);
  result.names = std::move(names);
  return result;
}

}  // namespace

SceneImport::SceneImport(v1::Scene message, AssetNames names, int of_objects,
                         const WorkerOptions& options, std::function<void()> done) {
  outcome_ =
      std::async(std::launch::async, [this, message = std::move(message), names = std::move(names),
                                      of_objects, &options, done = std::move(done)]() mutable {
        // Also where something is thrown.
        struct Last {
          std::atomic<bool>& is_done;
          const std::function<void()>& tell;
          ~Last() {
            is_done = true;
            tell();
          }
        } const last{done_, done};
        return import(std::move(message), std::move(names), of_objects, options, cancelled_);
      });
}

SceneImport::~SceneImport() {
  cancel();
  if (outcome_.valid()) outcome_.wait();
}

}  // namespace metamer::worker
