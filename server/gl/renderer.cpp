#include "server/gl/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "common/scene/fresnel_table.h"
#include "server/film/sample_pattern.h"
#include "server/gl/materials.h"
#include "server/methods/scene_rows.h"

namespace metamer::gl {
namespace {

constexpr std::uint32_t group_side = 8;  // of the compute shaders

std::array<float, 3> to_array(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::array<float, 4> row(const Eigen::Vector4d& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
          static_cast<float>(v[3])};
}

Eigen::Vector4d extend(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z(), 0}; }

}  // namespace

class Renderer::Target {
 public:
  Target(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    glCreateTextures(GL_TEXTURE_2D, 1, &names_);
    glTextureStorage2D(names_, 1, GL_R32UI, w, h);
    // Names are not to be filtered; with any other setting nothing is read.
    glTextureParameteri(names_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(names_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glCreateRenderbuffers(1, &depth_);
    glNamedRenderbufferStorage(depth_, GL_DEPTH_COMPONENT32F, w, h);
    glCreateFramebuffers(1, &frame_);
    glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, names_, 0);
    glNamedFramebufferRenderbuffer(frame_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  ~Target() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(1, &names_);
  }

  bool is(std::uint32_t width, std::uint32_t height) const {
    return width_ == width && height_ == height;
  }
  bool complete() const {
    return glCheckNamedFramebufferStatus(frame_, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  /// Empties it and makes it the one to draw into.
  void begin() const {
    const GLuint nothing[4] = {};
    const GLfloat far_away = 0;
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
    glClearBufferuiv(GL_COLOR, 0, nothing);
    glClearBufferfv(GL_DEPTH, 0, &far_away);
  }
  GLuint names() const { return names_; }

 private:
  std::uint32_t width_, height_;
  GLuint names_ = 0, depth_ = 0, frame_ = 0;
};

Result<Renderer> Renderer::create(const RenderScene& scene, const Geometry& geometry,
                                  const v1::Plan& plan, const Method& method, ProgramCache& cache,
                                  bool timers) {
  Renderer renderer(scene, geometry, plan);
  renderer.clock_ = std::make_unique<PassClock>(timers);
  auto programs = cache.get(scene);
  if (!programs) return tl::unexpected(programs.error());
  renderer.programs_ = std::move(*programs);
  if (auto done = renderer.upload(scene, method); !done) return tl::unexpected(done.error());
  return renderer;
}

Renderer::Renderer(const RenderScene& scene, const Geometry& geometry, const v1::Plan& plan)
    : scene_(scene),
      geometry_(geometry),
      width_(plan.width()),
      height_(plan.height()),
      spp_(plan.spp()) {}

Result<void> Renderer::upload(const RenderScene& scene, const Method& method) {
  const DirectTables tables = method.direct_tables();
  value_size_ = tables.size;
  row_stride_ = tables.row_stride;
  light_stride_ = tables.light_stride;
  sensor_stride_ = tables.sensor_stride;
  const auto words = material_words(scene, SceneRows(scene));
  auto materials = Buffer::of<std::uint32_t>("the materials", words);
  auto values = Buffer::of<float>("the method's values", tables.values);
  auto sensors = Buffer::of<float>("the method's sensors", tables.sensors);
  for (auto* buffer : {&materials, &values, &sensors})
    if (!*buffer) return tl::unexpected(buffer->error());
  materials_ = std::move(*materials);
  values_ = std::move(*values);
  sensors_ = std::move(*sensors);
  return {};
}

/// Makes the memory of a region's pixels, where the last region was of another size.
Result<void> Renderer::resize(const Rect& region) {
  if (target_ && target_->is(region.width, region.height)) return {};
  target_.reset();
  const std::size_t pixels = std::size_t{region.width} * region.height;
  auto weights = Buffer::zeros("the pixels' weights", pixels * scene_.lights.size() * 16);
  auto colors = Buffer::zeros("the pixels' colours", pixels * 16);
  for (auto* buffer : {&weights, &colors})
    if (!*buffer) return tl::unexpected(buffer->error());
  weights_ = std::move(*weights);
  colors_ = std::move(*colors);
  target_ = std::make_shared<Target>(region.width, region.height);
  if (!target_->complete()) return problem("this GL device has no framebuffer of names");
  return {};
}

void Renderer::set_camera(const Program& program, const Rect& region, float x, float y) const {
  const RenderCamera& camera = scene_.camera;
  const double pixel = 2 * camera.tan_half_fov / height_;
  program.set("across", to_array(camera.right * pixel));
  program.set("down", to_array(-camera.up * pixel));
  program.set("corner", to_array(camera.forward - camera.right * (pixel * width_ / 2) +
                                 camera.up * (pixel * height_ / 2)));
  program.set("forward", to_array(camera.forward));
  program.set("region", std::array{region.x, region.y});
  program.set("region_size", std::array{region.width, region.height});
  program.set("place", std::array{x, y});

  // A sample is seen in the middle of its pixel; rows count downwards, as in the film.
  const Eigen::Vector4d w = extend(camera.forward);
  const double left = width_ / 2.0 - region.x - x + 0.5, top = height_ / 2.0 - region.y - y + 0.5;
  const Eigen::Vector4d across = extend(camera.right) / pixel + left * w;
  const Eigen::Vector4d downwards = -extend(camera.up) / pixel + top * w;
  program.set("to_clip", {row(2.0 / region.width * across - w),
                          row(2.0 / region.height * downwards - w), row(w)});
}

void Renderer::set_light(const Program& program, std::uint32_t light) const {
  const RenderLight& own = scene_.lights[light];
  program.set("light", light);
  program.set("directional", own.directional);
  program.set("light_place", to_array(own.place));
  program.set("reference_squared",
              static_cast<float>(own.reference_distance * own.reference_distance));
  program.set("solid_angle", static_cast<float>(own.solid_angle));
}

/// Lets the rasteriser find what one sample of each pixel sees.
void Renderer::draw(const Rect& region, float x, float y) const {
  target_->begin();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  if (geometry_.triangle_count() > 0) {
    set_camera(programs_->triangles, region, x, y);
    programs_->triangles.use();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, geometry_.indices());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * geometry_.triangle_count()),
                   GL_UNSIGNED_INT, nullptr);
  }
  if (geometry_.sphere_count() > 0) {
    set_camera(programs_->spheres, region, x, y);
    programs_->spheres.use();
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(geometry_.sphere_count()));
  }
}

