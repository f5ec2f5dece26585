// Two questions about a device, asked of the GL backend's own pieces: how long the same arithmetic
// takes in a fragment and in a compute shader, and what a timer query costs that is waited for, and
// one that is read some frames later. Usage: gl_bench [WIDTHxHEIGHT [FRAMES]]
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "server/gl/context.h"
#include "server/gl/program.h"
#include "server/gl/target.h"

namespace metamer::gl {
namespace {

using Clock = std::chrono::steady_clock;

/// Cook and Torrance's model with Beckmann's slopes for lights in a circle: what shading a pixel
/// costs.
const char* const arithmetic = R"(
uniform uint width;
vec4 shade(uvec2 pixel) {
  vec2 uv = vec2(pixel) / float(width);
  vec3 n = normalize(vec3(uv - 0.5, 1)), v = vec3(0, 0, 1);
  vec4 sum = vec4(0);
  for (int light = 0; light < 32; ++light) {
    float turn = 0.19634954 * float(light) + uv.x;
    vec3 l = normalize(vec3(cos(turn), sin(turn), 1 + uv.y)), h = normalize(l + v);
    float nh = dot(n, h), nl = max(0, dot(n, l)), nv = max(0.001, dot(n, v)), vh = dot(v, h);
    float h2 = nh * nh;
    float d = exp((h2 - 1) / (0.09 * h2)) / (0.09 * h2 * h2);
    float g = min(1, min(2 * nh * nv / vh, 2 * nh * nl / vh));
    sum += vec4(nl, d * g / nv, pow(max(0, nh), 40), 1);
  }
  return sum / 32;
})";

std::string version() { return "#version 450 core\n"; }

std::string compute_source() {
  return version() + "layout(local_size_x = 8, local_size_y = 8) in;\n" +
         "layout(rgba32f, binding = 0) writeonly uniform image2D picture;\n" + arithmetic + R"(
void main() {
  if (all(lessThan(gl_GlobalInvocationID.xy, uvec2(imageSize(picture)))))
    imageStore(picture, ivec2(gl_GlobalInvocationID.xy), shade(gl_GlobalInvocationID.xy));
})";
}

std::string fragment_source() {
  return version() + "out vec4 color;\n" + arithmetic +
         "\nvoid main() { color = shade(uvec2(gl_FragCoord.xy)); }";
}

/// A triangle that covers the picture.
std::string vertex_source() {
  return version() +
         "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, "
         "gl_VertexID == 2 ? 3 : -1, 0, 1); }";
}

struct Setup {
  std::uint32_t width, height;
  int frames;
  Program fragment, compute;
  Target drawn, computed;
};

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

/// A frame's time, the median of `frames`, each waited for.
double median_time(int frames, const std::function<void()>& frame) {
  frame();
  glFinish();
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) {
    const auto start = Clock::now();
    frame();
    glFinish();
    times.push_back(milliseconds(Clock::now() - start));
  }
  std::nth_element(times.begin(), times.begin() + frames / 2, times.end());
  return times[static_cast<std::size_t>(frames) / 2];
}

