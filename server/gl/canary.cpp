#include "server/gl/canary.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

#include "server/gl/compute.h"

namespace metamer::gl {
namespace {

/// Enough for a ray's walk through many boxes and a sum over 4,001 wavelengths, four at a time.
constexpr std::uint64_t needed_iterations = 32'000;
constexpr std::uint64_t tried_iterations = 1'000'000;

/// How far each of 64 invocations came in a loop of so many iterations, as its input says; the sum
/// keeps the compiler from leaving the loop out.
constexpr const char* loop = R"glsl(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { float input_of[]; };
layout(std430, binding = 1) writeonly buffer Outputs { float output_of[]; };
void main() {
    uint wanted = uint(input_of[0]), came = 0u, state = gl_GlobalInvocationID.x;
    while (came < wanted) {
        state = state * 1664525u + 1013904223u;
        ++came;
    }
    output_of[gl_GlobalInvocationID.x] = float(came) + float(state == 1u);
}
)glsl";

Result<std::uint64_t> iterations(const Compute& compute) {
  const float wanted = tried_iterations;
  const auto came = compute.run(std::span(&wanted, 1), 64, 1);
  if (!came) return tl::unexpected(came.error());
  return static_cast<std::uint64_t>(*std::min_element(came->begin(), came->end()));
}

/// Seconds of so many groups by the timer and by the clock.
std::pair<double, double> time(const Compute& compute, unsigned groups) {
  GLuint query = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &query);
  const float wanted = needed_iterations;
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  glBeginQuery(GL_TIME_ELAPSED, query);
  (void)compute.run(std::span(&wanted, 1), std::size_t{64} * groups, groups);
  glEndQuery(GL_TIME_ELAPSED);
  glFinish();
  const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start;
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
  glDeleteQueries(1, &query);
  return {static_cast<double>(nanoseconds) * 1e-9, clock.count()};
}

/// Whether a timer query says about what the clock says, for work that takes a moment. A driver's
/// first query is the least to be believed, and does not count.
bool timers_agree(const Compute& compute) {
  constexpr double moment = 0.02;
  for (unsigned groups = 8; groups <= 1u << 16; groups *= 4) {
    const auto [timer, clock] = time(compute, groups);
    if (groups > 8 && clock > moment) return timer > 0.5 * clock && timer < 1.1 * clock;
  }
  return false;
}

}  // namespace

Result<v1::GlCapabilities> examine(const Context& context) {
  v1::GlCapabilities found;
  found.set_renderer(context.renderer());
  found.set_version(reinterpret_cast<const char*>(glGetString(GL_VERSION)));
  found.set_software(context.software());
  GLint64 storage = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage);
  found.set_storage_bytes(static_cast<std::uint64_t>(storage));
  GLint side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
  found.set_texture_side(static_cast<std::uint32_t>(side));

  const auto compute = Compute::compile(loop);
  if (!compute) return tl::unexpected(compute.error());
  const auto came = iterations(*compute);
  if (!came) return tl::unexpected(came.error());
  if (*came < needed_iterations)
    return problem(context.renderer() + " leaves loops after " + std::to_string(*came) +
                   " iterations: too few to render");
  if (*came < tried_iterations) found.set_loop_iterations(*came);
  found.set_timers(timers_agree(*compute));
  return found;
}

}  // namespace metamer::gl
