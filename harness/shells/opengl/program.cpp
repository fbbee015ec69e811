#include "harness/shells/opengl/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pelage {

std::string shader_hash() {
  return gl::hash_of_files(gl::shader_folder());
}

namespace gl {
namespace {

const char* glsl_type(std::size_t floats) {
  static constexpr const char* names[] = {"float", "vec2", "vec3", "vec4"};
  return names[floats - 1];
}

}  // namespace

gl::Program scene_program(const std::string& vertex, const std::string& fragment, const std::string& defines,
                          const std::vector<Constant>& constants) {
  std::string head = "#version 450 core\n" + defines;
  for (const Constant& constant : constants)
    head += fmt::format("const {0} {1} = {0}({2:.9g});\n", glsl_type(constant.value.size()), constant.name,
                        fmt::join(constant.value, ", "));
  head += gl::shader_text("layers.glsl");
  return gl::Program({vertex, head + gl::shader_text("contact.glsl") + gl::shader_text(vertex)},
                     {fragment, head + gl::shader_text("light.glsl") + gl::shader_text(fragment)});
}

}  // namespace gl
}  // namespace pelage
