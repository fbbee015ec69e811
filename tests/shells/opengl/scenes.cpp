#include "tests/shells/opengl/scenes.hpp"

#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/strands.hpp"

namespace pelage::rival_tests {

std::vector<glm::vec4> mask_of(const FrameInput& input) {
  std::vector<glm::vec4> mask;
  for (const reference::Clump& texel : reference::wetness_mask(input, frames).texel)
    mask.emplace_back(texel.centre.x, texel.centre.y, texel.radius, texel.wetness);
  return mask;
}

std::vector<glm::vec3> tips_of(const FrameInput& input) {
  std::vector<glm::vec3> tips;
  for (const reference::Strand& strand : reference::simulate(input, frames)) tips.emplace_back(strand.tip);
  return tips;
}

Picture drawn_by_opengl(const std::shared_ptr<const FrameInput>& input, const std::string& options) {
  OpenGl opengl(input, mask_of(*input), opengl_options(options));
  opengl.bend(tips_of(*input), frames);
  opengl.frame();
  return opengl.read();
}

}  // namespace pelage::rival_tests
