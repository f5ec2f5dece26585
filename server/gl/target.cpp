#include "server/gl/target.h"

#include <epoxy/gl.h>

#include <utility>

namespace metamer::gl {

Result<Target> Target::make(Content content, std::uint32_t width, std::uint32_t height) {
  Target target;
  target.content_ = content;
  target.width_ = width;
  target.height_ = height;
  const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
  glCreateFramebuffers(1, &target.frame_);
  glCreateTextures(GL_TEXTURE_2D, 1, &target.texture_);
  glTextureStorage2D(target.texture_, 1, content == Content::names ? GL_R32UI : GL_RGBA32F, w, h);
  // Names are not to be filtered; with any other setting nothing is read.
  glTextureParameteri(target.texture_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(target.texture_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glNamedFramebufferTexture(target.frame_, GL_COLOR_ATTACHMENT0, target.texture_, 0);
  if (content == Content::names) {
    glCreateRenderbuffers(1, &target.depth_);
    glNamedRenderbufferStorage(target.depth_, GL_DEPTH_COMPONENT32F, w, h);
    glNamedFramebufferRenderbuffer(target.frame_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   target.depth_);
  }
  if (glCheckNamedFramebufferStatus(target.frame_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return problem("this GL device has no framebuffer of " + std::to_string(width) + "x" +
                   std::to_string(height));
  return target;
}

Target::Target(Target&& other) noexcept { *this = std::move(other); }

Target& Target::operator=(Target&& other) noexcept {
  content_ = other.content_;
  width_ = other.width_;
  height_ = other.height_;
  std::swap(texture_, other.texture_);
  std::swap(depth_, other.depth_);
  std::swap(frame_, other.frame_);
  return *this;
}

Target::~Target() {
  if (frame_ != 0) glDeleteFramebuffers(1, &frame_);
  if (depth_ != 0) glDeleteRenderbuffers(1, &depth_);
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void Target::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
  if (content_ == Content::values) {
    const GLfloat dark[4] = {};
    glDisable(GL_DEPTH_TEST);
    glClearBufferfv(GL_COLOR, 0, dark);
    return;
  }
  const GLuint nothing[4] = {};
  const GLfloat far_away = 0;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearBufferuiv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_DEPTH, 0, &far_away);
}

}  // namespace metamer::gl
