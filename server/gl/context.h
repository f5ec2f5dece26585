#pragma once

#include <string>

#include "common/problem.h"

/// OpenGL 4.5 core without a window, through EGL.
namespace metamer::gl {

/// How many EGL devices this machine has; Mesa's llvmpipe counts as one. 0: none, or no EGL.
int device_count();

/// A context, current in the thread that created it until it is destroyed or released there.
/// fork() after create() deadlocks with llvmpipe's threads: start processes before, or by
/// posix_spawn.
class Context {
 public:
  /// `device` is "auto", the first one that gives GL 4.5, graphics processors before software;
  /// "reference", the first software one; or a number, in EGL's order. Errors: there is none such,
  /// or no driver.
  static Result<Context> create(const std::string& device = "auto");

  /// Lets another thread have it, and takes it into this one.
  void release() const;
  Result<void> make_current() const;

  Context(Context&& other) noexcept;
  Context& operator=(Context&&) = delete;
  ~Context();

  /// "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }
  bool software() const { return software_; }

 private:
  Context(void* display, void* context) : display_(display), context_(context) {}
  static Result<Context> create_on(void* device);

  void* display_;
  void* context_;
  std::string renderer_;
  bool software_ = false;
};

/// Whether this thread still has a context that works. A GPU that was reset loses it; calls without
/// one do nothing, and say nothing.
Result<void> check_context();

}  // namespace metamer::gl
