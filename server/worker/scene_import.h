#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "common/problem.h"
#include "server/render/renderer.h"
#include "server/scene/camera_space.h"
#include "server/worker/assets.h"
#include "server/worker/job.h"
#include "server/worker/known_meshes.h"
#include "server/worker/known_skies.h"
#include "server/worker/known_textures.h"

namespace metamer::worker {

/// What has been read of a scene's files.
struct KnownFiles {
  KnownMeshes meshes;
  KnownTextures textures;
  KnownSkies skies;
};

/// What a message and its files come to.
struct ImportedScene {
  v1::Scene message;
  AssetNames names;
  int of_objects = 0;  ///< So many of them: objects may be made of these.
  KnownFiles known;
  std::unique_ptr<RenderScene> scene;  ///< In camera space.
  CameraSpace space;
  std::string objects_key;
  std::unique_ptr<Renderer> renderer;  ///< Of that scene; prepared.
  v1::Timing timing;                   ///< Its compile and acceleration.
};

/// Compiles a scene on a thread of its own: meshes may take long, and others want the lane's.
class SceneImport {
 public:
  /// The first `of_objects` of the names are those that objects may be made of; what `known` has of
  /// those that are needed is not read again. Calls `done` from that thread.
  SceneImport(v1::Scene message, AssetNames names, int of_objects, KnownFiles known,
              const WorkerOptions& options, std::function<void()> done);
  ~SceneImport();  ///< Waits until it is done.

  void cancel() { cancelled_ = true; }
  bool is_done() const { return done_; }
  /// Once, when it is done. Errors: what is wrong with the scene.
  tl::expected<ImportedScene, std::vector<Problem>> take() { return outcome_.get(); }

 private:
  std::atomic<bool> cancelled_ = false, done_ = false;
  std::future<tl::expected<ImportedScene, std::vector<Problem>>> outcome_;
};

}  // namespace metamer::worker
