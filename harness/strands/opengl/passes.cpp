#include "harness/strands/opengl/passes.hpp"

#include <algorithm>
#include <array>

#include "harness/error.hpp"
#include "harness/gl/context.hpp"
#include "harness/strands/opengl/shaders.hpp"

namespace pelage::strands {
namespace {

constexpr float no_depth = 1e30f;  // view depth of a pixel without skin, and depth of a texel without strands

/// Indices of the triangles of `strands` strips. A strip has two vertices for each vertex of the curve.
std::vector<GLuint> triangles_of(std::size_t strands, int segments) {
  std::vector<GLuint> index;
  index.reserve(strands * std::size_t(segments) * 6);
  const auto vertices = GLuint(2 * segments + 2);
  for (std::size_t i = 0; i < strands; ++i)
    for (int k = 0; k < segments; ++k) {
      const GLuint first = GLuint(i) * vertices + GLuint(2 * k);
      index.insert(index.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
    }
  return index;
}

template <class T>
gl::Object room_for(std::size_t count) {
  return gl::make_buffer(nullptr, std::max<std::size_t>(count, 1) * sizeof(T), GL_DYNAMIC_STORAGE_BIT);
}

gl::Object texture_of(GLenum format, int width, int height) {
  gl::Object texture = gl::make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.id(), 1, format, width, height);
  glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

void need_complete(const gl::Object& framebuffer, const char* what) {
  if (glCheckNamedFramebufferStatus(framebuffer.id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw DeviceError(std::string("OpenGL cannot draw into the framebuffer of ") + what);
  static constexpr std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(framebuffer.id(), 2, both.data());
}

}  // namespace

Strips::Strips(std::size_t strands, int segments, bool instanced, bool lights, bool shapes)
    : segments_(segments),
      instanced_(instanced),
      lights_(lights),
      shapes_(shapes),
      records_(room_for<StrandRecord>(strands)),
      light_(room_for<LightRecord>(lights ? strands : 1)),
      shape_(room_for<ShapeRecord>(shapes ? strands : 1)),
      indices_(gl::make_buffer(instanced ? std::vector<GLuint>(1) : triangles_of(strands, segments))),
      arrays_(gl::make_vertex_array()) {
  const GLuint array = arrays_.id();
  if (!instanced) {
    glVertexArrayElementBuffer(array, indices_.id());
    return;
  }
  const auto attributes = [&](GLuint buffer, const gl::Object& records, GLuint first, GLuint count) {
    glVertexArrayVertexBuffer(array, buffer, records.id(), 0, GLsizei(16 * count));
    glVertexArrayBindingDivisor(array, buffer, 1);
    for (GLuint i = 0; i < count; ++i) {
      glEnableVertexArrayAttrib(array, first + i);
      glVertexArrayAttribFormat(array, first + i, 4, GL_FLOAT, GL_FALSE, GLuint(16 * i));
      glVertexArrayAttribBinding(array, first + i, buffer);
    }
  };
  static_assert(sizeof(StrandRecord) == 48 && sizeof(LightRecord) == 16 && sizeof(ShapeRecord) == 16);
  attributes(0, records_, 0, 3);
  if (lights) attributes(1, light_, 3, 1);
  if (shapes) attributes(2, shape_, 4, 1);
}

void Strips::draw(const Records& records) const {
  const auto count = GLsizei(records.strand.size());
  if (count == 0) return;
  const auto upload = [](const gl::Object& buffer, const auto& list) {
    glNamedBufferSubData(buffer.id(), 0, GLsizeiptr(list.size() * sizeof(list[0])), list.data());
  };
  upload(records_, records.strand);
  if (lights_) upload(light_, records.light);
  if (shapes_) upload(shape_, records.shape);
  glBindVertexArray(arrays_.id());
  if (instanced_) {
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * segments_ + 2, count);
    return;
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, light_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, shape_.id());
  glDrawElements(GL_TRIANGLES, count * segments_ * 6, GL_UNSIGNED_INT, nullptr);
}

OpacityPass::OpacityPass(const DrawingScene& scene, std::size_t strands, bool instanced)
    : size_(scene.look.shadow.size),
      program_(map_program(scene, instanced)),
      strips_(strands, scene.look.segments, instanced, false, scene.shapes != nullptr),
      least_(texture_of(GL_R32F, size_, size_)),
      sums_(texture_of(GL_RGBA32F, size_, size_)),
      framebuffer_(gl::make_framebuffer()) {
  glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, least_.id(), 0);
  glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT1, sums_.id(), 0);
  need_complete(framebuffer_, "the opacity map");
}

void OpacityPass::draw(const Records& in_light) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, size_, size_);
  static constexpr std::array<float, 4> least{no_depth, 0, 0, 0}, sums{0, 0, 0, 1};
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, least.data());
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 1, sums.data());
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquationi(0, GL_MIN);
  glBlendEquationi(1, GL_FUNC_ADD);
  glBlendFuncSeparatei(1, GL_ONE, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  strips_.draw(in_light);
  glBindTextureUnit(0, least_.id());
  glBindTextureUnit(1, sums_.id());
}

SkinPass::SkinPass(const DrawingScene& scene, GLuint colour)
    : width_(scene.camera.width),
      height_(scene.camera.height),
      indices_count_(int(3 * scene.skin->triangle.size())),
      program_(skin_program(scene)),
      vertices_(room_for<std::array<glm::vec3, 3>>(scene.skin->position.size())),
      indices_(gl::make_buffer(scene.skin->triangle)),
      arrays_(gl::make_vertex_array()),
      depth_(gl::make_renderbuffer(GL_DEPTH_COMPONENT32F, width_, height_)),
      view_depth_(texture_of(GL_R32F, width_, height_)),
      framebuffer_(gl::make_framebuffer()) {
  const SkinSurface& skin = *scene.skin;
  std::vector<std::array<glm::vec3, 3>> vertices;
  vertices.reserve(skin.position.size());
  for (std::size_t v = 0; v < skin.position.size(); ++v)
    vertices.push_back({skin.position[v], skin.normal[v], skin.colour[v]});
  constexpr auto stride = GLsizei(sizeof vertices[0]);
  glNamedBufferSubData(vertices_.id(), 0, GLsizeiptr(vertices.size() * sizeof vertices[0]), vertices.data());
  const GLuint array = arrays_.id();
  glVertexArrayVertexBuffer(array, 0, vertices_.id(), 0, stride);
  glVertexArrayElementBuffer(array, indices_.id());
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexArrayAttrib(array, i);
    glVertexArrayAttribFormat(array, i, 3, GL_FLOAT, GL_FALSE, GLuint(sizeof(glm::vec3)) * i);
    glVertexArrayAttribBinding(array, i, 0);
  }
  glNamedFramebufferRenderbuffer(framebuffer_.id(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
  glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT1, view_depth_.id(), 0);
  glNamedFramebufferRenderbuffer(framebuffer_.id(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  need_complete(framebuffer_, "the skin");
}

void SkinPass::draw(glm::vec3 background) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
  const std::array<float, 4> behind{background.x, background.y, background.z, 0};
  static constexpr std::array<float, 4> far{no_depth, 0, 0, 0};
  static constexpr float farthest = 0;  // near / W
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, behind.data());
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 1, far.data());
  glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &farthest);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  program_.use();
  glBindVertexArray(arrays_.id());
  glDrawElements(GL_TRIANGLES, indices_count_, GL_UNSIGNED_INT, nullptr);
  glBindTextureUnit(2, view_depth_.id());
}

}  // namespace pelage::strands
