#include "tests/shells/opencl/picture_scenes.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace pelage::pictures {

cl::Device device() {
  static const cl::Device shared = cl::choose_device("");  // keeps the programs that the tests have built
  return shared;
}

Picture drawn_with(const std::shared_ptr<const FrameInput>& input, const ShellOptions& options) {
  Shells shells(device(), input, options);
  shells.advance(frames - 1);
  shells.frame();
  return shells.read();
}

Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping) {
  return drawn_with(input, {mapping, {}});
}

testing::AssertionResult drawn_alike(const std::shared_ptr<const FrameInput>& input,
                                     const std::string& mapping, std::size_t least_pixels) {
  return same(drawn_by_reference(*input), drawn_by_device(input, mapping), least_pixels);
}

Change change(const Picture& a, const Picture& b) {
  Change c;
  for (std::size_t i = 0; i < a.pixel.size(); ++i) {
    const glm::vec3 d = glm::abs(glm::vec3(a.pixel[i]) - glm::vec3(b.pixel[i]));
    c.mean += double(d.x + d.y + d.z) / 3;
    c.most = std::max({c.most, double(d.x), double(d.y), double(d.z)});
  }
  c.mean /= double(a.pixel.size());
  return c;
}

}  // namespace pelage::pictures
