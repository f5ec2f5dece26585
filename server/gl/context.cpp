#include "server/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <utility>
#include <vector>

namespace metamer::gl {
namespace {

constexpr int max_devices = 16;  // More than one machine's graphics processors.

/// "eglInitialize failed (EGL error 0x3001)".
tl::unexpected<Problem> egl_problem(const char* call) {
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(), "%s failed (EGL error 0x%04x)", call,
                static_cast<unsigned>(eglGetError()));
  return problem(text.data());
}

bool is_software(void* device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions && std::string_view(extensions).find("software") != std::string_view::npos;
}

/// The library that is not there: libepoxy would end the process. Null: all are.
const char* missing_library() {
  const auto is_there = [](const char* name) { return dlopen(name, RTLD_LAZY) != nullptr; };
  if (!is_there("libEGL.so.1")) return "libEGL.so.1, in Debian of the package libegl1";
  if (!is_there("libOpenGL.so.0") && !is_there("libGL.so.1"))
    return "libOpenGL.so.0, in Debian of the package libopengl0";
  return nullptr;
}

std::vector<void*> devices() {
  if (missing_library() != nullptr) return {};
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    return {};
  std::array<EGLDeviceEXT, max_devices> found{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(max_devices, found.data(), &count)) return {};
  return std::vector<void*>(found.begin(), found.begin() + count);
}

/// Those that a word names, the best first.
Result<std::vector<void*>> chosen_devices(const std::string& word) {
  if (const char* library = missing_library())
    return problem(std::string("this machine has no ") + library);
  std::vector<void*> all = devices();
  if (all.empty())
    return problem(
        "this machine has no EGL device: a driver is missing, in Debian the package "
        "libgl1-mesa-dri");
  if (word == "auto") {
    std::stable_partition(all.begin(), all.end(), [](void* one) { return !is_software(one); });
    return all;
  }
  if (word == "reference") {
    std::erase_if(all, [](void* one) { return !is_software(one); });
    if (all.empty())
      return problem(
          "this machine has no software EGL device, in Debian of the package libgl1-mesa-dri");
    return all;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size())
    return problem("a GL device is auto, reference or a number, and not \"" + word + "\"");
  if (number >= all.size())
    return problem("there is no GL device " + word + ": this machine has " +
                   std::to_string(all.size()) + ", counted from 0");
  return std::vector<void*>{all[number]};
}

}  // namespace

int device_count() { return static_cast<int>(devices().size()); }

Result<Context> Context::create(const std::string& word) {
  const auto chosen = chosen_devices(word);
  if (!chosen) return tl::unexpected(chosen.error());
  Problem last;
  for (void* device : *chosen) {
    auto context = create_on(device);
    if (context) return context;
    last = context.error();
  }
  return tl::unexpected(last);
}

Result<Context> Context::create_on(void* device) {
  // Open the device.
  const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  if (display == EGL_NO_DISPLAY) return egl_problem("eglGetPlatformDisplayEXT");
  if (!eglInitialize(display, nullptr, nullptr)) return egl_problem("eglInitialize");

  // Ask for GL 4.5 core without any surface; the context ends with `result` from here on.
  if (!eglBindAPI(EGL_OPENGL_API)) return egl_problem("eglBindAPI");
  // A driver that can't say when its GPU was reset has the shorter list.
  constexpr EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                               EGL_LOSE_CONTEXT_ON_RESET,
                               EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT) {
    std::array<EGLint, 7> less{};
    std::copy_n(wanted, 6, less.begin());
    less.back() = EGL_NONE;
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, less.data());
  }
  if (context == EGL_NO_CONTEXT) return egl_problem("eglCreateContext for GL 4.5");
  Context result(display, context);
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return egl_problem("eglMakeCurrent");
  result.renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  result.software_ = is_software(device);
  // Core GL draws nothing without an array of attributes, even where there are none.
  GLuint no_attributes = 0;
  glCreateVertexArrays(1, &no_attributes);
  glBindVertexArray(no_attributes);
  return result;
}

void Context::release() const {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

Result<void> Context::make_current() const {
  if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    return egl_problem("eglMakeCurrent");
  return {};
}

Context::Context(Context&& other) noexcept
    : display_(other.display_),
      context_(std::exchange(other.context_, nullptr)),
      renderer_(std::move(other.renderer_)),
      software_(other.software_) {}

Context::~Context() {
  if (!context_) return;
  // The display stays open: EGL has one for each device, which another context may share.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

Result<void> check_context() {
  if (eglGetCurrentContext() == EGL_NO_CONTEXT) return problem("the GL context is gone");
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    return problem("the GL context was lost: the graphics processor was reset");
  return {};
}

}  // namespace metamer::gl
