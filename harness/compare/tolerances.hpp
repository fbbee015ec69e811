// Every tolerance by which a result is accepted, with its unit and its reason. Commands, the checks of rows,
// tuning and tests use these constants; tests/house holds that no other file writes such a number.
#pragma once

namespace pelage::tolerance {

// Pictures. Channels are 0..1, and only fur pixels count (harness/compare/metrics.hpp).

/// dB, least PSNR against the reference. Rounding to floats leaves 70 dB and more on the test scenes; every
/// mistake of reference::Mutant leaves less than 60 dB.
inline constexpr double picture_psnr = 60.0;
/// A pixel is flipped when one of its channels differs by more: two steps of an 8-bit display. Rounding alone
/// changes a channel by less than one step; a larger difference means that the pixel looked up another texel
/// or that another triangle covers it.
inline constexpr double flip = 2.0 / 255.0;
/// Largest share of the fur pixels that may be flipped. A texel of the wetness mask and the edge of a
/// triangle are chosen by comparisons, which rounding decides on a border; about 1 pixel in 10^4 lies there.
inline constexpr double flip_share = 1e-3;
/// dB, least PSNR of the OpenGL baseline: its driver filters textures by its own arithmetic, so p99.9 and
/// flips are not asked of it.
inline constexpr double other_filter_psnr = 55.0;
/// Largest difference of a channel between two mappings on one device: they compute the same equations in
/// another order of additions. Less than one step of an 8-bit display.
inline constexpr double mapping_difference = 1.0 / 255.0;
/// Largest difference of a channel in pictures of too few pixels for a percentile, 1 x 1 and more.
inline constexpr double few_pixels_difference = 4.0 / 255.0;

// Tips of Silva's strands, as a fraction of the strand's length.

/// Every tip. A tip on the ball of Eq. 3 may reach the ball a substep earlier in floats than in doubles and
/// lose its outward speed then: a few of 10^5 strands do, by less than a hundredth of a pixel in the pictures
/// of the check.
inline constexpr double worst_tip = 1e-3;
/// 99.9% of the tips.
inline constexpr double usual_tip = 1e-5;

/// UV units and wetness, every value of a texel of the wetness mask. Texels of the default mask are 4e-3
/// apart.
inline constexpr double mask_texel = 1e-5;

// Tops of mass-spring topologies, as a fraction of the fur's length.

/// Every top of sticks and of separable topologies, device against reference.
inline constexpr double stick_top = 1e-4;
/// Shared prisms, root mean square and 99th percentile. Their compressed springs buckle one way or the other
/// by the last bit, so single tops are not held.
inline constexpr double prisms_rms = 1e-3, prisms_p99 = 1e-2;
/// The kernels' text computed in double against the reference: the records of weight, moments and normals are
/// floats.
inline constexpr double float_records = 1e-6;
/// Baselines in double, whose state is handed over as floats.
inline constexpr double double_baseline = 2e-5;

/// The root mean square error beyond which nothing is left of a run that is compared with an exact one: two
/// lengths.
inline constexpr double lost_run = 2.0;
/// The reference in the object's frame against Newton's law in the world, both in double by RK4 with other
/// steps.
inline constexpr double reference_in_world = 1e-5;

/// R and UV units, every tip and every texel of the tests' small scenes, device against reference: the
/// roundings of some hundred substeps in floats.
inline constexpr double small_scene = 2e-6;
/// R/s, every tip of the tests' small scenes: 2e-6 R over a substep of 1/240 s.
inline constexpr double velocity = 5e-4;

/// |b - A x| / |b| of a step of backward Euler, put into the reference's equations. Speeds are floats some
/// hundred times their change in a step: 1e-5 is lost in the difference alone.
inline constexpr double step_residual = 1e-3;

}  // namespace pelage::tolerance
