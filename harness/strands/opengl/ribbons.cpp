#include "harness/strands/opengl/ribbons.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/gl/context.hpp"
#include "harness/gl/program.hpp"
#include "harness/gl/target.hpp"
#include "harness/strands/opengl/host_strands.hpp"

namespace pelage::strands {
namespace {

using Clock = std::chrono::steady_clock;

std::string constant(const char* name, float value) {
  return fmt::format("const float {} = {:.9g};\n", name, value);
}
std::string constant(const char* name, glm::vec3 v) {
  return fmt::format("const vec3 {} = vec3({:.9g}, {:.9g}, {:.9g});\n", name, v.x, v.y, v.z);
}

std::string constants_of(const DrawingScene& scene) {
  const Camera& c = scene.camera;
  const Look& look = scene.look;
  const glm::vec3 light = glm::normalize(look.light);
  const glm::vec3 in_camera(glm::dot(glm::vec3(c.row_x), light) * c.pixel,
                            glm::dot(glm::vec3(c.row_y), light) * c.pixel,
                            glm::dot(glm::vec3(c.row_w), light));
  return fmt::format("const int SEGMENTS = {};\n", look.segments) + constant("PIXEL", c.pixel) +
         constant("NEAR", c.near) + constant("HALF_WIDTH", 0.5f * float(c.width)) +
         constant("HALF_HEIGHT", 0.5f * float(c.height)) + constant("TAPER", look.taper) +
         constant("OPACITY", look.opacity) + constant("LIGHT", in_camera) +
         constant("INTENSITY", look.intensity) + constant("AMBIENT", look.ambient) +
         constant("SPECULAR", look.specular) + constant("EXPONENT", look.exponent);
}

gl::Program program_of(const DrawingScene& scene, bool instanced) {
  const std::string head = "#version 450 core\n" + constants_of(scene);
  return {{"strands/strand.vert", head + (instanced ? "#define INSTANCED\n" : "") +
                                      gl::shader_text("strands/strip.glsl") +
                                      gl::shader_text("strands/strand.vert")},
          {"strands/strand.frag", head + gl::shader_text("strands/strand.frag")}};
}

bool is_instanced(const RibbonOptions& options) {
  if (options.expand != "instanced" && options.expand != "indexed")
    throw InputError(fmt::format("expand: '{}'; it must be instanced or indexed", options.expand));
  return options.expand == "instanced";
}

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

}  // namespace

struct Ribbons::State {
  DrawingScene scene;
  HostStrands host;
  bool instanced;
  gl::Context context;  // declared before the OpenGL objects, so that it is destroyed after them
  gl::Program program;
  gl::Object records, indices, arrays;
  gl::Target target;
  std::size_t drawn = 0;

  State(const DrawingScene& from, const std::vector<KeyedStrand>& strands, const RibbonOptions& options)
      : scene(from),
        host(from, strands),
        instanced(is_instanced(options)),
        program(program_of(from, instanced)),
        records(gl::make_buffer(nullptr, std::max<std::size_t>(strands.size(), 1) * sizeof(StrandRecord),
                                GL_DYNAMIC_STORAGE_BIT)),
        indices(gl::make_buffer(instanced ? std::vector<GLuint>(1)
                                          : triangles_of(strands.size(), from.look.segments))),
        arrays(gl::make_vertex_array()),
        target(options.target, from.camera.width, from.camera.height, false) {
    fix_state();
    gl::check_gl("setting up strands");
  }
  ~State() { context.make_current(); }  // the destructors of the members need the context

  /// Sets the OpenGL state that is the same for all frames.
  void fix_state() const {
    const GLuint array = arrays.id();
    if (instanced) {
      glVertexArrayVertexBuffer(array, 0, records.id(), 0, GLsizei(sizeof(StrandRecord)));
      glVertexArrayBindingDivisor(array, 0, 1);
      for (GLuint i = 0; i < 3; ++i) {
        glEnableVertexArrayAttrib(array, i);
        glVertexArrayAttribFormat(array, i, 4, GL_FLOAT, GL_FALSE, GLuint(16 * i));
        glVertexArrayAttribBinding(array, i, 0);
      }
    } else {
      glVertexArrayElementBuffer(array, indices.id());
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, records.id());
    }
    glBindVertexArray(array);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glViewport(0, 0, scene.camera.width, scene.camera.height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // the depth is near / w, from 0 to 1
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // the shader's colours are premultiplied
    const glm::vec3 background = scene.look.background;
    glClearColor(background.x, background.y, background.z, 0.0f);
    program.use();
  }

  void draw() const {
    const auto count = GLsizei(drawn);
    glClear(GL_COLOR_BUFFER_BIT);
    if (count == 0) return;
    if (instanced)
      glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * scene.look.segments + 2, count);
    else
      glDrawElements(GL_TRIANGLES, count * scene.look.segments * 6, GL_UNSIGNED_INT, nullptr);
  }
};

Ribbons::Ribbons(const DrawingScene& scene, const std::vector<KeyedStrand>& strands,
                 const RibbonOptions& options)
    : state_((check(scene.look), std::make_unique<State>(scene, strands, options))) {}
Ribbons::~Ribbons() = default;
Ribbons::Ribbons(Ribbons&&) noexcept = default;
Ribbons& Ribbons::operator=(Ribbons&&) noexcept = default;

double Ribbons::frame(const std::vector<KeyStrand>& keys) {
  State& s = *state_;
  s.context.make_current();
  glFinish();
  const auto begin = Clock::now();
  const std::vector<StrandRecord>& records = s.host.back_to_front(keys);
  s.drawn = records.size();
  if (!records.empty())
    glNamedBufferSubData(s.records.id(), 0, GLsizeiptr(records.size() * sizeof(StrandRecord)),
                         records.data());
  s.draw();
  glFinish();
  const double wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  gl::check_gl("drawing strands");
  return wall_ms;
}

Picture Ribbons::read() const {
  const State& s = *state_;
  s.context.make_current();
  return s.target.read();
}

std::size_t Ribbons::drawn() const {
  return state_->drawn;
}

}  // namespace pelage::strands
