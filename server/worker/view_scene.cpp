#include "server/worker/view_scene.h"

#include <algorithm>
#include <utility>

#include "common/scene/limits.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "server/scene/compile.h"
#include "server/scene/media.h"
#include "server/scene/shining.h"

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
  begin_import({std::move(scene), names, names.size()});
  return {};
}

/// What is changed: the scene as it is, or another.
tl::expected<ViewScene::Source, ViewScene::Problems> ViewScene::read(
    const v1::UpdateView& update) const {
  Source source{now_.message, now_.names, now_.of_objects};
  if (!update.scene_sha256().empty()) {
    auto scene = options_.scene(update.scene_sha256());
    if (!scene) return tl::unexpected(Problems{std::move(scene.error())});
    source.scene = *std::move(scene);
    *source.scene.mutable_settings() = view_settings(source.scene.settings(), *options_.backend);
    source.names.Clear();
    source.of_objects = update.asset_size();
  }
  add_names(update.asset(), source.names);
  return source;
}

tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change(
    const v1::UpdateView& update) {
  auto source = read(update);
  if (!source) return tl::unexpected(std::move(source.error()));
  Problems problems;
  v1::Scene& scene = source->scene;
  if (update.has_camera()) *scene.mutable_camera() = update.camera();
  if (update.has_settings())
    *scene.mutable_settings() = view_settings(update.settings(), *options_.backend);
  replace(update.light(), "light", *scene.mutable_light(), problems);
  replace(update.material(), "material", *scene.mutable_material(), problems);
  if (static_cast<std::size_t>(source->names.size()) > limits::max_assets)
    problems.push_back({.field = "asset", .file = {}, .message = "the view has too many files"});
  if (!fits(scene.settings())) problems.push_back(too_large());
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  const bool camera_alone = update.scene_sha256().empty() && !update.has_settings() &&
                            update.light_size() + update.material_size() == 0;
  return camera_alone ? change_camera(*std::move(source)) : change_appearance(*std::move(source));
}

bool ViewScene::is_far_away(RenderCamera camera) const {
  now_.space.place(camera);
  return camera.eye.norm() > far_away;
}

tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change_camera(Source source) {
  Problems problems = validate_scene(source.scene);
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  RenderCamera camera = compile_camera(source.scene.camera());
  if (is_far_away(camera)) {
    begin_import(std::move(source));
    return Change::objects;
  }
  now_.space.place(camera);
  now_.scene->camera = camera;
  now_.message = std::move(source.scene);
  return Change::camera;
}

/// Lights, materials and camera anew, while the objects stay; all, where they do not.
tl::expected<ViewScene::Change, ViewScene::Problems> ViewScene::change_appearance(Source source) {
  auto compiled =
      compile_appearance(source.scene, options_.assets(source.names),
                         now_.known.textures.reusing(options_.textures(source.names), source.names),
                         now_.known.skies.reusing(options_.skies(source.names), source.names));
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  const AssetNames of_objects(source.names.begin(), source.names.begin() + source.of_objects);
  if (objects_key(source.scene, *compiled, of_objects) != now_.objects_key ||
      is_far_away(compiled->camera)) {
    begin_import(std::move(source));
    return Change::objects;
  }
  if (auto fault = find_interfaces(*compiled, *now_.scene))
    return tl::unexpected(Problems{*std::move(fault)});
  if (auto fault = find_shining(compiled->lights, *now_.scene))
    return tl::unexpected(Problems{*std::move(fault)});
  keep_objects(*compiled);
  *now_.scene = std::move(*compiled);
  for (RenderLight& light : now_.scene->lights) now_.space.place(light);
  for (RenderMedium& medium : now_.scene->media) now_.space.place(medium);
  for (RenderMap& map : now_.scene->maps) now_.space.place(map);
  now_.space.place(now_.scene->camera);
  now_.message = std::move(source.scene);
  now_.names = std::move(source.names);
  now_.of_objects = source.of_objects;
  return Change::appearance;
}

/// And what their files had to be taken for.
void ViewScene::keep_objects(RenderScene& scene) {
  scene.objects = std::move(now_.scene->objects);
  scene.meshes = std::move(now_.scene->meshes);
  for (RenderScene::Notice& notice : now_.scene->notices)
    if (notice.field.starts_with("object[")) scene.notices.push_back(std::move(notice));
}

void ViewScene::begin_import(Source source) {
  import_ = std::make_unique<SceneImport>(std::move(source.scene), std::move(source.names),
                                          source.of_objects, now_.known, options_, wake_);
}

tl::expected<ImportedScene, ViewScene::Problems> ViewScene::end_import() {
  return std::exchange(import_, nullptr)->take();
}

}  // namespace metamer::worker
