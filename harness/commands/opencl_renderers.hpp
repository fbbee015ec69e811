// The OpenCL pipelines of `pelage render` and `pelage animate`. They continue the simulation from one picture
// to the next where the pictures stay the same bit for bit.
#pragma once
#include <memory>

#include "harness/commands/renderers.hpp"

namespace pelage {

std::unique_ptr<SceneRenderer> open_shells(const RendererOptions& options, const Scene& scene);
std::unique_ptr<SceneRenderer> open_strands(const RendererOptions& options, const Scene& scene);

}  // namespace pelage
