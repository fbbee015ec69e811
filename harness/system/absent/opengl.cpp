// Replaces the backends that draw with OpenGL if CMake did not find libepoxy.
#include "harness/shells/opengl/opengl.hpp"

#include "harness/system/shells/backends.hpp"
#include "harness/system/strands/backends.hpp"

namespace pelage {
namespace {

[[noreturn]] void refuse() {
  throw CannotDraw(
      "there is no OpenGL in this build: install libepoxy-dev (Debian), configure and build again");
}

}  // namespace

std::string opengl_renderer() {
  refuse();
}
std::string shader_hash() {
  refuse();
}
std::unique_ptr<Backend> shells::open_opengl(const BackendOptions&, const Scene&) {
  refuse();
}
std::unique_ptr<Backend> strands::open_opengl(const BackendOptions&, const Scene&) {
  refuse();
}
// harness/system/strands/backends.hpp declares this function, whose other definition keeps the key strands.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void strands::show_keys(Backend&, std::vector<KeyStrand>) {
  refuse();
}

}  // namespace pelage
