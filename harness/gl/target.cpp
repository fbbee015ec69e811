#include "harness/gl/target.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"
#include "harness/gl/context.hpp"

namespace pelage::gl {
namespace {

GLenum format_of(const std::string& format) {
  if (format == "rgba8") return GL_RGBA8;
  if (format == "rgba16f") return GL_RGBA16F;
  if (format == "rgba32f") return GL_RGBA32F;
  throw InputError(fmt::format("target: '{}'; it must be rgba8, rgba16f or rgba32f", format));
}

}  // namespace

Target::Target(const std::string& format, int width, int height, bool depth)
    : width_(width),
      height_(height),
      colour_(make_renderbuffer(format_of(format), width, height)),
      depth_(make_renderbuffer(GL_DEPTH_COMPONENT32F, depth ? width : 1, depth ? height : 1)),
      framebuffer_(make_framebuffer()) {
  glNamedFramebufferRenderbuffer(id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
  if (depth) glNamedFramebufferRenderbuffer(id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  if (glCheckNamedFramebufferStatus(id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw DeviceError(fmt::format("OpenGL cannot draw into a framebuffer of format {}", format));
}

Picture Target::read() const {
  Picture picture{width_, height_, {}};
  picture.pixel.resize(std::size_t(width_) * std::size_t(height_));
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, picture.pixel.data());
  check_gl("glReadPixels");
  return picture;
}

}  // namespace pelage::gl
