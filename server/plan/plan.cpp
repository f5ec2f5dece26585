#include "server/plan/plan.h"

#include <algorithm>
#include <set>

#include "common/color/xyz.h"
#include "server/methods/method.h"
#include "server/plan/coincident.h"
#include "server/plan/features.h"
#include "server/plan/light_notices.h"
#include "server/plan/needs.h"
#include "server/scene/bundles.h"
#include "server/scene/media.h"

namespace metamer {
namespace {

/// No path is longer than the mirrors and clear things of the scene make it, nor than the backend
/// goes.
std::uint32_t needed_depth(const std::vector<Need>& needs, std::uint32_t allowed,
                           const Features& features) {
  const bool longer = std::any_of(needs.begin(), needs.end(), [&](const Need& need) {
    return (need.feature == Feature::mirrors || need.feature == Feature::transmission) &&
           features.has(need.feature);
  });
  return longer ? allowed : 0;
}

/// Of lights, not at all of a light at once.
bool looks_at_points(const std::vector<Need>& needs) {
  return std::any_of(needs.begin(), needs.end(), [](const Need& need) {
    return need.feature == Feature::area_lights || need.feature == Feature::environment;
  });
}

void list_models(const RenderScene& scene, v1::Plan& plan) {
  std::set<models::Model> used;
  for (const RenderObject& object : scene.objects)
    used.insert(scene.materials[object.material].reflection.model);
  for (const models::Model model : used) plan.add_models(models::entry(model).name);
}

/// The white of the dominant light, to which an eye adapts (4.6.1).
void plan_white(const RenderScene& scene, v1::Plan& plan) {
  if (scene.lights.empty()) return;
  const Spectrum& light = scene.emissions[scene.lights.front().own_emission];
  const Xyz white = white_of(light, scene.observer);
  if (white[1] > 0) plan.mutable_source_white()->Add(white.begin(), white.end());
}

/// The objects of which one thing is said, told once however many they are.
struct Group {
  std::size_t first = 0, count = 0;
  void add(std::size_t object) {
    if (count++ == 0) first = object;
  }
  void say(const std::string& what, v1::Plan& plan) const {
    if (count == 0) return;
    v1::Notice* notice = plan.add_notice();
    notice->set_field("object[" + std::to_string(first) + "]");
    notice->set_message(what + (count > 1 ? " (and " + std::to_string(count - 1) + " more)" : ""));
  }
};

/// Some of its vertices have UVs without a direction.
bool lacks_direction(const TriangleMesh& mesh) {
  return std::find(mesh.tangents.begin(), mesh.tangents.end(), std::array<float, 3>{}) !=
         mesh.tangents.end();
}

/// Says what of the meshes' files is not in the picture.
void notice_skipped_faces(const RenderScene& scene, v1::Plan& plan) {
  std::vector<bool> told(scene.meshes.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& object = scene.objects[i];
    if (object.shape != RenderObject::Shape::mesh || told[object.mesh]) continue;
    told[object.mesh] = true;
    const std::uint64_t skipped = scene.meshes[object.mesh].skipped_faces;
    if (skipped == 0) continue;
    v1::Notice* notice = plan.add_notice();
    notice->set_field("object[" + std::to_string(i) + "].mesh.file");
    notice->set_message(std::to_string(skipped) + (skipped == 1 ? " face has" : " faces have") +
                        " fewer than three corners: skipped");
  }
}

/// Says which tangents anisotropic materials see, and where a kind of shading means nothing.
void notice_objects(const RenderScene& scene, v1::Plan& plan) {
  Group by_uv, by_both, by_axis, spheres, quadratic;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& object = scene.objects[i];
    const bool sphere = object.shape != RenderObject::Shape::mesh;  // or a plane
    if (scene.materials[object.material].anisotropic()) {
      const bool has_uvs = !sphere && !scene.meshes[object.mesh].tangents.empty();
      (!has_uvs ? by_axis : lacks_direction(scene.meshes[object.mesh]) ? by_both : by_uv).add(i);
    }
    if (!sphere && object.shading == v1::QUADRATIC) quadratic.add(i);
    if (sphere && object.shading != v1::PHONG) spheres.add(i);
  }
  by_uv.say("its tangents point towards rising u of its UVs", plan);
  by_both.say(
      "its tangents point towards rising u of its UVs, and along the x axis of its "
      "transform where those have no direction",
      plan);
  by_axis.say(
      "it has no UVs: its tangents point along the x axis of its transform, along its z axis "
      "where that is the normal",
      plan);
  quadratic.say("QUADRATIC falls below 0 beside a highlight that is sharper than the triangles",
                plan);
  spheres.say("a sphere or plane has no corners: it is shaded by PHONG", plan);
}

/// Says which clear objects are no solids, so that light that goes in stays in.
void notice_open_objects(const RenderScene& scene, v1::Plan& plan) {
  Group open;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.materials[scene.objects[i].material].medium > 0 &&
        !is_closed(scene, scene.objects[i]))
      open.add(i);
  open.say(
      "it lets light through but is not closed, or its faces are not all turned the same way: "
      "where a path does not come out again, it stays in the material",
      plan);
}

