// The stages of a frame as contenders of a tuning search.
#pragma once
#include "harness/cl/device.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/tuning/tuning_search.hpp"

namespace pelage {

/// The scene for the stage of that name on `device`: rasterize (a whole frame, by the wall clock), simulate
/// (a frame's strand step) or wet (Algorithm 1). Throws InputError for another stage.
TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         const std::shared_ptr<const FrameInput>& input);

}  // namespace pelage
