// An OpenGL context without a window.
#pragma once
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

namespace pelage::rivals {

/// OpenGL 4.5, core profile, no surface: on the first EGL device that is hardware, else on Mesa's surfaceless
/// platform, which is llvmpipe where there is no GPU. Current once made. Throws InputError where there is
/// none.
class Context {
 public:
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  void make_current() const;
  std::string renderer() const;  ///< the driver's own words; the context must be current

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// Throws DeviceError naming `call` and the error when OpenGL has noted one.
void check_gl(const char* call);

}  // namespace pelage::rivals
