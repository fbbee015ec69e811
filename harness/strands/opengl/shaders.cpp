#include "harness/strands/opengl/shaders.hpp"

#include <fmt/format.h>

#include <glm/geometric.hpp>

namespace pelage::strands {
namespace {

std::string constant(const char* name, float value) {
  return fmt::format("const float {} = {:.9g};\n", name, value);
}
std::string text_of(glm::vec3 v) {
  return fmt::format("vec3({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
}
std::string constant(const char* name, glm::vec3 v) {
  return fmt::format("const vec3 {} = {};\n", name, text_of(v));
}
std::string constant(const char* name, glm::vec4 v) {
  return fmt::format("const vec4 {} = vec4({:.9g}, {:.9g}, {:.9g}, {:.9g});\n", name, v.x, v.y, v.z, v.w);
}

/// What a strip, the skin and the opacity map have in common. `width`, `height` and `pixel` are those of the
/// picture or of the opacity map.
std::string head(const Look& look, int width, int height, float pixel) {
  std::string text = "#version 450 core\n" + constant("PIXEL", pixel) +
                     constant("HALF_WIDTH", 0.5f * float(width)) +
                     constant("HALF_HEIGHT", 0.5f * float(height)) + constant("INTENSITY", look.intensity) +
                     constant("AMBIENT", look.ambient) + constant("SKIN_SHADOW", look.skin_shadow);
  return text;
}

std::string strip_constants(const DrawingScene& scene, glm::vec3 light, bool own_segments) {
  const Look& look = scene.look;
  return fmt::format("const int SEGMENTS = {};\n#define OWN_SEGMENTS {}\n", look.segments,
                     int(own_segments)) +
         constant("NEAR", scene.camera.near) + constant("TAPER", look.taper) +
         constant("OPACITY", look.opacity) + constant("LIGHT", light) + constant("SPECULAR", look.specular) +
         constant("EXPONENT", look.exponent) +
         (has_lights(look)
              ? "#define LIGHTS\nlayout(std430, binding = 2) readonly buffer Film { vec4 film[]; };\n"
              : "") +
         (has_layer_looks(look) ? "#define LAYERS\n" : "") +
         (scene.shapes
              ? fmt::format("#define SHAPES\nconst int STRAND_SEGMENTS = {};\n", look.strand_segments)
              : "");
}

std::string shadow_text(const DrawingScene& scene) {
  const ShadowLook& shadow = scene.look.shadow;
  std::string text = fmt::format("#define SHADOW {}\n", shadow.reading == Shadow::none     ? 0
                                                        : shadow.reading == Shadow::linear ? 1
                                                                                           : 2);
  if (shadow.reading != Shadow::none) {
    const MapRows rows = map_rows(scene.camera, scene.look);
    text += constant("MAP_COLUMN", rows.column) + constant("MAP_ROW", rows.row) +
            constant("MAP_DEPTH", rows.depth) + constant("MAP_SIZE", float(shadow.size)) +
            constant("PER_LENGTH", 1 / shadow.length);
  }
  return text + gl::shader_text("strands/shadow.glsl");
}

gl::Program program_of(const std::string& constants, bool instanced) {
  return {{"strands/strand.vert", constants + (instanced ? "#define INSTANCED\n" : "") +
                                      gl::shader_text("strands/strip.glsl") +
                                      gl::shader_text("strands/strand.vert")},
          {"strands/strand.frag", constants + gl::shader_text("strands/strand.frag")}};
}

}  // namespace

gl::Program strand_program(const DrawingScene& scene, bool instanced) {
  const Camera& c = scene.camera;
  const glm::vec3 light = glm::normalize(scene.look.light);
  const glm::vec3 in_camera(glm::dot(glm::vec3(c.row_x), light) * c.pixel,
                            glm::dot(glm::vec3(c.row_y), light) * c.pixel,
                            glm::dot(glm::vec3(c.row_w), light));
  return program_of(head(scene.look, c.width, c.height, c.pixel) + (scene.skin ? "#define SKIN\n" : "") +
                        strip_constants(scene, in_camera, scene.look.own_segments) + shadow_text(scene),
                    instanced);
}

gl::Program map_program(const DrawingScene& scene, bool instanced) {
  const int size = scene.look.shadow.size;
  return program_of(head(scene.look, size, size, light_view(scene.look).texel) + "#define MAP\n" +
                        strip_constants(scene, glm::vec3(0, 0, 1), false),
                    instanced);
}

gl::Program skin_program(const DrawingScene& scene) {
  const Camera& c = scene.camera;
  const Irradiance fill = irradiance_of(scene.look);
  std::string fills;
  for (const glm::vec3& coefficient : fill) fills += (fills.empty() ? "" : ", ") + text_of(coefficient);
  const std::string constants =
      head(scene.look, c.width, c.height, c.pixel) + constant("NEAR", c.near) +
      constant("ROW_X", glm::vec4(c.row_x)) + constant("ROW_Y", glm::vec4(c.row_y)) +
      constant("ROW_W", glm::vec4(c.row_w)) + constant("OBJECT_LIGHT", glm::normalize(scene.look.light)) +
      fmt::format("const vec3 FILL[9] = vec3[9]({});\n", fills) + shadow_text(scene);
  return {{"strands/skin.vert", constants + gl::shader_text("strands/skin.vert")},
          {"strands/skin.frag", constants + gl::shader_text("strands/skin.frag")}};
}

}  // namespace pelage::strands
