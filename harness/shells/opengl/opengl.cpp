// Draws a frame in OpenGL as in section 4 of S: first the base surface with depth writes, then the layers
// from the innermost to the outermost. Layers are blended, and depth-tested against the base surface.
#include "harness/shells/opengl/opengl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "harness/error.hpp"
#include "harness/gl/context.hpp"
#include "harness/gl/target.hpp"
#include "harness/prepare/water.hpp"
#include "harness/scene/shading_models.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage {
namespace {

using namespace gl;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

bool any_wet(const std::vector<glm::vec4>& mask) {
  return std::any_of(mask.begin(), mask.end(), [](const glm::vec4& texel) { return texel.w > 0.0f; });
}

void check_mask(const FrameInput& input, const std::vector<glm::vec4>& mask) {
  const std::size_t size = std::size_t(input.scene.wetness.size);
  if (mask.size() != size * size)
    throw InputError(fmt::format("OpenGL: the wetness mask must have {0} x {0} texels, but {1} were given",
                                 size, mask.size()));
}

const FrameInput& checked(const FrameInput& input, const std::vector<glm::vec4>& mask) {
  check_mask(input, mask);
  if (has_springs(input.scene.dynamics))
    throw InputError(fmt::format("dynamics.topology = {}: --pipeline opengl supports only silva",
                                 input.scene.dynamics.topology));
  if (input.scene.blend.order != "layer")
    throw InputError(
        fmt::format("blend.order = {}: --pipeline opengl supports only layer", input.scene.blend.order));
  if (!shading_model(input.scene.shading.model).in_opengl)
    throw InputError(fmt::format("shading.model = {}: --pipeline opengl supports only curling and wet",
                                 input.scene.shading.model));
  if (input.scene.shading.self_shadow != "darkening")
    throw InputError(fmt::format("shading.self_shadow = {}: --pipeline opengl supports only darkening",
                                 input.scene.shading.self_shadow));
  if (input.scene.fur.substeps > 1)
    throw InputError(
        fmt::format("fur.substeps = {}: --pipeline opengl draws without sub-steps; set fur.substeps to 1",
                    input.scene.fur.substeps));
  return input;
}

}  // namespace

struct OpenGl::State {
  std::shared_ptr<const FrameInput> input;
  OpenGlOptions options;
  bool changes;     ///< the water changes over time
  Context context;  // declared before the OpenGL objects, so that it is destroyed after them
  Vertices vertices;
  std::vector<glm::vec3> bent;
  std::vector<glm::vec4> layers;
  std::vector<glm::vec4> next_mask;  ///< the mask that frame() uploads; empty: the mask has not changed
  double build_ms = 0;
  Program skin, fur;
  Object strands, coat, mask, density, turns, field;
  Object fixed_buffer, bent_buffer, index_buffer, layer_buffer, arrays;
  Object away_buffer, towards_buffer;  ///< elements of the triangles that face away and of the others
  Target target;
  std::optional<SeenTriangles> seen;  ///< only with triangles=seen

  State(std::shared_ptr<const FrameInput> from, const std::vector<glm::vec4>& wetness,
        const OpenGlOptions& how)
      : input(std::move(from)),
        options(how),
        changes(water_changes(input->scene.wetness, input->droplets)),
        vertices(checked(*input, wetness), wetness),
        bent(vertices.bent(input->strands.anchor)),
        layers(layer_table(input->scene)),
        strands(fur_texture(input->fur, options)),
        coat(coat_texture(input->coat, options)),
        mask(mask_texture(wetness, input->scene.wetness.size)),
        density(density_texture(input->style.density)),
        turns(turns_texture(*input)),
        field(field_texture(*input)),
        fixed_buffer(make_buffer(vertices.fixed(), changes ? GL_DYNAMIC_STORAGE_BIT : 0)),
        bent_buffer(make_buffer(bent, GL_DYNAMIC_STORAGE_BIT)),
        index_buffer(make_buffer(vertices.index())),
        layer_buffer(make_buffer(layers)),
        arrays(make_vertex_array()),
        away_buffer(make_buffer(vertices.index(), GL_DYNAMIC_STORAGE_BIT)),
        towards_buffer(make_buffer(vertices.index(), GL_DYNAMIC_STORAGE_BIT)),
        target(options.target, input->camera.width, input->camera.height, true) {
    build(changes || any_wet(wetness));
    lay_out_vertices();
    fix_state();
    check_gl("setting up a scene");
  }
  ~State() { context.make_current(); }  // the destructors of the members need the context

