#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "metamer/v1/worker.pb.h"
#include "server/worker/scene_import.h"

namespace metamer::worker {

/// The scene of a view, as changes leave it. Keeps everything that a change leaves as it is; where
/// objects would look different, all is imported anew but for meshes that are known. Belongs to the
/// lane's thread.
class ViewScene {
 public:
  using Problems = std::vector<Problem>;

  /// `wake` is called from any thread when an import is done.
  ViewScene(const WorkerOptions& options, std::function<void()> wake);

  /// Begins an import. Errors: what can be said before.
  Problems open(v1::Scene scene, const AssetNames& names);

  enum class Change {
    camera,      ///< Nothing else is another.
    appearance,  ///< Also lights, materials or settings; objects look as they did.
    objects,     ///< An import has begun; until it is adopted the scene is as before.
  };
  /// Errors: what is wrong with the change; the scene is as before.
  tl::expected<Change, Problems> change(const v1::UpdateView& update);

  bool is_importing() const { return import_ != nullptr; }
  bool is_imported() const { return import_ && import_->is_done(); }
  void cancel_import() { import_->cancel(); }
  /// Once it is imported: what to adopt(), or what is wrong; the scene is as before.
  tl::expected<ImportedScene, Problems> end_import();
  /// The scene before ends as a whole, its renderer before what that refers to.
  void adopt(ImportedScene imported) { std::swap(now_, imported); }

  const v1::Settings& settings() const { return now_.message.settings(); }
  const RenderScene& scene() const { return *now_.scene; }
  const CameraSpace& space() const { return now_.space; }
  /// Draws it; until another one is adopted.
  Renderer& renderer() { return *now_.renderer; }

 private:
  /// A message with the files of its names.
  struct Source {
    v1::Scene scene;
    AssetNames names;
    int of_objects;  ///< So many of them: objects may be made of these.
  };
  tl::expected<Source, Problems> read(const v1::UpdateView& update) const;
  void begin_import(Source source);
  tl::expected<Change, Problems> change_camera(Source source);
  tl::expected<Change, Problems> change_appearance(Source source);
  bool is_far_away(RenderCamera camera) const;
  void keep_objects(RenderScene& scene);

  const WorkerOptions& options_;
  std::function<void()> wake_;
  ImportedScene now_;
  std::unique_ptr<SceneImport> import_;
};

}  // namespace metamer::worker
