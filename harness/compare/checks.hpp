// The checks of pictures, wetness masks, strand tips and top masses against the double-precision reference,
// and of pictures against other pictures. A timed picture is compared in windows (squares of pixels).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/record/check.hpp"
#include "harness/springs/model/network.hpp"

namespace pelage {

/// Returns four checks of the difference between two pictures: the number of fur pixels (at least one), the
/// PSNR, the 99.9th percentile of the pixel differences, and the share of flipped pixels (see
/// tolerance::flip). within() tests the same conditions.
std::vector<Check> picture_checks(const std::string& against, const Agreement& agreement);

/// Returns the checks of the OpenGL baseline's picture: the number of fur pixels (at least one), and psnr (at
/// least tolerance::other_filter_psnr).
std::vector<Check> other_filter_checks(const std::string& against, const Agreement& agreement);

/// Returns the checks of two pictures that different mappings drew on one device: the same
/// pixels must be covered in both pictures, and no channel may differ by more than
/// tolerance::mapping_difference. Throws InputError if the sizes differ.
std::vector<Check> mapping_checks(const std::string& against, const Picture& ours, const Picture& other);

/// Compares two masks. A texel holds the centre (c_u, c_v) and the radius r of a clump of wet hairs, and the
/// wetness rho. The texel is wet if rho is above 0. The first check counts the texels that are wet in only
/// one mask (limit 0). The second check limits the largest error of a value in all other texels (limit
/// tolerance::mask_texel). An error that is not finite counts as 10^6. Throws std::invalid_argument if the
/// sizes differ.
std::vector<Check> check_mask(const std::vector<glm::vec4>& ours, const std::vector<glm::vec4>& reference);

/// Distances between the positions of tips, or of the top masses of sticks, in two states, as fractions of
/// the length of strands or of the fur.
struct Spread {
  double rms = 0, percentile_99 = 0, p999 = 0, worst = 0;  ///< p999: the 99.9th percentile
};
/// Compares two lists of tips (positions relative to the roots, in R). `length` is the length of a strand in
/// R. A distance that is not finite counts as 10^6. Throws std::invalid_argument if the sizes differ or are
/// 0.
Spread tip_errors(double length, const std::vector<glm::vec3>& ours, const std::vector<glm::vec3>& reference);

/// Checks Spread::worst against tolerance::worst_tip.
Check check_worst_tip(const Spread& errors);

/// Checks Spread::p999 against tolerance::usual_tip.
Check check_usual_tip(const Spread& errors);

/// Approximate number of sticks that are compared. With the topology "prisms" (adjacent prisms share their
/// sticks), all sticks are compared.
inline constexpr std::size_t kCheckSticks = 6000;

/// Compares the device's sticks after `frames` frames with the reference's sticks, and returns the checks.
/// `offsets` contains the position of each stick's top mass minus the position of the stick's base, in units
/// of R (the mesh radius). Errors are fractions of the fur's length. With the topology "prisms" (adjacent
/// prisms share their sticks), the rms error must be at most tolerance::prisms_rms, and the 99th percentile
/// of the errors must be at most tolerance::prisms_p99. With all other topologies, the largest error must be
/// at most tolerance::stick_top.
std::vector<Check> check_sticks(const FrameInput& input, int frames, const std::vector<glm::vec3>& offsets);

}  // namespace pelage

namespace pelage::springs {

/// Compares the positions `a` and `b` of the top masses, one per stick. `length` is the fur's length in the
/// unit of the positions. A distance counts as 1e9 if it is not finite or if it is above 1e9. Throws
/// std::invalid_argument if the sizes differ or are 0.
Spread spread(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, double length);

/// Returns checks that compare the distances in `found` with their limits. For shared prisms (adjacent prisms
/// share their sticks), the limit of the rms distance is tolerance::prisms_rms, and the limit of the 99th
/// percentile is tolerance::prisms_p99. For all other topologies, the limit of the largest distance is
/// tolerance::stick_top. `against` names the trusted state, for example "reference".
std::vector<Check> agreement_checks(Kind kind, const std::string& against, const Spread& found);

}  // namespace pelage::springs

namespace pelage {

/// Number of windows required by the check, and the side of a window in pixels. The windows are cells of a
/// grid over the picture. Every window contains fur or is adjacent to a cell that contains fur.
inline constexpr std::size_t kCheckWindows = 64;
inline constexpr int kCheckSide = 16;

/// Value of Check::metric in the check that counts the windows. The number of windows must be at least
/// kCheckWindows.
inline constexpr const char* windows_metric = "windows";

/// Returns the advice that the user gets if the check finds fewer than kCheckWindows windows.
std::string window_advice();

/// Comparison of the timed picture with the double-precision reference in kCheckWindows windows. If the
/// difference in these windows is too large, the whole picture is compared, and only this comparison decides.
struct WindowCheck {
  std::vector<Check> checks;
  Agreement agreement;  ///< the comparison on which `checks` are based: the windows or the whole picture
  Agreement sample;     ///< the comparison of the windows
  Check windows;        ///< the check of the number of windows; checks[0] is the same check
};

/// Compares `timed`, the picture of the pipeline after `frames` frames, with the reference. `seed` selects
/// the windows. For a mass-spring topology, `sticks` contains the offset of each stick's top mass from the
/// stick's base in the timed frame, in R (the mesh radius). For Silva's strands, `sticks` is empty.
WindowCheck check_against_reference(const FrameInput& input, int frames, const Picture& timed,
                                    std::uint32_t seed, const std::vector<glm::vec3>& sticks = {});

}  // namespace pelage
