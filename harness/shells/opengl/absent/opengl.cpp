// Replaces the sources of harness/shells/opengl if CMake did not find libepoxy.
#include "harness/shells/opengl/opengl.hpp"

#include "harness/error.hpp"

namespace pelage {
namespace {

[[noreturn]] void refuse() {
  throw InputError(
      "there is no OpenGL in this build: install libepoxy-dev (Debian), configure and build again");
}

}  // namespace

struct OpenGl::State {};

OpenGlOptions opengl_options(const std::string&) {
  refuse();
}
std::string to_text(const OpenGlOptions&) {
  refuse();
}
std::string opengl_renderer() {
  refuse();
}
std::string shader_hash() {
  refuse();
}
// opengl.hpp declares this constructor, and builds with OpenGL define it differently. The declaration passes
// `input` by value, because the constructor of builds with OpenGL stores it.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
OpenGl::OpenGl(std::shared_ptr<const FrameInput>, const std::vector<glm::vec4>&, const OpenGlOptions&) {
  refuse();
}
OpenGl::~OpenGl() = default;
OpenGl::OpenGl(OpenGl&&) noexcept = default;
OpenGl& OpenGl::operator=(OpenGl&&) noexcept = default;
void OpenGl::bend(const std::vector<glm::vec3>&, int) {
  refuse();
}
void OpenGl::set_mask(const std::vector<glm::vec4>&) {
  refuse();
}
double OpenGl::frame() {
  refuse();
}
Picture OpenGl::read() const {
  refuse();
}
double OpenGl::build_ms() const {
  refuse();
}

}  // namespace pelage
