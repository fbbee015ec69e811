// The shell pipeline as a subject of the harness.
#pragma once
#include <map>
#include <string>

#include "harness/cl/device.hpp"
#include "harness/picture/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/results/subject.hpp"

namespace pelage {

/// Windows of the check: at least this many, each side x side pixels, over fur.
inline constexpr std::size_t kCheckWindows = 64;
inline constexpr int kCheckSide = 16;

/// Makes cases of `experiment` on `device`. Meshes stay in memory from case to case. `tuning` is passed on to
/// the kernels; `progress` is told what takes long.
MakeSubject shells_on(const cl::Device& device, const Experiment& experiment,
                      const std::map<std::string, int>& tuning,
                      const std::function<void(const std::string&)>& progress);

/// Hash of every file under kernels/: which text was compiled.
std::string kernel_hash();

/// The timed picture compared with the double-precision reference in kCheckWindows seeded windows over fur
/// pixels; where these fall short, in the whole picture, which decides.
struct WindowCheck {
  std::vector<Check> checks;
  Agreement agreement;  ///< what decided
  Agreement sample;     ///< in the windows
};
/// `sticks`: those of the timed frame, where a topology moves the fur.
WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks = {});

/// Share of the picture's rows that hold fur, 0..1.
double model_height(const Picture& picture);

/// Share of the mesh's area whose mask texel is wet, 0..1. `mask` is side x side texels (c_u, c_v, r, rho).
double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side);

}  // namespace pelage
