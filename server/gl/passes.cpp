#include "server/gl/passes.h"

#include <epoxy/gl.h>

#include "common/scene/fresnel_table.h"
#include "server/gl/context.h"
#include "server/gl/lights.h"
#include "server/gl/materials.h"
#include "server/transport/factor_rows.h"

namespace metamer::gl {
namespace {

/// The most that the lobes at triangles' places may take; beyond that each sample evaluates them.
constexpr std::uint64_t max_place_bytes = 96u << 20;

/// Of all lights, two groups of four numbers each.
std::uint64_t place_bytes(const RenderScene& scene, const Geometry& geometry,
                          std::uint32_t places) {
  return std::uint64_t{geometry.triangle_count()} * scene.lights.size() * places * 32;
}

/// At how many places of a triangle a model is evaluated, at the most; 0: at samples alone, or the
/// places take too much memory.
std::uint32_t places_of_triangle(const RenderScene& scene, const Geometry& geometry) {
  std::uint32_t places = 0;
  for (const RenderObject& object : scene.objects) {
    if (object.shape == RenderObject::Shape::sphere) continue;
    switch (object.shading) {
      case v1::CONSTANT:
        places = std::max(places, 1u);
        break;
      case v1::GOURAUD:
        places = std::max(places, 3u);
        break;
      case v1::QUADRATIC:
        places = std::max(places, 6u);
        break;
      default:
        break;
    }
  }
  return place_bytes(scene, geometry, places) <= max_place_bytes ? places : 0;
}

}  // namespace

Result<Passes> Passes::create(const RenderScene& scene, const Geometry& geometry,
                              const v1::Plan& plan, const Method& method, ProgramCache& cache,
                              bool timers) {
  Passes made(scene, geometry);
  made.clock_ = std::make_unique<PassClock>(timers);
  const bool multi = plan.method().point().multi_pass();
  made.places_of_triangle_ = places_of_triangle(scene, geometry);
  auto programs = cache.get(scene, {made.places_of_triangle_ > 0, multi});
  if (!programs) return tl::unexpected(programs.error());
  made.programs_ = std::move(*programs);
  const DirectTables tables = method.direct_tables();
  if (auto done = made.upload(tables); !done) return tl::unexpected(done.error());
  if (multi) {
    auto multi_pass = MultiPass::create(tables, plan.lights());
    if (!multi_pass) return tl::unexpected(multi_pass.error());
    made.multi_pass_ = std::make_unique<MultiPass>(std::move(*multi_pass));
  }
  return made;
}

Result<void> Passes::upload(const DirectTables& tables) {
  value_size_ = tables.size;
  row_stride_ = tables.row_stride;
  light_stride_ = tables.light_stride;
  sensor_stride_ = tables.sensor_stride;
  const auto words = material_words(scene_, FactorRows(scene_));
  const auto light_data = light_words(scene_);
  auto materials = Buffer::of<std::uint32_t>("the materials", words);
  auto values = Buffer::of<float>("the method's values", tables.values);
  auto sensors = Buffer::of<float>("the method's sensors", tables.sensors);
  auto lights = Buffer::of<std::uint32_t>("the lights", light_data);
  for (auto* buffer : {&materials, &values, &sensors, &lights})
    if (!*buffer) return tl::unexpected(buffer->error());
  materials_ = std::move(*materials);
  values_ = std::move(*values);
  sensors_ = std::move(*sensors);
  lights_ = std::move(*lights);
  if (places_of_triangle_ > 0) {
    auto places = Buffer::zeros("the lobes at triangles' places",
                                place_bytes(scene_, geometry_, places_of_triangle_));
    if (!places) return tl::unexpected(places.error());
    places_ = std::move(*places);
  }
  return {};
}

/// Makes the memory of a region's pixels, where the last region was of another size.
Result<void> Passes::resize(const Rect& region) {
  if (target_.is(region.width, region.height)) return {};
  const std::size_t pixels = std::size_t{region.width} * region.height;
  auto weights = Buffer::zeros("the pixels' weights", pixels * scene_.lights.size() * 16);
  auto colors = Buffer::zeros("the pixels' colours", pixels * 16);
  for (auto* buffer : {&weights, &colors})
    if (!*buffer) return tl::unexpected(buffer->error());
  auto target = Target::make(Target::Content::names, region.width, region.height);
  if (!target) return tl::unexpected(target.error());
  weights_ = std::move(*weights);
  colors_ = std::move(*colors);
  target_ = std::move(*target);
  return {};
}

/// Binds all that the shaders read, and sets what is the same for all samples and lights.
void Passes::bind() const {
  geometry_.bind();
  values_.bind_storage(7);
  sensors_.bind_storage(8);
  weights_.bind_storage(12);
  colors_.bind_storage(13);
  materials_.bind_storage(14);
  lights_.bind_storage(15);
  glBindTextureUnit(0, target_.texture());
  for (const Program* program : {&programs_->shade, &programs_->finish, &programs_->pass_triangles,
                                 &programs_->pass_spheres, &programs_->places}) {
    if (!*program) continue;
    program->set("value_size", value_size_);
    program->set("row_stride", row_stride_);
    program->set("light_stride", light_stride_);
    program->set("sensor_stride", sensor_stride_);
    program->set("node_count", geometry_.node_count());
    program->set("has_tangents", geometry_.has_tangents());
    program->set("triangle_count", geometry_.triangle_count());
    program->set("places_of_triangle", places_of_triangle_);
    program->set("node_last", static_cast<float>(fresnel_nodes - 1));
  }
}

/// Each light by itself: llvmpipe cuts long loops short.
void Passes::for_each_light(const Program& program, const Rect& region,
                            const Control& control) const {
  program.use();
  const std::uint32_t pixels = region.width * region.height;
  for (std::uint32_t light = 0; light < scene_.lights.size() && !control.cancelled; ++light) {
    program.set("light", light);
    program.set("first_weight", light * pixels);
    dispatch_over(region);
    ++control.work;
  }
}

/// Evaluates the models at the places of triangles, once for all that is seen from one eye.
void Passes::evaluate_places() {
  if (places_of_triangle_ == 0 || places_seen_from_ == view_->camera.eye) return;
  places_seen_from_ = view_->camera.eye;
  const Program& program = programs_->places;
  view_->set(program, {0, 0});
  places_.bind_storage(3);
  program.use();
  clock_->run(Pass::places, [&] {
    for (std::uint32_t light = 0; light < scene_.lights.size(); ++light) {
      program.set("light", light);
      dispatch_over({0, 0, 8 * ((geometry_.triangle_count() + 63) / 64), 8});
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);  // MultiPass reads them as it draws
  });
}

Result<void> Passes::begin(const Rect& region, const Film& film) {
  if (auto done = resize(region); !done) return done;
  weights_.clear();
  colors_.clear();
  bind();
  view_.emplace(RegionView{scene_.camera, film.width, film.height, region});
  evaluate_places();
  return {};
}

Result<void> Passes::add(SamplePoint place, const Control& control) {
  clock_->run(Pass::visibility, [&] {
    for (const Program* program : {&programs_->triangles, &programs_->spheres})
      view_->set(*program, place);
    target_.begin();
    geometry_.draw(programs_->triangles, programs_->spheres);
  });
  Result<void> done;
  clock_->run(Pass::shading, [&] {
    if (multi_pass_) {
      done = multi_pass_->run(*programs_, geometry_, places_, *view_, place, control);
      return;
    }
    view_->set(programs_->shade, place);
    if (places_of_triangle_ > 0) places_.bind_storage(3);
    for_each_light(programs_->shade, view_->region, control);
  });
  return done ? check_context() : done;
}

Result<void> Passes::finish(const Film& film, std::size_t samples, const Control& control) {
  view_->set(programs_->finish, {0, 0});
  clock_->run(Pass::color, [&] {
    if (!multi_pass_) for_each_light(programs_->finish, view_->region, control);
  });
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    return problem("GL error " + std::to_string(error) + " while rendering");
  if (!control.cancelled) read_back(view_->region, film, samples);
  return {};
}

void Passes::read_back(const Rect& region, const Film& film, std::size_t samples) const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<float> colors(std::size_t{region.width} * region.height * 4);
  colors_.read(colors);
  const float scale = 1 / static_cast<float>(samples);
  const float* from = colors.data();
  for (std::uint32_t y = region.y; y < region.y + region.height; ++y)
    for (std::uint32_t x = region.x; x < region.x + region.width; ++x, from += 4)
      film.set(x, y, {scale * from[0], scale * from[1], scale * from[2]});
}

}  // namespace metamer::gl