/// Where the eye is so near to a clear surface that rounding says on which side it is. In the
/// camera's space, where f32 has 1e-7 of the scene's size.
void notice_eye_at_surface(const RenderScene& scene, v1::Plan& plan) {
  constexpr double told_apart = 1e-6;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.materials[scene.objects[i].material].medium == 0 ||
        !is_near(scene, scene.objects[i], scene.camera.eye, told_apart))
      continue;
    v1::Notice* notice = plan.add_notice();
    notice->set_field("camera.eye");
    notice->set_message("it is within a millionth of the scene's size of the surface of object[" +
                        std::to_string(i) + "], which is clear: on which side is up to rounding");
    return;
  }
}

/// Says which paths through clear objects end before they come out.
void notice_shallow(const std::vector<Need>& needs, v1::Plan& plan) {
  const auto clear = std::find_if(needs.begin(), needs.end(), [](const Need& need) {
    return need.feature == Feature::transmission;
  });
  if (clear == needs.end() || plan.depth() >= 2) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field("settings.depth");
  notice->set_message(std::string(plan.depth() == 0 ? "no path goes on at a clear object"
                                                    : "no path comes out of a clear object") +
                      ", which is dark: it needs a depth of 2, one that is filled 4");
}

void notice_cut_observer(const RenderScene& scene, v1::Plan& plan) {
  if (!scene.observer.is_cut()) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field("settings.observer_file");
  notice->set_message("what it sees outside 360 to 830 nm is left out");
}

/// Says where uniform wavelengths do not come to the end that was asked for.
void notice_short_end(const v1::Method& method, const Wavelengths& wavelengths, v1::Plan& plan) {
  const double last = wavelengths.nm().back();
  if (!method.has_point() || !method.point().has_to() || last == method.point().to()) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the last wavelength is %g nm: %g nm is no whole number of steps away", last,
                method.point().to());
  v1::Notice* notice = plan.add_notice();
  notice->set_field("settings.method.point");
  notice->set_message(text);
}

/// The side of tiles whose work is bounded: who waits for a turn need not wait for a tile for long,
/// and a stop drops little of one that is half done.
std::uint32_t bounded_tile_size(const v1::Settings& settings) {
  std::uint32_t side = settings.tile_size();
  while (side > 8 && std::uint64_t{side} * side * settings.spp() > max_tile_samples) side -= 8;
  return side;
}

void notice_smaller_tiles(const v1::Settings& settings, v1::Plan& plan) {
  if (plan.tile_size() == settings.tile_size()) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field("settings.tile_size");
  notice->set_message("tiles of " + std::to_string(settings.tile_size()) + " pixels with " +
                      std::to_string(settings.spp()) +
                      " samples each take too long at a time: of " +
                      std::to_string(plan.tile_size()));
}

/// Light that met something else before can't be told from light that is seen through it.
void notice_light_through(const RenderScene& scene, v1::Plan& plan) {
  if (scene.fluorescences.empty() || scene.media.empty()) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field(scene.fluorescence_fields.front());
  notice->set_message("light that comes through clear things excites no fluorescence");
}