  void build(bool wet) {
    const auto begin = Clock::now();
    const std::vector<Constant> constants = scene_constants(*input);
    const std::string defines = scene_defines(*input, options, wet);
    skin = scene_program("shell.vert", "skin.frag", defines + "#define SKIN\n", constants);
    fur = scene_program("shell.vert", "fur.frag", defines, constants);
    if (options.triangles == "seen") seen.emplace(defines, constants);
    build_ms = ms_since(begin);
    set_colliders(fur.id(), field.id(), *input, 0);
  }

  void lay_out_vertices() {
    const GLuint array = arrays.id();
    glVertexArrayVertexBuffer(array, 0, fixed_buffer.id(), 0, GLsizei(sizeof(Vertex)));
    glVertexArrayVertexBuffer(array, 1, bent_buffer.id(), 0, GLsizei(sizeof(glm::vec3)));
    glVertexArrayElementBuffer(array, index_buffer.id());
    const auto attribute = [array](GLuint location, GLint floats, std::size_t offset, GLuint buffer) {
      glEnableVertexArrayAttrib(array, location);
      glVertexArrayAttribFormat(array, location, floats, GL_FLOAT, GL_FALSE, GLuint(offset));
      glVertexArrayAttribBinding(array, location, buffer);
    };
    attribute(0, 3, offsetof(Vertex, position), 0);
    attribute(1, 2, offsetof(Vertex, uv), 0);
    attribute(2, 3, offsetof(Vertex, a), 0);
    attribute(3, 3, 0, 1);
    attribute(4, 3, offsetof(Vertex, curl_u), 0);
    attribute(5, 3, offsetof(Vertex, curl_v), 0);
    attribute(6, 3, offsetof(Vertex, dx_du), 0);
    attribute(7, 3, offsetof(Vertex, dx_dv), 0);
    attribute(8, 1, offsetof(Vertex, turn), 0);
  }

  /// Sets the OpenGL state that is the same for all frames. It is set only once, because no other scene uses
  /// this context.
  void fix_state() const {
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glBindVertexArray(arrays.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, layer_buffer.id());
    glBindTextureUnit(0, strands.id());
    glBindTextureUnit(1, coat.id());
    glBindTextureUnit(2, mask.id());
    glBindTextureUnit(3, density.id());
    glBindTextureUnit(4, turns.id());
    glBindTextureUnit(5, field.id());
    glViewport(0, 0, input->camera.width, input->camera.height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // the depth is near / w, from 0 to 1
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // the shader's colours are premultiplied by coverage
    glClearDepth(0.0);
    const glm::vec3 background = input->scene.image.background;
    glClearColor(background.x, background.y, background.z, 0.0f);
  }

  void draw_triangles(GLsizei instances) const {
    const auto corners = GLsizei(vertices.index().size());
    glDrawElementsInstanced(GL_TRIANGLES, corners, GL_UNSIGNED_INT, nullptr, instances);
  }

  /// Uploads the bent vertices and a changed mask.
  void upload() {
    glNamedBufferSubData(bent_buffer.id(), 0, GLsizeiptr(bent.size() * sizeof(glm::vec3)), bent.data());
    if (next_mask.empty()) return;
    const std::vector<Vertex>& fixed = vertices.fixed();
    glNamedBufferSubData(fixed_buffer.id(), 0, GLsizeiptr(fixed.size() * sizeof(Vertex)), fixed.data());
    const GLsizei size = input->scene.wetness.size;
    glTextureSubImage2D(mask.id(), 0, 0, 0, size, size, GL_RGBA, GL_FLOAT, next_mask.data());
    next_mask.clear();
  }

  void draw_base() const {
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glDisable(GL_BLEND);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    skin.use();
    draw_triangles(1);
  }

  /// Returns the numbers of the triangles of each sweep over the layers (docs/shells.md, section 5).
  std::vector<std::vector<std::uint32_t>> sweeps() const {
    if (input->scene.blend.faces == "all") {
      std::vector<std::uint32_t> all(input->mesh->triangle.size());
      std::iota(all.begin(), all.end(), 0u);
      return {all};
    }
    Facing found = facing(input->camera, *input->mesh);
    if (input->scene.blend.faces == "front") return {std::move(found.towards)};
    return {std::move(found.away), std::move(found.towards)};
  }

  /// Finds the triangles of each layer that some pixel shows.
  void find_seen() {
    if (!seen) return;
    upload();
    draw_base();
    seen->find(vertices.index(), layers, sweeps());
  }

  void draw_layers() const {
    if (seen) return draw_seen();
    if (input->scene.blend.faces == "all") return draw_layers([this](GLsizei n) { draw_triangles(n); });
    const auto lists = sweeps();
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const std::vector<std::uint32_t> elements = elements_of(lists[i], vertices.index());
      const GLuint buffer = (i == 0 ? away_buffer : towards_buffer).id();
      glNamedBufferSubData(buffer, 0, GLsizeiptr(elements.size() * sizeof(std::uint32_t)), elements.data());
      glVertexArrayElementBuffer(arrays.id(), buffer);
      draw_layers([&](GLsizei instances) {
        glDrawElementsInstanced(GL_TRIANGLES, GLsizei(elements.size()), GL_UNSIGNED_INT, nullptr, instances);
      });
    }
    glVertexArrayElementBuffer(arrays.id(), index_buffer.id());
  }

