#include "harness/system/backend_parts.hpp"

#include <chrono>

#include "harness/shells/opengl/opengl.hpp"

namespace pelage {

cl::FrameTiming wall_time_of(const std::function<void()>& work) {
  const auto from = std::chrono::steady_clock::now();
  work();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count(), {}, {}};
}

void add_agreement(Description& row, const Agreement& agreement) {
  row.metrics["worst_difference"] = {agreement.worst, "1"};
  row.metrics["flips"] = {double(agreement.flips), "pixels"};
  row.metrics["psnr_without_flips"] = {agreement.psnr_without_flips, "dB"};
}

std::string present_renderer() {
  try {
    return opengl_renderer();
  } catch (const InputError& error) {
    throw CannotDraw(error.what());
  }
}

}  // namespace pelage
