#include "server/gl/buffer.h"

#include <epoxy/gl.h>

#include <string>
#include <utility>

namespace metamer::gl {

Result<Buffer> Buffer::zeros(const char* what, std::size_t bytes) {
  auto buffer = copy(what, nullptr, bytes);
  if (buffer) buffer->clear();
  return buffer;
}

Result<Buffer> Buffer::copy(const char* what, const void* data, std::size_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > static_cast<std::uint64_t>(most))
    return problem(std::string(what) + " take " + std::to_string(bytes >> 20) +
                   " MiB; this GL device's buffers hold " + std::to_string(most >> 20));
  while (glGetError() != GL_NO_ERROR) {
  }
  Buffer buffer;
  glCreateBuffers(1, &buffer.name_);
  // A buffer of nothing can't be bound.
  glNamedBufferData(buffer.name_, static_cast<GLsizeiptr>(bytes > 0 ? bytes : 16),
                    bytes > 0 ? data : nullptr, GL_STATIC_DRAW);
  if (glGetError() != GL_NO_ERROR)
    return problem(std::string("no GL memory for ") + what + " (" + std::to_string(bytes >> 20) +
                   " MiB)");
  return buffer;
}

Buffer::Buffer(Buffer&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(name_, other.name_);
  return *this;
}
Buffer::~Buffer() {
  if (name_ != 0) glDeleteBuffers(1, &name_);
}

void Buffer::bind_storage(unsigned binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_);
}

void Buffer::read(std::span<float> to) const {
  glGetNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(to.size_bytes()), to.data());
}

void Buffer::clear() const {
  const GLuint zero = 0;
  glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

}  // namespace metamer::gl
