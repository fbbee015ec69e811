#include "tests/shells/opencl/picture_scenes.hpp"

namespace pelage::pictures {

cl::Device device() {
  return cl::choose_device("");
}

Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping) {
  ShellOptions options;
  options.mapping = mapping;
  Shells shells(device(), input, options);
  shells.advance(frames - 1);
  shells.frame();
  return shells.read();
}

}  // namespace pelage::pictures
