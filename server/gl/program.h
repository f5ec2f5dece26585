#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "common/problem.h"
#include "server/film/film.h"

namespace metamer::gl {

/// A linked program. Needs a current Context, also to be destroyed. A uniform that the linker has
/// removed is set without effect.
class Program {
 public:
  Program() = default;
  /// The compiler's words where it refuses the source.
  static Result<Program> compute(const std::string& source);
  static Result<Program> raster(const std::string& vertex, const std::string& fragment);

  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  explicit operator bool() const { return name_ != 0; }
  void use() const;
  void set(const char* uniform, bool value) const;
  void set(const char* uniform, std::uint32_t value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, std::array<float, 2> value) const;
  void set(const char* uniform, std::array<float, 3> value) const;
  void set(const char* uniform, std::array<std::uint32_t, 2> value) const;
  /// Three rows of four, for a mat4x3.
  void set(const char* uniform, const std::array<std::array<float, 4>, 3>& rows) const;

 private:
  class Shader;
  static Result<Program> link(std::initializer_list<const Shader*> shaders);
  int place(const char* uniform) const;

  unsigned name_ = 0;
};

/// Runs the compute shader in use, of groups of 8 × 8, over a region's pixels, after all that was
/// drawn and computed before.
void dispatch_over(const Rect& region);

}  // namespace metamer::gl