void draw(const Setup& setup) {
  setup.drawn.begin();
  setup.fragment.use();
  setup.fragment.set("width", setup.width);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void dispatch(const Setup& setup) {
  setup.compute.use();
  setup.compute.set("width", setup.width);
  glBindImageTexture(0, setup.computed.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glDispatchCompute((setup.width + 7) / 8, (setup.height + 7) / 8, 1);
}

std::vector<float> pixels_of(const Setup& setup, const Target& target) {
  std::vector<float> pixels(std::size_t{4} * setup.width * setup.height);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  glGetTextureImage(target.texture(), 0, GL_RGBA, GL_FLOAT,
                    static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
  return pixels;
}

void compare_stages(const Setup& setup) {
  const double by_fragment = median_time(setup.frames, [&] { draw(setup); });
  const double by_compute = median_time(setup.frames, [&] { dispatch(setup); });
  const std::vector<float> a = pixels_of(setup, setup.drawn), b = pixels_of(setup, setup.computed);
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  std::printf("the same arithmetic, %u×%u, milliseconds a frame (median of %d)\n", setup.width,
              setup.height, setup.frames);
  std::printf("  fragment shader  %9.3f\n  compute shader   %9.3f\n", by_fragment, by_compute);
  std::printf("  fragment / compute %.2f, largest difference %g\n", by_fragment / by_compute,
              static_cast<double>(largest));
}

/// Frames that are not waited for, but what `after` does with each; milliseconds a frame.
double queued_time(const Setup& setup, const std::function<void(int)>& before,
                   const std::function<void(int)>& after) {
  glFinish();
  const auto start = Clock::now();
  for (int i = 0; i < setup.frames; ++i) {
    before(i);
    dispatch(setup);
    after(i);
  }
  glFinish();
  return milliseconds(Clock::now() - start) / setup.frames;
}

void compare_queries(const Setup& setup) {
  constexpr int size = 8;
  std::array<GLuint, size> queries{};
  glCreateQueries(GL_TIME_ELAPSED, size, queries.data());
  const auto begin = [&](int i) {
    glBeginQuery(GL_TIME_ELAPSED, queries[static_cast<std::size_t>(i % size)]);
  };
  const auto read = [&](int i) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(queries[static_cast<std::size_t>(i % size)], GL_QUERY_RESULT,
                          &nanoseconds);
    return static_cast<double>(nanoseconds) / 1e6;
  };
  double told = 0;
  const double without = queued_time(
      setup, [](int) {}, [](int) {});
  const double waited = queued_time(setup, begin, [&](int i) {
    glEndQuery(GL_TIME_ELAPSED);
    told += read(i) / setup.frames;
  });
  const double ring = queued_time(
      setup,
      [&](int i) {
        if (i >= size) read(i);
        begin(i);
      },
      [](int) { glEndQuery(GL_TIME_ELAPSED); });
  glDeleteQueries(size, queries.data());
  std::printf("timer queries around a dispatch, milliseconds a frame (mean of %d)\n", setup.frames);
  std::printf("  none             %9.3f\n  waited for       %9.3f\n  a ring of %d      %9.3f\n",
              without, waited, size, ring);
  std::printf("  the queries say  %9.3f\n", told);
}

Result<void> run(std::uint32_t width, std::uint32_t height, int frames) {
  const auto context = Context::create();
  if (!context) return tl::unexpected(context.error());
  std::printf("%s\n", context->renderer().c_str());
  GLuint no_vertices = 0;
  glCreateVertexArrays(1, &no_vertices);
  glBindVertexArray(no_vertices);
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  auto fragment = Program::raster(vertex_source(), fragment_source());
  if (!fragment) return tl::unexpected(fragment.error());
  auto compute = Program::compute(compute_source());
  if (!compute) return tl::unexpected(compute.error());
  auto drawn = Target::make(Target::Content::values, width, height);
  if (!drawn) return tl::unexpected(drawn.error());
  auto computed = Target::make(Target::Content::values, width, height);
  if (!computed) return tl::unexpected(computed.error());
  const Setup setup{width,
                    height,
                    frames,
                    std::move(*fragment),
                    std::move(*compute),
                    std::move(*drawn),
                    std::move(*computed)};
  compare_stages(setup);
  compare_queries(setup);
  return {};
}

}  // namespace
}  // namespace metamer::gl

int main(int count, char** words) {
  unsigned width = 1920, height = 1080;
  int frames = 200;
  const bool read = (count < 2 || std::sscanf(words[1], "%ux%u", &width, &height) == 2) &&
                    (count < 3 || (frames = std::atoi(words[2])) > 0) && width - 1 < 16384 &&
                    height - 1 < 16384;
  if (!read || count > 3) {
    std::fprintf(stderr, "usage: gl_bench [WIDTHxHEIGHT [FRAMES]]\n");
    return 2;
  }
  const auto done = metamer::gl::run(width, height, frames);
  if (!done) std::fprintf(stderr, "error: %s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
