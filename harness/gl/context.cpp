#include "harness/gl/context.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "harness/error.hpp"

namespace pelage::gl {
namespace {

constexpr const char* what_to_do = "install libegl1 and a driver (Debian: libegl-mesa0 and libgl1-mesa-dri)";

/// Returns whether the list `extensions` contains the word `name`.
bool lists(const char* extensions, std::string_view name) {
  const std::string padded = fmt::format(" {} ", extensions == nullptr ? "" : extensions);
  return padded.find(fmt::format(" {} ", name)) != std::string::npos;
}

/// Returns the client extensions of EGL. Throws InputError if libEGL or an EGL driver is missing. Without the
/// exception, libepoxy would end the program in these cases.
const char* client_extensions() {
  // libEGL is never closed, because libepoxy continues to use it.
  if (dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL) == nullptr)
    throw InputError(fmt::format("no OpenGL: libEGL.so.1 is missing; {}", what_to_do));
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_EXT_platform_base"))
    throw InputError(fmt::format("no OpenGL: EGL finds no driver; {}", what_to_do));
  return extensions;
}

/// Returns the EGL displays that can be used, the preferred ones first: hardware devices, then Mesa's
/// surfaceless platform.
std::vector<EGLDisplay> displays(const char* client) {
  std::vector<EGLDisplay> found;
  if (lists(client, "EGL_EXT_device_enumeration") && lists(client, "EGL_EXT_device_query") &&
      lists(client, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> device{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(EGLint(device.size()), device.data(), &count)) count = 0;
    for (std::size_t i = 0; i < std::size_t(count); ++i)
      if (!lists(eglQueryDeviceStringEXT(device[i], EGL_EXTENSIONS), "EGL_MESA_device_software"))
        found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device[i], nullptr));
  }
  if (lists(client, "EGL_MESA_platform_surfaceless"))
    found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  return found;
}

EGLContext context_on(EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return EGL_NO_CONTEXT;
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_KHR_surfaceless_context") || !lists(extensions, "EGL_KHR_no_config_context") ||
      !eglBindAPI(EGL_OPENGL_API))
    return EGL_NO_CONTEXT;
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           4,
                           EGL_CONTEXT_MINOR_VERSION,
                           5,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
}

const char* error_name(GLenum code) {
  switch (code) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown error";
  }
}

}  // namespace

Context::Context() {
  for (const EGLDisplay display : displays(client_extensions())) {
    const EGLContext context = context_on(display);
    if (context == EGL_NO_CONTEXT) continue;
    display_ = display;
    context_ = context;
    make_current();
    return;
  }
  throw InputError(
      fmt::format("no OpenGL: no EGL display provides OpenGL 4.5 without a window; {}", what_to_do));
}

// The destructor does not terminate the EGL display, because other contexts may use the same display.
Context::~Context() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void Context::make_current() const {
  if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    throw DeviceError(fmt::format("OpenGL: eglMakeCurrent failed (EGL error {:#x})", eglGetError()));
}

std::string Context::renderer() const {
  return fmt::format("{}, OpenGL {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                     reinterpret_cast<const char*>(glGetString(GL_VERSION)));
}

void check_gl(const char* call) {
  const GLenum code = glGetError();
  if (code != GL_NO_ERROR) throw DeviceError(fmt::format("OpenGL: {}: {}", call, error_name(code)));
}

}  // namespace pelage::gl
