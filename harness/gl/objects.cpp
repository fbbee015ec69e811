#include "harness/gl/objects.hpp"

#include "harness/gl/context.hpp"

namespace pelage::gl {

Object make_texture(GLenum target) {
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  return {id, [](GLuint name) { glDeleteTextures(1, &name); }};
}

Object make_vertex_array() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return {id, [](GLuint name) { glDeleteVertexArrays(1, &name); }};
}

Object make_framebuffer() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return {id, [](GLuint name) { glDeleteFramebuffers(1, &name); }};
}

Object make_renderbuffer(GLenum format, int width, int height) {
  GLuint id = 0;
  glCreateRenderbuffers(1, &id);
  Object object(id, [](GLuint name) { glDeleteRenderbuffers(1, &name); });
  glNamedRenderbufferStorage(id, format, width, height);
  check_gl("glNamedRenderbufferStorage");
  return object;
}

Object make_buffer(const void* data, std::size_t bytes, GLbitfield usage) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Object object(id, [](GLuint name) { glDeleteBuffers(1, &name); });
  glNamedBufferStorage(id, GLsizeiptr(bytes), data, usage);
  check_gl("glNamedBufferStorage");
  return object;
}

}  // namespace pelage::gl
