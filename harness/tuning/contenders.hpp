// Makes contenders of a tuning search from the stages of a frame.
#pragma once
#include "harness/cl/device.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/tuning/tuning_search.hpp"

namespace pelage {

/// Returns a tuning scene called `name`, whose contenders run on `device`. For the stage "rasterize", a
/// contender times whole frames, for "simulate" the strand simulation of a frame, and for "wet" the
/// computation of the wetness mask. Throws InputError for other stages.
TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         const std::shared_ptr<const FrameInput>& input);

}  // namespace pelage
