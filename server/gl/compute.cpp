#include "server/gl/compute.h"

#include <epoxy/gl.h>

#include "server/gl/buffer.h"

namespace metamer::gl {

Result<Compute> Compute::compile(const std::string& source) {
  auto program = Program::compute(source);
  if (!program) return tl::unexpected(program.error());
  return Compute(std::move(*program));
}

Result<std::vector<float>> Compute::run(std::span<const float> inputs, std::size_t outputs,
                                        unsigned groups) const {
  std::vector<float> result(outputs);
  if (inputs.empty() || result.empty() || groups == 0) return result;
  auto from = Buffer::of<float>("a compute shader's inputs", inputs);
  auto to = Buffer::zeros("a compute shader's outputs", outputs * sizeof(float));
  if (!from || !to) return tl::unexpected(from ? to.error() : from.error());
  from->bind_storage(0);
  to->bind_storage(1);
  program_.use();
  glDispatchCompute(groups, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  to->read(result);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    return problem("GL error " + std::to_string(error) + " in a compute shader");
  return result;
}

}  // namespace metamer::gl
