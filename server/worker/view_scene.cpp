#include "server/worker/view_scene.h"

#include <algorithm>
#include <utility>

#include "common/scene/limits.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "server/scene/compile.h"

namespace metamer::worker {
namespace {

/// Farther away than this, in sizes of the scene, f32 is no longer fine enough for it.
constexpr double far_away = 16;

/// The settings of a view are those of a scene but for what makes no sense in one.
v1::Settings view_settings(const v1::Settings& from, const Backend& backend) {
  v1::Settings settings = with_defaults(from);
  settings.set_backend(backend.id());
  if (settings.has_goal() && method_entry(settings.method()) == nullptr) {
    settings.clear_goal();
    settings.mutable_method()->mutable_exact();
  }
  return settings;
}

Problem too_large() {
  return {.field = "settings.width",
          .file = {},
          .message = "a view has at most " + std::to_string(limits::max_view_pixels) + " pixels"};
}

bool fits(const v1::Settings& settings) {
  return std::uint64_t{settings.width()} * settings.height() <= limits::max_view_pixels;
}

/// Each change in the place of what has its name.
template <class Item>
void replace(const google::protobuf::RepeatedPtrField<Item>& changes, const std::string& field,
             google::protobuf::RepeatedPtrField<Item>& to, ViewScene::Problems& problems) {
  for (int i = 0; i < changes.size(); ++i) {
    const auto found = std::find_if(
        to.begin(), to.end(), [&](const Item& item) { return item.name() == changes[i].name(); });
    if (found != to.end())
      *found = changes[i];
    else
      problems.push_back(
          {.field = field + "[" + std::to_string(i) + "].name",
           .file = {},
           .message = "the scene has no " + field + " named " + quoted(changes[i].name())});
  }
}

/// Each in the place of what has its name, or behind the others.
void add_names(const AssetNames& more, AssetNames& to) {
  for (const v1::AssetName& asset : more) {
    const auto found = std::find_if(
        to.begin(), to.end(), [&](const v1::AssetName& one) { return one.name() == asset.name(); });
    (found != to.end() ? *found : *to.Add()) = asset;
  }
}

}  // namespace

ViewScene::ViewScene(const WorkerOptions& options, std::function<void()> wake)
    : options_(options), wake_(std::move(wake)) {}

ViewScene::Problems ViewScene::open(v1::Scene scene, const AssetNames& names) {
  *scene.mutable_settings() = view_settings(scene.settings(), *options_.backend);
  if (!fits(scene.settings())) return {too_large()};
  opened_with_ = names.size();
  begin_import(std::move(scene), names);
  return {};
}

tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change(
    const v1::UpdateView& update) {
  Problems problems;
  v1::Scene scene = now_.message;
  if (update.has_camera()) *scene.mutable_camera() = update.camera();
  if (update.has_settings())
    *scene.mutable_settings() = view_settings(update.settings(), *options_.backend);
  replace(update.light(), "light", *scene.mutable_light(), problems);
  replace(update.material(), "material", *scene.mutable_material(), problems);
  AssetNames names = now_.names;
  add_names(update.asset(), names);
  if (static_cast<std::size_t>(names.size()) > limits::max_assets)
    problems.push_back({.field = "asset", .file = {}, .message = "the view has too many files"});
  if (!fits(scene.settings())) problems.push_back(too_large());
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  const bool camera_alone =
      !update.has_settings() && update.light_size() + update.material_size() == 0;
  return camera_alone ? change_camera(std::move(scene), names)
                      : change_appearance(std::move(scene), names);
}

tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change_camera(
    v1::Scene scene, const AssetNames& names) {
  Problems problems = validate_scene(scene);
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  RenderCamera camera = compile_camera(scene.camera());
  now_.space.place(camera);
  if (camera.eye.norm() > far_away) {
    begin_import(std::move(scene), names);
    return Change::objects;
  }
  now_.scene->camera = camera;
  now_.message = std::move(scene);
  return Change::camera;
}

/// Lights, materials and camera anew, while the objects stay; all, where they do not.
tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change_appearance(
    v1::Scene scene, const AssetNames& names) {
  auto compiled = compile_appearance(scene, stored_assets(names, options_.store));
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  if (objects_key(scene, *compiled, {names.begin(), names.begin() + opened_with_}) !=
      now_.objects_key) {
    begin_import(std::move(scene), names);
    return Change::objects;
  }
  compiled->objects = std::move(now_.scene->objects);
  compiled->meshes = std::move(now_.scene->meshes);
  *now_.scene = std::move(*compiled);
  for (RenderLight& light : now_.scene->lights) now_.space.place(light);
  now_.space.place(now_.scene->camera);
  now_.message = std::move(scene);
  now_.names = names;
  return Change::appearance;
}

void ViewScene::begin_import(v1::Scene scene, AssetNames names) {
  import_ = std::make_unique<SceneImport>(std::move(scene), std::move(names), opened_with_,
                                          options_, wake_);
}

tl::expected<ImportedScene, ViewScene::Problems> ViewScene::end_import() {
  return std::exchange(import_, nullptr)->take();
}

}  // namespace metamer::worker
