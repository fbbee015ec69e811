#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/gl/context.hpp"
#include "harness/shells/opengl/program.hpp"

namespace pelage::gl {
namespace {

using Texels = std::vector<std::array<std::uint8_t, 2>>;

void repeat(GLuint texture, GLint minify, GLint magnify) {
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, minify);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, magnify);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

/// Returns the texture format with four channels if `four` is true, else with two. `texels` is the number
/// type of a channel: "half" or "byte".
GLenum format_of(const std::string& texels, bool four) {
  if (texels == "half") return four ? GL_RGBA16F : GL_RG16F;
  return four ? GL_RGBA8 : GL_RG8;
}

/// Averages neighbouring slices, so that `layers` slices of side x side texels become `depth` slices. Only
/// 3D textures need the averages, because each of their mip levels has fewer slices than the level before.
Texels merged(const Texels& texels, int side, int layers, int depth) {
  const std::size_t area = std::size_t(side) * std::size_t(side);
  Texels result(std::size_t(depth) * area);
  for (int d = 0; d < depth; ++d) {
    const int first = d * layers / depth, last = (d + 1) * layers / depth;
    for (std::size_t i = 0; i < area; ++i)
      for (std::size_t c = 0; c < 2; ++c) {
        int sum = 0;
        for (int n = first; n < last; ++n) sum += texels[std::size_t(n) * area + i][c];
        result[std::size_t(d) * area + i][c] = std::uint8_t((sum + (last - first) / 2) / (last - first));
      }
  }
  return result;
}

/// Makes a texture of one mip level. `what` is named in the error message.
gl::Object flat_texture(GLenum format, GLsizei width, GLsizei height, GLenum channels, GLenum type,
                        const void* texels, GLint filter, const std::string& what) {
  gl::Object texture = gl::make_texture(GL_TEXTURE_2D);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureStorage2D(texture.id(), 1, format, width, height);
  glTextureSubImage2D(texture.id(), 0, 0, 0, width, height, channels, type, texels);
  repeat(texture.id(), filter, filter);
  gl::check_gl(("uploading " + what).c_str());
  return texture;
}

}  // namespace

gl::Object fur_texture(const FurTexture& fur, const OpenGlOptions& options) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const bool volume = options.fur == "volume";
  const GLsizei levels = GLsizei(fur.level.size());
  gl::Object texture = gl::make_texture(volume ? GL_TEXTURE_3D : GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.id(), levels, format_of(options.texels, false), fur.size, fur.size, fur.layers);
  gl::check_gl("glTextureStorage3D of the fur");
  for (GLsizei l = 0; l < levels; ++l) {
    const int side = fur.size >> l, depth = volume ? std::max(1, fur.layers >> l) : fur.layers;
    const Texels& own = fur.level[std::size_t(l)];
    const Texels thinner = depth == fur.layers ? Texels{} : merged(own, side, fur.layers, depth);
    glTextureSubImage3D(texture.id(), l, 0, 0, 0, side, side, depth, GL_RG, GL_UNSIGNED_BYTE,
                        depth == fur.layers ? own.data() : thinner.data());
  }
  repeat(texture.id(), GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  gl::check_gl("uploading the fur");
  return texture;
}

gl::Object coat_texture(const CoatTexture& coat, const OpenGlOptions& options) {
  return flat_texture(format_of(options.texels, true), coat.size, coat.size, GL_RGBA, GL_UNSIGNED_BYTE,
                      coat.texel.data(), GL_LINEAR, "the coat");
}

gl::Object mask_texture(const std::vector<glm::vec4>& mask, int size) {
  return flat_texture(GL_RGBA32F, size, size, GL_RGBA, GL_FLOAT, mask.data(), GL_NEAREST, "the wetness mask");
}

gl::Object density_texture(const Style::Density& map) {
  const float one = 1;
  const bool none = map.value.empty();
  gl::Object texture = flat_texture(GL_R32F, none ? 1 : map.width, none ? 1 : map.height, GL_RED, GL_FLOAT,
                                    none ? &one : map.value.data(), GL_LINEAR, "the map of the density");
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

gl::Object turns_texture(const FrameInput& input) {
  const bool none = input.style.curl_turns.empty();
  const GLsizei layers = none ? 1 : input.scene.fur.layers, levels = none ? 1 : turn_steps + 1;
  std::vector<glm::vec2> texels;
  for (GLsizei n = 0; n < layers; ++n)
    for (GLsizei k = 0; k < levels; ++k) {
      const double h = (1.0 + double(n)) / double(layers);
      const double turns = double(input.scene.curl.turns * (float(k) / float(turn_steps)));
      const double angle = 2.0 * std::numbers::pi * turns * h;
      texels.emplace_back(h * std::cos(angle), h * std::sin(angle));
    }
  return flat_texture(GL_RG32F, levels, layers, GL_RG, GL_FLOAT, texels.data(), GL_NEAREST,
                      "the angles of the curls");
}

}  // namespace pelage::gl
