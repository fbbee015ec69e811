// An OpenGL context without a window.
#pragma once
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

namespace pelage::gl {

/// An OpenGL 4.5 core context without a surface. The constructor tries EGL's hardware devices in turn, and
/// uses the first device that supports such a context. If no hardware device supports such a context, the
/// constructor uses Mesa's surfaceless platform. On a machine without a GPU, this platform draws with
/// llvmpipe. The constructor makes the context current. The constructor throws InputError if no such context
/// can be created.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  void make_current() const;
  std::string renderer() const;  ///< name and OpenGL version of the driver; the context must be current

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// Throws DeviceError with `call` and the error's name if OpenGL has recorded an error.
void check_gl(const char* call);

}  // namespace pelage::gl
