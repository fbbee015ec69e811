// The picture into which OpenGL draws.
#pragma once
#include <string>

#include "harness/gl/objects.hpp"
#include "harness/picture/picture.hpp"

namespace pelage::gl {

class Target {
 public:
  /// `format` is "rgba32f", "rgba16f" or "rgba8". If `depth` is true, the target also has a depth buffer.
  /// Throws InputError for another format, and DeviceError if OpenGL cannot draw into it.
  Target(const std::string& format, int width, int height, bool depth);
  GLuint id() const { return framebuffer_.id(); }
  GLuint colour() const { return colour_.id(); }  ///< the renderbuffer of the colours
  /// Copies the picture to the host. The framebuffer is bound. The y axis of the shaders points down, so the
  /// first row is the top row.
  Picture read() const;

 private:
  int width_, height_;
  Object colour_, depth_, framebuffer_;
};

}  // namespace pelage::gl
