#include "server/gl/compute.h"

#include <epoxy/gl.h>

#include <array>
#include <utility>

namespace metamer::gl {
namespace {

/// A shader storage block of every GL 4.5 holds as much; llvmpipe's are no larger.
constexpr std::size_t max_bytes = 128u << 20;

/// What the compiler or linker said. `get` is glGetShaderInfoLog or glGetProgramInfoLog.
template <class Get>
std::string log(Get get, GLuint object) {
  std::array<char, 2000> text{};
  get(object, static_cast<GLsizei>(text.size()), nullptr, text.data());
  return text.data();
}

/// A buffer that ends with its scope.
class Buffer {
 public:
  Buffer(GLuint binding, const void* data, std::size_t bytes) {
    glCreateBuffers(1, &name_);
    glNamedBufferData(name_, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_READ);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { glDeleteBuffers(1, &name_); }

  void read(std::span<float> to) const {
    glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(to.size_bytes()), to.data());
  }

 private:
  GLuint name_ = 0;
};

}  // namespace

Result<Compute> Compute::compile(const std::string& source) {
  // Compile.
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    auto result = problem("a shader does not compile: " + log(glGetShaderInfoLog, shader));
    glDeleteShader(shader);
    return result;
  }

  // Link; the program keeps the shader alive.
  Compute result(glCreateProgram());
  glAttachShader(result.program_, shader);
  glDeleteShader(shader);
  glLinkProgram(result.program_);
  glGetProgramiv(result.program_, GL_LINK_STATUS, &done);
  if (!done) return problem("a shader does not link: " + log(glGetProgramInfoLog, result.program_));
  return result;
}

Result<std::vector<float>> Compute::run(std::span<const float> inputs, std::size_t outputs,
                                        unsigned groups) const {
  std::vector<float> result(outputs);
  if (inputs.empty() || result.empty() || groups == 0) return result;
  if (inputs.size_bytes() > max_bytes || outputs * sizeof(float) > max_bytes)
    return problem("a compute shader's buffers hold at most 128 MiB");
  const Buffer from(0, inputs.data(), inputs.size_bytes());
  const Buffer to(1, nullptr, outputs * sizeof(float));
  glUseProgram(program_);
  glDispatchCompute(groups, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  to.read(result);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    return problem("GL error " + std::to_string(error) + " in a compute shader");
  return result;
}

Compute::Compute(Compute&& other) noexcept : program_(std::exchange(other.program_, 0)) {}
Compute::~Compute() { glDeleteProgram(program_); }  // Of 0, silently nothing.

}  // namespace metamer::gl
