#include "harness/shells/opengl/seen.hpp"

namespace pelage::rivals {

SeenTriangles::SeenTriangles(const std::string& defines, const std::vector<Constant>& constants)
    : program_(scene_program("shell.vert", "seen.frag", defines, constants)) {}

void SeenTriangles::find(const std::vector<std::uint32_t>& index, const std::vector<glm::vec4>& layers,
                         const std::vector<std::vector<std::uint32_t>>& sweeps) {
  const std::size_t triangles = index.size() / 3, count = layers.size() / 3;
  std::vector<std::uint32_t> seen(triangles * count, 0);
  const gl::Object flags = gl::make_buffer(seen);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, flags.id());
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  program_.use();
  const GLint place = program_.place("layer"), first = program_.place("first");
  for (std::size_t n = 0; n < count; ++n) {
    glUniform4fv(place, 3, &layers[3 * n].x);
    glUniform1ui(first, GLuint(n * triangles));
    glDrawElements(GL_TRIANGLES, GLsizei(index.size()), GL_UNSIGNED_INT, nullptr);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(flags.id(), 0, GLsizeiptr(seen.size() * sizeof(std::uint32_t)), seen.data());

  std::vector<std::uint32_t> elements;
  parts_.clear();
  for (const std::vector<std::uint32_t>& sweep : sweeps)
    for (std::size_t n = 0; n < count; ++n) {
      SeenPart part{int(n), 0, elements.size()};
      for (const std::uint32_t t : sweep)
        if (seen[n * triangles + t])
          elements.insert(elements.end(), index.begin() + std::ptrdiff_t(3 * t),
                          index.begin() + std::ptrdiff_t(3 * t + 3));
      part.corners = GLsizei(elements.size() - part.first);
      parts_.push_back(part);
    }
  if (!elements.empty()) buffer_ = gl::make_buffer(elements);
}

}  // namespace pelage::rivals
