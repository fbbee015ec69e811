#include "harness/report/profile.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/table/render.hpp"

namespace pelage {
namespace {

double gb_per_second(const KernelWork& k) {
  return k.ms > 0 ? k.bytes / k.ms * 1e-6 : 0;
}

/// Returns the name of the kernel, with its phase if another phase of the frame has the same kernel.
std::string kernel_name(const FrameWork& frame, const KernelWork& kernel) {
  const auto same = std::ranges::count(frame.kernels, kernel.kernel, &KernelWork::kernel);
  return same > 1 ? fmt::format("{}, {}", kernel.kernel, kernel.phase) : kernel.kernel;
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

}  // namespace

std::string text_of(const std::vector<FrameWork>& frames, const Bandwidth& bandwidth) {
  std::string text = fmt::format("{}: {:.1f} GB/s (triad)\n\n", bandwidth.device, bandwidth.gb_s);
  text += fmt::format("{:<24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "case", "triangles", "frame ms",
                      "covered M", "shaded M", "blended M", "ns / shaded");
  for (const FrameWork& f : frames)
    text += fmt::format("{:<24} {:>9} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>11.1f}\n", f.name, f.triangles,
                        f.frame_ms, f.covered * 1e-6, f.shaded * 1e-6, f.blended * 1e-6,
                        f.shaded > 0 ? f.frame_ms * 1e6 / f.shaded : 0);
  for (const FrameWork& f : frames) {
    text += fmt::format("\n{:<24} {:>9} {:>7} {:>9} {:>8} {:>8}\n", f.name, "ms", "of time", "MB", "GB/s",
                        "of triad");
    double sum = 0;
    for (const KernelWork& k : f.kernels) {
      text += fmt::format("  {:<22} {:>9.3f} {:>6.1f}% {:>9.2f} {:>8.2f} {:>7.1f}%\n", kernel_name(f, k),
                          k.ms, 100 * k.ms / f.frame_ms, k.bytes * 1e-6, gb_per_second(k),
                          100 * gb_per_second(k) / bandwidth.gb_s);
      sum += k.ms;
    }
    text += fmt::format("  {:<22} {:>9.3f} {:>6.1f}%\n", "between kernels", std::max(0.0, f.frame_ms - sum),
                        std::max(0.0, 100 * (1 - sum / f.frame_ms)));
  }
  return text;
}

std::string csv_of(const std::vector<FrameWork>& frames, const Bandwidth& bandwidth) {
  std::string text = csv_line({"device", "peak_gb_s", "case", "triangles", "frame_ms", "covered", "shaded",
                               "blended", "kernel", "phase", "ms", "bytes", "gb_s"});
  for (const FrameWork& f : frames)
    for (const KernelWork& k : f.kernels)
      text += csv_line({bandwidth.device, number(bandwidth.gb_s), f.name, number(f.triangles),
                        number(f.frame_ms), fmt::format("{:.0f}", f.covered), fmt::format("{:.0f}", f.shaded),
                        fmt::format("{:.0f}", f.blended), k.kernel, k.phase, number(k.ms),
                        fmt::format("{:.0f}", k.bytes), number(gb_per_second(k))});
  return text;
}

}  // namespace pelage