  void draw_seen() const {
    blend_layers();
    glVertexArrayElementBuffer(arrays.id(), seen->buffer());
    for (const SeenPart& part : seen->parts()) {
      set_layer(std::size_t(part.layer));
      // OpenGL takes the place of the first element as a pointer.
      // NOLINTNEXTLINE(performance-no-int-to-ptr)
      const auto* first = reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t));
      glDrawElements(GL_TRIANGLES, part.corners, GL_UNSIGNED_INT, first);
    }
    glVertexArrayElementBuffer(arrays.id(), index_buffer.id());
  }

  void blend_layers() const {
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GEQUAL);
    glEnable(GL_BLEND);
    fur.use();
  }

  void set_layer(std::size_t n) const { glUniform4fv(fur.place("layer"), 3, &layers[3 * n].x); }

  /// Draws the triangles of `draw(instances)` in all layers.
  template <class Draw>
  void draw_layers(const Draw& draw) const {
    blend_layers();
    if (options.draws == "instanced") return draw(input->scene.fur.layers);
    for (std::size_t n = 0; n < std::size_t(input->scene.fur.layers); ++n) {
      set_layer(n);
      draw(1);
    }
  }
};

OpenGl::OpenGl(std::shared_ptr<const FrameInput> input, const std::vector<glm::vec4>& mask,
               const OpenGlOptions& options)
    : state_(std::make_unique<State>(std::move(input), mask, options)) {
  state_->find_seen();
}
OpenGl::~OpenGl() = default;
OpenGl::OpenGl(OpenGl&&) noexcept = default;
OpenGl& OpenGl::operator=(OpenGl&&) noexcept = default;

void OpenGl::bend(const std::vector<glm::vec3>& tips, int frames) {
  if (tips.size() != state_->input->strands.anchor.size())
    throw InputError(fmt::format("OpenGL: the scene has {} strands, but {} tips were given",
                                 state_->input->strands.anchor.size(), tips.size()));
  state_->bent = state_->vertices.bent(tips);
  const DynamicsScene& dynamics = state_->input->scene.dynamics;
  state_->context.make_current();
  set_colliders(state_->fur.id(), state_->field.id(), *state_->input,
                double(frames) * dynamics.substeps * double(dynamics.step));
  // Here and not in frame(), so that neither the wall time nor the CPU time of the frame contains the search.
  state_->find_seen();
  glFinish();
}

void OpenGl::set_mask(const std::vector<glm::vec4>& mask) {
  State& s = *state_;
  check_mask(*s.input, mask);
  if (!s.changes) throw std::logic_error("OpenGl::set_mask: the water of the scene does not change");
  s.vertices.set_mask(mask);
  s.next_mask = mask;
}

double OpenGl::frame() {
  State& s = *state_;
  s.context.make_current();
  const auto begin = Clock::now();
  s.upload();
  s.draw_base();
  s.draw_layers();
  glFinish();
  const double wall_ms = ms_since(begin);
  check_gl("drawing a frame");
  return wall_ms;
}

Picture OpenGl::read() const {
  const State& s = *state_;
  s.context.make_current();
  return s.target.read();
}

double OpenGl::build_ms() const {
  return state_->build_ms;
}

std::string opengl_renderer() {
  return Context().renderer();
}

}  // namespace pelage
