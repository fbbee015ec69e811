#include "harness/shells/opengl/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/shells/opengl/context.hpp"

namespace pelage {
namespace fs = std::filesystem;
namespace {

fs::path shader_folder() {
  const std::vector<fs::path> places = data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR);
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::is_directory(place / "shaders", ignored)) return place / "shaders";
  throw InputError(fmt::format("no shaders in {}: set PELAGE_DATA to the folder that contains shaders/",
                               places.back().string()));
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::string shader_hash() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(shader_folder())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Hash hash;
  for (const fs::path& file : files) hash.text(file.filename().string()).text(text_of(file));
  return hash.hex();
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

void attach(GLuint program, GLenum kind, const std::string& name, const std::string& head) {
  const fs::path folder = shader_folder();
  std::string text = head + text_of(folder / "layers.glsl");
  if (kind == GL_FRAGMENT_SHADER) text += text_of(folder / "light.glsl");
  text += text_of(folder / name);
  const GLuint shader = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);  // OpenGL deletes the shader together with the program
  GLint ok = 0, length = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(std::max(length, 1)), ' ');
  glGetShaderInfoLog(shader, length, nullptr, log.data());
  throw DeviceError(fmt::format("OpenGL does not compile {}:\n{}", name, log));
}

}  // namespace

Program::Program(const std::string& vertex, const std::string& fragment, const std::string& defines,
                 const std::vector<Constant>& constants, bool baked) {
  std::string head = "#version 450 core\n" + defines;
  for (const Constant& constant : constants) head += declared(constant, baked);
  Program made;  // deletes the OpenGL program if an exception is thrown
  made.id_ = glCreateProgram();
  attach(made.id_, GL_VERTEX_SHADER, vertex, head);
  attach(made.id_, GL_FRAGMENT_SHADER, fragment, head);
  glLinkProgram(made.id_);
  GLint ok = 0, length = 0;
  glGetProgramiv(made.id_, GL_LINK_STATUS, &ok);
  if (!ok) {
    glGetProgramiv(made.id_, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), ' ');
    glGetProgramInfoLog(made.id_, length, nullptr, log.data());
    throw DeviceError(fmt::format("OpenGL does not link {} and {}:\n{}", vertex, fragment, log));
  }
  if (!baked)
    for (const Constant& constant : constants) set_uniform(made.id_, constant);
  *this = std::move(made);
}

Program::~Program() {
  if (id_ != 0) glDeleteProgram(id_);
}
Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
Program& Program::operator=(Program&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}
void Program::use() const {
  glUseProgram(id_);
}
GLint Program::place(const char* uniform) const {
  return glGetUniformLocation(id_, uniform);
}

}  // namespace rivals
}  // namespace pelage
