// RAII owners of OpenGL objects. The OpenGL context must be current when the destructor of an owner runs.
#pragma once
#include <epoxy/gl.h>

#include <utility>
#include <vector>

namespace pelage::gl {

/// The name of an OpenGL object and the function that deletes it. Move-only.
class Object {
 public:
  using Delete = void (*)(GLuint);
  Object(GLuint id, Delete destroy) : id_(id), destroy_(destroy) {}
  ~Object() {
    if (id_ != 0) destroy_(id_);
  }
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)), destroy_(other.destroy_) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_;
  Delete destroy_;
};

Object make_texture(GLenum target);
Object make_vertex_array();
Object make_framebuffer();
Object make_renderbuffer(GLenum format, int width, int height);
/// Makes a buffer of `bytes` bytes with a copy of `data`. `usage` is 0, or GL_DYNAMIC_STORAGE_BIT if the
/// contents will change.
Object make_buffer(const void* data, std::size_t bytes, GLbitfield usage);
template <class T>
Object make_buffer(const std::vector<T>& values, GLbitfield usage = 0) {
  return make_buffer(values.data(), values.size() * sizeof(T), usage);
}

}  // namespace pelage::gl
