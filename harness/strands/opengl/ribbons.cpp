#include "harness/strands/opengl/ribbons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <optional>

#include "harness/error.hpp"
#include "harness/gl/context.hpp"
#include "harness/gl/target.hpp"
#include "harness/strands/drawing/film_table.hpp"
#include "harness/strands/opengl/host_strands.hpp"
#include "harness/strands/opengl/passes.hpp"
#include "harness/strands/opengl/shaders.hpp"

namespace pelage::strands {
namespace {

using Clock = std::chrono::steady_clock;

bool is_instanced(const RibbonOptions& options) {
  if (options.expand != "instanced" && options.expand != "indexed")
    throw InputError(fmt::format("expand: '{}'; it must be instanced or indexed", options.expand));
  return options.expand == "instanced";
}

/// The film_table() as the shaders read it: luminance, gloss and opacity of each sample, and the factors of
/// the frame's layer, of which each sample has one.
std::vector<glm::vec4> film_of(const Look& look) {
  std::vector<glm::vec4> film;
  for (const LayerFrame& frame : film_table(look).frames) {
    const std::array<float, 5> factors = frame.factors();
    for (std::size_t i = 0; i < frame.film.size(); ++i) {
      const FilmSample& s = frame.film[i];
      film.emplace_back(float(s.luminance) / 128.0f, float(s.gloss) / 128.0f, float(s.opacity) / 255.0f,
                        i < factors.size() ? factors[i] : 0);
    }
  }
  return film;
}

}  // namespace

struct Ribbons::State {
  DrawingScene scene;
  HostStrands host;
  bool instanced;
  gl::Context context;  // declared before the OpenGL objects, so that it is destroyed after them
  gl::Program program;
  Strips strips;
  gl::Object film;
  gl::Target target;
  std::optional<OpacityPass> opacity;
  std::optional<SkinPass> skin;
  std::size_t drawn = 0;

  State(const DrawingScene& from, const std::vector<KeyedStrand>& strands, const RibbonOptions& options)
      : scene(from),
        host(from, strands),
        instanced(is_instanced(options)),
        program(strand_program(from, instanced)),
        strips(strands.size(), from.look.segments, instanced, has_lights(from.look), from.shapes != nullptr),
        film(gl::make_buffer(film_of(from.look))),
        target(options.target, from.camera.width, from.camera.height, false) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // the depth is near / w, from 0 to 1
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, film.id());
    if (from.look.shadow.reading != Shadow::none) opacity.emplace(from, strands.size(), instanced);
    if (from.skin) skin.emplace(from, target.colour());
    gl::check_gl("setting up strands");
  }
  ~State() { context.make_current(); }  // the destructors of the members need the context

  void draw(const Records& records) {
    if (opacity) opacity->draw(host.in_light());
    if (skin) skin->draw(scene.look.background);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    glViewport(0, 0, scene.camera.width, scene.camera.height);
    if (!skin) {
      const glm::vec3 background = scene.look.background;
      glClearColor(background.x, background.y, background.z, 0.0f);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // the shader's colours are premultiplied
    program.use();
    strips.draw(records);
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
  s.host.interpolate(keys);
  const Records& records = s.host.back_to_front();
  s.drawn = records.strand.size();
  s.draw(records);
  glFinish();
  const double wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  gl::check_gl("drawing strands");
  return wall_ms;
}

Picture Ribbons::read() const {
  const State& s = *state_;
  s.context.make_current();
  glBindFramebuffer(GL_FRAMEBUFFER, s.target.id());
  return s.target.read();
}

std::size_t Ribbons::drawn() const {
  return state_->drawn;
}

}  // namespace pelage::strands
