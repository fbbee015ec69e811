// How the device draws the scenes on which it is held against the reference.
#pragma once
#include <memory>
#include <string>

#include "harness/shells/opencl/shells.hpp"
#include "tests/support/pictures.hpp"

namespace pelage::pictures {

/// The device of $PELAGE_DEVICE, else the first usable one.
cl::Device device();

Picture drawn_by_device(const std::shared_ptr<const FrameInput>& input, const std::string& mapping);

}  // namespace pelage::pictures
