#include "harness/gl/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "harness/data_folder.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"

namespace pelage::gl {
namespace fs = std::filesystem;
namespace {

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

void attach(GLuint program, GLenum kind, const Shader& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.text.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);  // OpenGL keeps the shader until it deletes the program
  GLint ok = 0, length = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(std::max(length, 1)), ' ');
  glGetShaderInfoLog(shader, length, nullptr, log.data());
  throw DeviceError(fmt::format("OpenGL does not compile {}:\n{}", source.name, log));
}

}  // namespace

fs::path shader_folder() {
  const std::vector<fs::path> places = data_folders(PELAGE_SOURCE_DIR, PELAGE_SHARE_DIR);
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::is_directory(place / "shaders", ignored)) return place / "shaders";
  throw InputError(fmt::format("no shaders in {}: set PELAGE_DATA to the folder that contains shaders/",
                               places.back().string()));
}

std::string shader_text(const fs::path& name) {
  return text_of(shader_folder() / name);
}

std::string hash_of_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Hash hash;
  for (const fs::path& file : files) hash.text(file.filename().string()).text(text_of(file));
  return hash.hex();
}

Program::Program(const Shader& vertex, const Shader& fragment) {
  program_ = Object(glCreateProgram(), [](GLuint name) { glDeleteProgram(name); });
  attach(id(), GL_VERTEX_SHADER, vertex);
  attach(id(), GL_FRAGMENT_SHADER, fragment);
  glLinkProgram(id());
  GLint ok = 0, length = 0;
  glGetProgramiv(id(), GL_LINK_STATUS, &ok);
  if (ok) return;
  glGetProgramiv(id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(std::max(length, 1)), ' ');
  glGetProgramInfoLog(id(), length, nullptr, log.data());
  throw DeviceError(fmt::format("OpenGL does not link {} and {}:\n{}", vertex.name, fragment.name, log));
}

}  // namespace pelage::gl