/// Nor what other surfaces have reflected.
void notice_bounced_light(const RenderScene& scene, v1::Plan& plan) {
  if (scene.fluorescences.empty() || plan.bounces() == 0) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field(scene.fluorescence_fields.front());
  notice->set_message("light that other surfaces reflect excites no fluorescence");
}

/// Who has to have what the scene needs.
std::vector<Supported> supporters(const v1::Method& method, const Capabilities& capabilities) {
  const auto* name = v1::Method::descriptor()->FindFieldByNumber(method.method_case());
  return {{capabilities.backend + " backend", capabilities.features},
          {(name ? name->name() : "") + " method", method_features(method)}};
}

}  // namespace

std::vector<Problem> refusals(const RenderScene& scene, const v1::Settings& settings,
                              const Capabilities& capabilities, bool keep_factors) {
  std::vector<Need> needs = features_of(scene, settings);
  if (keep_factors) needs.push_back(need_of_factors());
  std::vector<Problem> problems;
  for (const Supported& supported : supporters(settings.method(), capabilities))
    for (Problem& one : refuse_unsupported(needs, supported)) problems.push_back(std::move(one));
  if (keep_factors && scene.environment && scene.environment->picture)
    problems.push_back({.field = scene.environment->field + ".environment",
                        .file = {},
                        .message = "the factors of an environment's picture are not kept for "
                                   "relighting: leave out its file or sky, or the factors"});
  return problems;
}

v1::Plan make_plan(const RenderScene& scene, const v1::Settings& settings,
                   const Capabilities& capabilities) {
  v1::Plan plan;
  plan.set_width(settings.width());
  plan.set_height(settings.height());
  plan.set_tile_size(bounded_tile_size(settings));
  plan.set_spp(settings.spp());
  const std::vector<Need> needs = features_of(scene, settings);
  plan.set_depth(needed_depth(needs, settings.depth(), capabilities.features));
  if ((!scene.media.empty() && capabilities.features.has(Feature::transmission)) ||
      (scene.has_alpha() && capabilities.features.has(Feature::alpha)))
    plan.set_cutoff(settings.cutoff());
  if (looks_at_points(needs)) plan.set_light_samples(settings.light_samples());
  if (settings.bounces() > 0 && capabilities.features.has(Feature::inter_reflection)) {
    plan.set_bounces(settings.bounces());
    plan.set_bounce_samples(settings.bounce_samples());
  }
  for (const Spectrum& window : scene.windows) plan.add_bundle(middle_of(window));
  plan.set_threads(settings.threads() == 0 ? capabilities.threads
                                           : std::min(settings.threads(), capabilities.threads));
  plan.set_backend(capabilities.backend);
  *plan.mutable_method() = settings.method();
  plan.set_observer(settings.observer());
  plan.set_observer_file(settings.observer_file());
  *plan.mutable_development() = settings.development();
  plan_white(scene, plan);

  const Wavelengths wavelengths = method_wavelengths(settings.method());
  plan_method(scene, settings, plan);

  list_models(scene, plan);
  plan.set_lights(static_cast<std::uint32_t>(scene.lights.size()));
  plan.set_materials(static_cast<std::uint32_t>(scene.materials.size()));
  plan.set_spectra(static_cast<std::uint32_t>(scene.emissions.size() + scene.properties.size()));
  plan.set_triangles(scene.triangle_count());

  for (const Supported& supported : supporters(settings.method(), capabilities))
    notice_unsupported(needs, supported, plan);
  for (const RenderScene::Notice& told : scene.notices) {
    v1::Notice* notice = plan.add_notice();
    notice->set_field(told.field);
    notice->set_message(told.message);
  }
  notice_light_through(scene, plan);
  notice_bounced_light(scene, plan);
  notice_smaller_tiles(settings, plan);
  notice_skipped_faces(scene, plan);
  notice_objects(scene, plan);
  notice_open_objects(scene, plan);
  notice_coincident(scene, plan);
  if (!scene.media.empty()) notice_eye_at_surface(scene, plan);
  if (capabilities.features.has(Feature::transmission)) notice_shallow(needs, plan);
  notice_lights(scene, needs, plan);
  notice_cut_observer(scene, plan);
  notice_short_end(settings.method(), wavelengths, plan);
  list_needs(scene, capabilities, plan);
  return plan;
}

}  // namespace metamer
