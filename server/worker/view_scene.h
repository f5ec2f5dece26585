#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "metamer/v1/worker.pb.h"
#include "server/worker/scene_import.h"

namespace metamer::worker {

/// The scene of a view, as changes leave it. Keeps everything that a change leaves as it is; where
/// objects would look different, all is imported anew. Belongs to the lane's thread.
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
  /// Draws it; until another one is adopted.
  Renderer& renderer() { return *now_.renderer; }

 private:
  void begin_import(v1::Scene scene, AssetNames names);
  tl::expected<Change, Problems> change_camera(v1::Scene scene, const AssetNames& names);
  tl::expected<Change, Problems> change_appearance(v1::Scene scene, const AssetNames& names);

  const WorkerOptions& options_;
  std::function<void()> wake_;
  ImportedScene now_;
  int opened_with_ = 0;  ///< So many names: objects may be made of these.
  std::unique_ptr<SceneImport> import_;
};

}  // namespace metamer::worker
