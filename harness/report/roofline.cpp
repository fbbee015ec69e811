#include "harness/report/roofline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/table/render.hpp"

namespace pelage {
namespace {

double intensity_of(const KernelWork& k) {
  return k.bytes > 0 ? k.operations / k.bytes : 0;
}

/// Returns the rate of `count` operations or bytes in `ms` milliseconds, in units of 1e9 per second.
double per_second(double count, double ms) {
  return ms > 0 ? count / ms * 1e-6 : 0;
}

/// Returns the kernel's rate of operations divided by allowed_gflop_s().
double share_of_roof(const KernelWork& k, const Ceilings& ceilings) {
  const double roof = allowed_gflop_s(ceilings, intensity_of(k));
  return roof > 0 ? per_second(k.operations, k.ms) / roof : 0;
}

/// Returns the name of the kernel, with its phase if another phase of the frame has the same kernel.
std::string name_of(const FrameWork& frame, const KernelWork& kernel) {
  const auto same = std::count_if(frame.kernels.begin(), frame.kernels.end(),
                                  [&](const KernelWork& k) { return k.kernel == kernel.kernel; });
  return same > 1 ? fmt::format("{}, {}", kernel.kernel, kernel.phase) : kernel.kernel;
}

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

}  // namespace

double allowed_gflop_s(const Ceilings& ceilings, double intensity) {
  return std::min(ceilings.gflop_s, intensity * ceilings.gb_s);
}

std::string text_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings) {
  std::string text = fmt::format("{}: {:.1f} GB/s (triad), {:.1f} GFLOP/s (fma)\n\n", ceilings.device,
                                 ceilings.gb_s, ceilings.gflop_s);
  text += fmt::format("{:<24} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", "case", "triangles", "frame ms",
                      "covered M", "shaded M", "blended M", "ns / shaded");
  for (const FrameWork& f : frames)
    text += fmt::format("{:<24} {:>9} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>11.1f}\n", f.name, f.triangles,
                        f.frame_ms, f.covered * 1e-6, f.shaded * 1e-6, f.blended * 1e-6,
                        f.shaded > 0 ? f.frame_ms * 1e6 / f.shaded : 0);
  for (const FrameWork& f : frames) {
    text += fmt::format("\n{:<24} {:>9} {:>7} {:>9} {:>8} {:>8} {:>9} {:>9} {:>8}\n", f.name, "ms", "of time",
                        "MB", "GB/s", "MFLOP", "FLOP/byte", "GFLOP/s", "of roof");
    for (const KernelWork& k : f.kernels) {
      text += fmt::format("  {:<22} {:>9.3f} {:>6.1f}% {:>9.2f} {:>8.2f}", name_of(f, k), k.ms,
                          100 * k.ms / f.frame_ms, k.bytes * 1e-6, per_second(k.bytes, k.ms));
      if (k.operations > 0)
        text += fmt::format(" {:>8.1f} {:>9.2f} {:>9.2f} {:>7.1f}%", k.operations * 1e-6, intensity_of(k),
                            per_second(k.operations, k.ms), 100 * share_of_roof(k, ceilings));
      text += "\n";
    }
    double sum = 0;
    for (const KernelWork& k : f.kernels) sum += k.ms;
    text += fmt::format("  {:<22} {:>9.3f} {:>6.1f}%\n", "between kernels", std::max(0.0, f.frame_ms - sum),
                        std::max(0.0, 100 * (1 - sum / f.frame_ms)));
  }
  return text;
}

std::string csv_of(const std::vector<FrameWork>& frames, const Ceilings& ceilings) {
  std::string text = csv_line({"device", "peak_gb_s", "peak_gflop_s", "case", "triangles", "frame_ms",
                               "covered", "shaded", "blended", "kernel", "phase", "ms", "bytes", "operations",
                               "gb_s", "gflop_s", "operations_per_byte", "share_of_roof"});
  for (const FrameWork& f : frames)
    for (const KernelWork& k : f.kernels)
      text += csv_line({ceilings.device, number(ceilings.gb_s), number(ceilings.gflop_s), f.name,
                        number(f.triangles), number(f.frame_ms), fmt::format("{:.0f}", f.covered),
                        fmt::format("{:.0f}", f.shaded), fmt::format("{:.0f}", f.blended), k.kernel, k.phase,
                        number(k.ms), fmt::format("{:.0f}", k.bytes), fmt::format("{:.0f}", k.operations),
                        number(per_second(k.bytes, k.ms)), number(per_second(k.operations, k.ms)),
                        number(intensity_of(k)), number(share_of_roof(k, ceilings))});
  return text;
}

}  // namespace pelage
