// Makes contenders (configurations of kernels that a tuning search times) from the stages of a frame.
#pragma once
#include "harness/cl/device.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/tuning/tuning_search.hpp"

namespace pelage {

/// Returns a tuning scene (a scene on which a search times configurations). Its contenders run one stage on
/// `device`: "rasterize" (wall time of a whole frame), "simulate" (the strand simulation of a frame) or "wet"
/// (the wetness mask). `name` is the name of the scene. Throws InputError for other stages.
TuningScene tuning_scene(const std::string& stage, const std::string& name, const cl::Device& device,
                         const std::shared_ptr<const FrameInput>& input);

}  // namespace pelage
