#pragma once

#include <cstdint>

#include "common/problem.h"

namespace metamer::gl {

/// What the rasteriser draws into: a texture and its depth, of one size. Needs a current Context,
/// also to be destroyed.
class Target {
 public:
  enum class Content {
    names,   ///< R32UI: of what is seen, by depth.
    values,  ///< RGBA32F, whatever is drawn last.
  };
  static Result<Target> make(Content content, std::uint32_t width, std::uint32_t height);

  Target() = default;
  Target(Target&& other) noexcept;
  Target& operator=(Target&& other) noexcept;
  ~Target();

  bool is(std::uint32_t width, std::uint32_t height) const {
    return frame_ != 0 && width_ == width && height_ == height;
  }
  /// Empties it and makes it the one to draw into.
  void begin() const;
  unsigned texture() const { return texture_; }

 private:
  Content content_ = Content::names;
  std::uint32_t width_ = 0, height_ = 0;
  unsigned texture_ = 0, depth_ = 0, frame_ = 0;
};

}  // namespace metamer::gl