void Renderer::dispatch(const Rect& region) const {
  const auto groups = [](std::uint32_t side) { return (side + group_side - 1) / group_side; };
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  glDispatchCompute(groups(region.width), groups(region.height), 1);
}

Result<void> Renderer::render(const Rect& region, const Film& film,
                              const std::atomic<bool>& cancelled,
                              std::atomic<std::uint64_t>& work) {
  if (auto done = resize(region); !done) return done;
  const std::size_t pixels = std::size_t{region.width} * region.height;
  geometry_.bind();
  values_.bind_storage(7);
  sensors_.bind_storage(8);
  weights_.bind_storage(12);
  colors_.bind_storage(13);
  materials_.bind_storage(14);
  weights_.clear();
  colors_.clear();
  glBindTextureUnit(0, target_->names());
  GLuint no_attributes = 0;  // but core GL draws nothing without an array of them
  glCreateVertexArrays(1, &no_attributes);
  glBindVertexArray(no_attributes);

  for (const Program* program : {&programs_->shade, &programs_->finish}) {
    program->set("value_size", value_size_);
    program->set("row_stride", row_stride_);
    program->set("light_stride", light_stride_);
    program->set("sensor_stride", sensor_stride_);
  }
  programs_->shade.set("node_count", geometry_.node_count());
  programs_->shade.set("has_tangents", geometry_.has_tangents());
  programs_->shade.set("node_last", static_cast<float>(fresnel_nodes - 1));

  // Gather all samples, each light by itself: llvmpipe cuts long loops short.
  const auto lights = static_cast<std::uint32_t>(scene_.lights.size());
  const auto for_each_light = [&](const Program& program) {
    program.use();
    for (std::uint32_t light = 0; light < lights; ++light) {
      set_light(program, light);
      program.set("first_weight", static_cast<std::uint32_t>(light * pixels));
      dispatch(region);
    }
  };
  for (const SamplePoint& at : sample_pattern(spp_)) {
    if (cancelled) break;
    clock_->run(Pass::visibility, [&] { draw(region, at.x, at.y); });
    set_camera(programs_->shade, region, at.x, at.y);
    clock_->run(Pass::shading, [&] { for_each_light(programs_->shade); });
    work += pixels;
  }
  set_camera(programs_->finish, region, 0, 0);
  clock_->run(Pass::color, [&] { for_each_light(programs_->finish); });
  glDeleteVertexArrays(1, &no_attributes);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    return problem("GL error " + std::to_string(error) + " while rendering");
  if (cancelled) return {};

  // Read it back.
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<float> colors(pixels * 4);
  colors_.read(colors);
  const float scale = 1 / static_cast<float>(spp_);
  for (std::size_t i = 0; i < pixels; ++i)
    film.set(region.x + static_cast<std::uint32_t>(i % region.width),
             region.y + static_cast<std::uint32_t>(i / region.width),
             {scale * colors[4 * i], scale * colors[4 * i + 1], scale * colors[4 * i + 2]});
  return {};
}

}  // namespace metamer::gl
