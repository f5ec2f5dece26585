#include "server/gl/program.h"

#include <epoxy/gl.h>

#include <utility>

namespace metamer::gl {
namespace {

/// What the compiler or linker said. `get` is glGetShaderInfoLog or glGetProgramInfoLog.
template <class Get>
std::string log(Get get, GLuint object) {
  std::array<char, 2000> text{};
  get(object, static_cast<GLsizei>(text.size()), nullptr, text.data());
  return text.data();
}

}  // namespace

/// One that ends with its scope; a program keeps what it has been given.
class Program::Shader {
 public:
  Shader(GLenum stage, const std::string& source) : name_(glCreateShader(stage)) {
    const char* text = source.c_str();
    glShaderSource(name_, 1, &text, nullptr);
    glCompileShader(name_);
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name_); }

  Result<void> compiled() const {
    GLint done = 0;
    glGetShaderiv(name_, GL_COMPILE_STATUS, &done);
    if (done) return {};
    return problem("a shader does not compile: " + log(glGetShaderInfoLog, name_));
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_;
};

Result<Program> Program::link(std::initializer_list<const Shader*> shaders) {
  for (const Shader* shader : shaders)
    if (auto done = shader->compiled(); !done) return tl::unexpected(done.error());
  Program program;
  program.name_ = glCreateProgram();
  for (const Shader* shader : shaders) glAttachShader(program.name_, shader->name());
  glLinkProgram(program.name_);
  GLint done = 0;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &done);
  if (!done) return problem("a shader does not link: " + log(glGetProgramInfoLog, program.name_));
  return program;
}

Result<Program> Program::compute(const std::string& source) {
  const Shader shader(GL_COMPUTE_SHADER, source);
  return link({&shader});
}

Result<Program> Program::raster(const std::string& vertex, const std::string& fragment) {
  const Shader first(GL_VERTEX_SHADER, vertex), second(GL_FRAGMENT_SHADER, fragment);
  return link({&first, &second});
}

Program::Program(Program&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
Program& Program::operator=(Program&& other) noexcept {
  std::swap(name_, other.name_);
  return *this;
}
Program::~Program() {
  if (name_ != 0) glDeleteProgram(name_);
}

void Program::use() const { glUseProgram(name_); }

int Program::place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

void Program::set(const char* uniform, bool value) const {
  glProgramUniform1i(name_, place(uniform), value);
}
void Program::set(const char* uniform, std::uint32_t value) const {
  glProgramUniform1ui(name_, place(uniform), value);
}
void Program::set(const char* uniform, float value) const {
  glProgramUniform1f(name_, place(uniform), value);
}
void Program::set(const char* uniform, std::array<float, 2> value) const {
  glProgramUniform2fv(name_, place(uniform), 1, value.data());
}
void Program::set(const char* uniform, std::array<float, 3> value) const {
  glProgramUniform3fv(name_, place(uniform), 1, value.data());
}
void Program::set(const char* uniform, std::array<std::uint32_t, 2> value) const {
  glProgramUniform2uiv(name_, place(uniform), 1, value.data());
}
void Program::set(const char* uniform, const std::array<std::array<float, 4>, 3>& rows) const {
  glProgramUniformMatrix4x3fv(name_, place(uniform), 1, GL_TRUE, rows[0].data());
}

void dispatch_over(const Rect& region) {
  const auto groups = [](std::uint32_t side) { return (side + 7) / 8; };
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  glDispatchCompute(groups(region.width), groups(region.height), 1);
}

}  // namespace metamer::gl
