// All tolerances that decide whether a result is accepted, each with its unit and its reason. Commands,
// experiments, tuning and tests use these constants. A test in tests/house fails if another file defines a
// tolerance.
#pragma once

namespace pelage::tolerance {

// Tolerances of pictures. Channels are 0..1, and only fur pixels count (harness/compare/metrics.hpp).

/// Smallest accepted PSNR against the reference, in dB. With rounding to floats as the only difference, the
/// test scenes reach 70 dB or more. Every deliberate error of reference::Mutant gives less than 60 dB.
inline constexpr double picture_psnr = 60.0;
/// A pixel is flipped if one of its channels differs by more than this: two steps of an 8-bit display.
/// Rounding alone changes a channel by less than one step. A larger difference means that the pixel sampled
/// another texel or is covered by another triangle.
inline constexpr double flip = 2.0 / 255.0;
/// Largest accepted share of flipped pixels (pixels that differ by more than `flip`) among the fur pixels.
/// Comparisons of floats decide which texel of the wetness mask a pixel samples and which triangles cover the
/// pixel. At the borders of texels and triangles, rounding can change these decisions. This happens to about
/// 1 pixel in 10^4.
inline constexpr double flip_share = 1e-3;
/// Smallest accepted PSNR of the OpenGL baseline against the reference, in dB. OpenGL drivers filter textures
/// with different arithmetic. Therefore the 99.9th percentile of the baseline's errors and its share of
/// flipped pixels are not checked.
inline constexpr double other_filter_psnr = 55.0;
/// Largest accepted difference of a channel between the pictures of two rasterizer mappings (tile, workgroup,
/// pixel) on one device. Mappings add the same terms in different orders. The limit is one step of an 8-bit
/// display.
inline constexpr double mapping_difference = 1.0 / 255.0;
/// Largest accepted difference of a channel in pictures that have too few pixels for a percentile, such as 1
/// x 1.
inline constexpr double few_pixels_difference = 4.0 / 255.0;

// Tolerances of the tips of Silva's strands, as fractions of the strand's length.

/// Limit for the error of every tip. Silva's Eq. 3 keeps a tip inside a ball. Because of rounding,
/// a tip on the device may reach the surface of the ball one substep earlier than in the reference and then
/// loses its outward speed. This happens to a few of 10^5 strands. The error moves the tip by less than a
/// hundredth of a pixel in the pictures of the check.
inline constexpr double worst_tip = 1e-3;
/// Limit for the 99.9th percentile of the tip errors, as a fraction of the strand's length.
inline constexpr double usual_tip = 1e-5;

/// Limit for the error of every value of a texel of the wetness mask, in UV units and in units of wetness.
/// Adjacent texels of the default mask are 4e-3 apart in UV.
inline constexpr double mask_texel = 1e-5;

// Tolerances of the top masses of mass-spring topologies, as fractions of the fur's length.

/// Limit for the distance between the positions of a top mass on the device and in the reference. It applies
/// to every top mass of the topologies "sticks", "separable-sticks" and "separable-prisms".
inline constexpr double stick_top = 1e-4;
/// Limits for the root mean square and for the 99th percentile of these distances with the topology "prisms",
/// whose adjacent prisms share their sticks. Compressed springs buckle in a direction that depends on
/// rounding, so single top masses are not checked.
inline constexpr double prisms_rms = 1e-3, prisms_p99 = 1e-2;
/// Limit for the difference between two positions of a top mass. The reference computes one position. The
/// kernels' source, compiled as C++ in double precision, computes the second position. The compiled source
/// still reads gravity, wind and normals as floats.
inline constexpr double float_records = 1e-6;
/// Limit for the position error of a top mass in baselines that compute in double precision. The reason for
/// the error is rounding: the positions and velocities are passed to the baselines and back as floats.
inline constexpr double double_baseline = 2e-5;

/// Limit for the root mean square error of a run, where the error is the distance of a top mass from the
/// exact solution. A run with a larger error fails its check, because errors above two fur lengths are
/// meaningless.
inline constexpr double lost_run = 2.0;
/// Limit for the difference between two positions of a top mass. The reference computes one position in the
/// object's frame. A test computes the second position from Newton's law in the world frame. Both
/// computations use double precision and RK4, with different time steps.
inline constexpr double reference_in_world = 1e-5;

/// Limit for the difference between device and reference in the tests' small scenes, for every tip (in R) and
/// every mask texel (in UV units). The limit allows for the rounding errors of some hundred substeps in
/// floats.
inline constexpr double small_scene = 2e-6;
/// Limit for the velocity error of every tip (in R/s) in the tests' small scenes. It corresponds to 2e-6 R
/// per substep of 1/240 s.
inline constexpr double velocity = 5e-4;

/// Limit of the relative residual |b - A x| / |b|, where A x = b are the reference's equations of a backward
/// Euler step and x is the device's change of the velocities. The velocities are floats. A velocity is
/// some hundred times as large as its change in a step. The rounding error of the velocity is therefore about
/// 1e-5 of the change, and this error alone gives a residual of 1e-5.
inline constexpr double step_residual = 1e-3;

}  // namespace pelage::tolerance
