#pragma once

#include <string>

#include "common/problem.h"

/// OpenGL 4.5 core without a window, through EGL.
namespace metamer::gl {

/// How many EGL devices this machine has; Mesa's llvmpipe counts as one. 0: none, or no EGL.
int device_count();

/// A context, current in the thread that created it until it is destroyed there. fork() after
/// create() deadlocks with llvmpipe's threads: start processes before, or by posix_spawn.
class Context {
 public:
  /// On the first device that gives GL 4.5, graphics processors before software.
  static Result<Context> create();

  Context(Context&& other) noexcept;
  Context& operator=(Context&&) = delete;
  ~Context();

  const std::string& renderer() const {
    return renderer_;
  }  ///< "llvmpipe (LLVM 15.0.6, 256 bits)".

 private:
  Context(void* display, void* context) : display_(display), context_(context) {}
  static Result<Context> create_on(void* device);

  void* display_;
  void* context_;
  std::string renderer_;
};

}  // namespace metamer::gl
