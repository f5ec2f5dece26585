#include "tests/server/gl/pictures.h"

#include <google/protobuf/text_format.h>

#include <fstream>
#include <sstream>

#include "common/color/lab.h"
#include "common/lights/reference.h"
#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/gl/passes.h"
#include "server/plan/plan.h"
#include "server/plan/reference.h"
#include "server/scene/camera_space.h"
#include "server/scene/compile.h"

namespace metamer::gl {
namespace {

const std::atomic<bool> never = false;

std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error("can't read " + file);
  return text.str();
}

/// What a ray sees: its object, the facet where each has a colour of its own, and, bit by bit, the
/// lights that reach it.
struct Sight {
  int object = -1, facet = 0;
  std::uint32_t lights = 0;
  bool operator==(const Sight&) const = default;
};

Vectors broadcast(const Eigen::Vector3d& v) {
  return {metamer::broadcast(static_cast<float>(v.x())),
          metamer::broadcast(static_cast<float>(v.y())),
          metamer::broadcast(static_cast<float>(v.z()))};
}

Sight look(const RenderScene& scene, const cpu::EmbreeScene& geometry,
           const Eigen::Vector3d& direction) {
  Ints one{};
  one[0] = -1;
  const cpu::Hits hits = geometry.intersect(Vectors{}, broadcast(direction), one);
  if (!hits.hit[0]) return {};
  Sight sight{.object = hits.object[0]};
  if (geometry.shading(sight.object) == v1::CONSTANT) sight.facet = hits.primitive[0];
  const Eigen::Vector3d at = direction * hits.distance[0];
  const Eigen::Vector3d side(hits.geometric_normal.x[0], hits.geometric_normal.y[0],
                             hits.geometric_normal.z[0]);
  const Eigen::Vector3d from = at + side * (at.norm() * 1e-5);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const RenderLight& own = scene.lights[i];
    const lights::Incident light = lights::incident(own.light, own.values(), from);
    if (light.weight > 0 && side.dot(light.direction) > 0 &&
        geometry.visible(broadcast(from), broadcast(light.direction),
                         metamer::broadcast(static_cast<float>(light.reach)), one)[0])
      sight.lights |= 1u << i;
  }
  return sight;
}

}  // namespace

SceneOnDisk read_deployed(const std::string& path) {
  SceneOnDisk scene;
  const std::string file = METAMER_TEST_DATA "/../deploy/" + path;
  if (!google::protobuf::TextFormat::ParseFromString(contents(file), &scene.message))
    throw std::runtime_error("can't parse " + file);
  scene.folder = file.substr(0, file.rfind('/') + 1);
  return scene;
}

RenderScene compile(const SceneOnDisk& scene) {
  const AssetReader assets = [&](const std::string& name) -> Result<std::string> {
    return contents(scene.folder + name);
  };
  auto compiled =
      compile_scene(scene.message, assets, import_here(assets), textures_of(assets), never);
  if (!compiled) throw std::runtime_error(compiled.error().front().message);
  return to_camera_space(std::move(*compiled));
}

Pictures::Pictures(const SceneOnDisk& scene)
    : scene_(compile(scene)), settings_(with_defaults(scene.message.settings())) {
  settings_.set_depth(0);
  geometry_ = cpu::EmbreeScene::build(scene_, never);
  find_edges();
}

v1::Plan Pictures::plan(const v1::Method& method) const {
  v1::Settings settings = settings_;
  *settings.mutable_method() = method;
  return make_plan(scene_, with_defaults(settings), {.threads = 1});
}

Pictures::Xyz Pictures::by_cpu(const v1::Method& method) const {
  const v1::Plan own = plan(method);
  const auto prepared = make_method(own, scene_);
  const cpu::Tracer tracer(scene_, *geometry_, own);
  Xyz xyz(std::size_t{width()} * height() * 3);
  FilmSink sink(*prepared, {xyz.data(), width(), height()}, own.spp());
  auto workspace = tracer.make_workspace();
  std::atomic<std::uint64_t> work = 0;
  tracer.render({0, 0, width(), height()}, sink, workspace, never, work);
  return xyz;
}

Result<Pictures::Xyz> Pictures::by_gl(const v1::Method& method, ProgramCache& cache) const {
  const v1::Plan own = plan(method);
  const auto prepared = make_method(own, scene_);
  auto geometry = Geometry::upload(scene_, never);
  if (!geometry) return tl::unexpected(geometry.error());
  auto renderer = Passes::create(scene_, *geometry, own, *prepared, cache, false);
  if (!renderer) return tl::unexpected(renderer.error());
  Xyz xyz(std::size_t{width()} * height() * 3);
  const Film film{xyz.data(), width(), height()};
  const std::vector<SamplePoint> samples = sample_pattern(settings_.spp());
  std::atomic<std::uint64_t> work = 0;
  const Control control{never, {}, work};
  Result<void> done = renderer->begin({0, 0, width(), height()}, film);
  for (const SamplePoint sample : samples)
    if (done) done = renderer->add(sample, control);
  if (done) done = renderer->finish(film, samples.size(), control);
  if (!done) return tl::unexpected(done.error());
  return xyz;
}

std::vector<double> Pictures::differences(const Xyz& a, const Xyz& b) const {
  const Reference reference(scene_, scene_.observer);
  std::vector<double> all;
  for (std::size_t i = 0; i < a.size(); i += 3)
    all.push_back(delta_e_00(to_lab({a[i], a[i + 1], a[i + 2]}, reference.white()),
                             to_lab({b[i], b[i + 1], b[i + 2]}, reference.white())));
  return all;
}

/// Looks at a grid, finer than the pixels where these have several samples, and keeps the pixels
/// around which nothing changes.
void Pictures::find_edges() {
  const std::uint32_t fine = settings_.spp() == 1 ? 1 : 3;
  const std::uint32_t across = width() * fine, down = height() * fine;
  const RenderCamera& camera = scene_.camera;
  const double step = 2 * camera.tan_half_fov / down;
  std::vector<Sight> sights;
  for (std::uint32_t y = 0; y < down; ++y)
    for (std::uint32_t x = 0; x < across; ++x)
      sights.push_back(look(scene_, *geometry_,
                            (camera.forward + camera.right * (step * (x + 0.5 - across / 2.0)) -
                             camera.up * (step * (y + 0.5 - down / 2.0)))
                                .normalized()));
  for (std::uint32_t y = 0; y < height(); ++y)
    for (std::uint32_t x = 0; x < width(); ++x) {
      const Sight own = sights[(y * fine + fine / 2) * across + x * fine + fine / 2];
      bool smooth = true;
      for (std::uint32_t v = y * fine - std::min(y, 1u); v < std::min(down, (y + 1) * fine + 1);
           ++v)
        for (std::uint32_t u = x * fine - std::min(x, 1u); u < std::min(across, (x + 1) * fine + 1);
             ++u)
          smooth &= sights[v * across + u] == own;
      smooth_.push_back(smooth);
      objects_.push_back(own.object);
    }
}

}  // namespace metamer::gl
