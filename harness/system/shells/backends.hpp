// The backends that draw fur as shells, and what `pelage check` does with them.
#pragma once
#include "harness/compare/frame_output.hpp"
#include "harness/system/system.hpp"

namespace pelage::shells {

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene);
std::unique_ptr<Backend> open_opengl(const BackendOptions& options, const Scene& scene);

/// Writes the arrays of a frame. `output` has its tips, velocities and mask.
void dump(Hdf5File& file, FrameInput input, const Scene& scene, const FrameOutput& output);

std::vector<StageCheck> check(const CheckRequest& request);
void hash(const CheckRequest& request,
          const std::function<void(const std::string&, const std::string&)>& print);

}  // namespace pelage::shells
