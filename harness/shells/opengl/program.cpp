#include "harness/shells/opengl/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace pelage {

std::string shader_hash() {
  return gl::hash_of_files(gl::shader_folder());
}

namespace rivals {
namespace {

const char* glsl_type(std::size_t floats) {
  static constexpr const char* names[] = {"float", "vec2", "vec3", "vec4"};
  return names[floats - 1];
}

std::string declared(const Constant& constant, bool baked) {
  const char* type = glsl_type(constant.value.size());
  if (!baked) return fmt::format("uniform {} {};\n", type, constant.name);
  return fmt::format("const {0} {1} = {0}({2:.9g});\n", type, constant.name, fmt::join(constant.value, ", "));
}

void set_uniform(GLuint program, const Constant& constant) {
  const GLint place = glGetUniformLocation(program, constant.name.c_str());
  const float* value = constant.value.data();
  if (place < 0) return;  // this program does not use the constant
  switch (constant.value.size()) {
    case 1:
      return glProgramUniform1fv(program, place, 1, value);
    case 2:
      return glProgramUniform2fv(program, place, 1, value);
    case 3:
      return glProgramUniform3fv(program, place, 1, value);
    default:
      return glProgramUniform4fv(program, place, 1, value);
  }
}

}  // namespace

gl::Program scene_program(const std::string& vertex, const std::string& fragment, const std::string& defines,
                          const std::vector<Constant>& constants, bool baked) {
  std::string head = "#version 450 core\n" + defines;
  for (const Constant& constant : constants) head += declared(constant, baked);
  head += gl::shader_text("layers.glsl");
  gl::Program program({vertex, head + gl::shader_text("contact.glsl") + gl::shader_text(vertex)},
                      {fragment, head + gl::shader_text("light.glsl") + gl::shader_text(fragment)});
  if (!baked)
    for (const Constant& constant : constants) set_uniform(program.id(), constant);
  return program;
}

}  // namespace rivals
}  // namespace pelage
