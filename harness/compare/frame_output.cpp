#include "harness/compare/frame_output.hpp"

#include <limits>

#include "harness/prepare/moving_skin.hpp"
#include "harness/shells/reference/mask.hpp"
#include "harness/shells/reference/reference.hpp"
#include "harness/shells/reference/strands.hpp"
#include "harness/springs/reference/reference.hpp"

namespace pelage {

std::vector<glm::vec4> reference_mask(const FrameInput& input, int frames) {
  std::vector<glm::vec4> mask;
  for (const reference::Clump& clump : reference::wetness_mask(input, frames).texel)
    mask.emplace_back(glm::vec2(clump.centre), clump.radius, clump.wetness);
  return mask;
}

FrameOutput reference_motion(const FrameInput& input, int frames) {
  FrameOutput output{"reference", frames, {}, {}, {}, {}};
  if (has_springs(input.scene.dynamics)) {
    const springs::SomeSticks all =
        springs::some_reference_sticks(input, frames, std::numeric_limits<std::size_t>::max());
    output.tips.assign(all.offset.begin(), all.offset.end());
    output.velocities.assign(all.velocity.begin(), all.velocity.end());
  } else {
    for (const reference::Strand& strand : reference::simulate(input, frames)) {
      output.tips.emplace_back(strand.tip);
      output.velocities.emplace_back(strand.velocity);
    }
  }
  output.mask = reference_mask(input, frames);
  return output;
}

FrameOutput reference_output(const FrameInput& input, int frames, bool eight_bit) {
  FrameOutput output = reference_motion(input, frames);
  if (eight_bit) output.pipeline += ", 8 bits";
  reference::Options options;
  options.frames = frames;
  options.eight_bit = eight_bit;
  if (has_springs(input.scene.dynamics)) options.sticks.assign(output.tips.begin(), output.tips.end());
  const std::shared_ptr<const FrameInput> shared(std::shared_ptr<void>(), &input);  // does not own the input
  output.image = reference::render(*with_skin(shared, frames - 1), options);
  return output;
}

}  // namespace pelage
