// GLSL programs, and the folder of their files.
#pragma once
#include <filesystem>
#include <string>

#include "harness/gl/objects.hpp"

namespace pelage::gl {

/// Returns the folder shaders/ of the data folders (harness/data_folder.hpp). Throws InputError if it is
/// missing.
std::filesystem::path shader_folder();

/// Returns the text of a file in shader_folder(). Throws InputError if the file cannot be read.
std::string shader_text(const std::filesystem::path& name);

/// Returns a hash of the names and the contents of the files in `folder`, without those in its subfolders, as
/// 16 hexadecimal digits.
std::string hash_of_files(const std::filesystem::path& folder);

/// The source of a shader. Messages contain the name.
struct Shader {
  std::string name, text;
};

/// A linked GLSL program. Move-only.
class Program {
 public:
  Program() = default;
  /// Compiles and links two shaders. Throws DeviceError with OpenGL's log if OpenGL cannot compile or link
  /// them.
  Program(const Shader& vertex, const Shader& fragment);
  GLuint id() const { return program_.id(); }
  void use() const { glUseProgram(id()); }
  /// Location of the uniform, or -1 if the program does not use it.
  GLint place(const char* uniform) const { return glGetUniformLocation(id(), uniform); }

 private:
  Object program_{0, nullptr};
};

}  // namespace pelage::gl
