// All tolerances by which a result is accepted, each with its unit and its reason. Commands, the checks of
// rows, tuning and tests use these constants. A test in tests/house fails if another file defines a
// tolerance.
#pragma once

namespace pelage::tolerance {

// Tolerances of pictures. Channels are 0..1, and only fur pixels count (harness/compare/metrics.hpp).

/// Least PSNR against the reference, dB. Rounding to floats gives 70 dB or more on the test scenes. Every
/// planted error of reference::Mutant gives less than 60 dB.
inline constexpr double picture_psnr = 60.0;
/// A pixel is flipped if one of its channels differs by more than this: two steps of an 8-bit display.
/// Rounding alone changes a channel by less than one step. A larger difference means that the pixel sampled
/// another texel or is covered by another triangle.
inline constexpr double flip = 2.0 / 255.0;
/// Largest share of flipped pixels among the fur pixels. The texel of the wetness mask and the coverage by a
/// triangle are decided by comparisons, and rounding changes the result at borders. About 1 pixel in 10^4 is
/// affected.
inline constexpr double flip_share = 1e-3;
/// Least PSNR of the OpenGL baseline against the reference, dB. OpenGL drivers filter textures with different
/// arithmetic, so p99.9 and flips of the baseline are not checked.
inline constexpr double other_filter_psnr = 55.0;
/// Largest difference of a channel between two mappings on one device. Mappings
/// add the same terms in different orders. The limit is one step of an 8-bit display.
inline constexpr double mapping_difference = 1.0 / 255.0;
/// Largest difference of a channel in pictures that have too few pixels for a percentile (1 x 1 and more).
inline constexpr double few_pixels_difference = 4.0 / 255.0;

// Tolerances of the tips of Silva's strands, as fractions of the strand's length.

/// Limit for every tip. S Eq. 3 keeps a tip inside a ball. In floats a tip may reach the surface of the ball
/// one substep earlier than in doubles and then loses its outward speed. This happens to a few of 10^5
/// strands. It moves the tip by less than a hundredth of a pixel in the pictures of the check.
inline constexpr double worst_tip = 1e-3;
/// Limit for 99.9% of the tips.
inline constexpr double usual_tip = 1e-5;

/// Limit for every value of a texel of the wetness mask, in UV units and in units of wetness. Adjacent texels
/// of the default mask are 4e-3 apart.
inline constexpr double mask_texel = 1e-5;

// Tolerances of the top masses of mass-spring topologies, as fractions of the fur's length.

/// Limit for every top mass of sticks and of separable topologies, device against reference.
inline constexpr double stick_top = 1e-4;
/// Limits for the root mean square and the 99th percentile on shared prisms. Compressed springs buckle in a
/// direction that depends on the last bit, so single top masses are not checked.
inline constexpr double prisms_rms = 1e-3, prisms_p99 = 1e-2;
/// Limit for the kernels' source compiled in double precision, against the reference. Gravity, wind
/// and normals are stored as floats even there.
inline constexpr double float_records = 1e-6;
/// Limit for baselines in double precision. Their states are transferred as floats.
inline constexpr double double_baseline = 2e-5;

/// Limit of the root mean square error of a run against an exact one. Beyond two lengths the run is
/// meaningless.
inline constexpr double lost_run = 2.0;
/// Limit for the reference, which uses the object's frame, against Newton's law in the world frame. Both are
/// computed in double precision by RK4, with different steps.
inline constexpr double reference_in_world = 1e-5;

/// Limit for every tip (R) and every mask texel (UV units) of the tests' small scenes, device against
/// reference. It allows for the rounding of some hundred substeps in floats.
inline constexpr double small_scene = 2e-6;
/// Limit for every tip's velocity (R/s) in the tests' small scenes: 2e-6 R over a substep of 1/240 s.
inline constexpr double velocity = 5e-4;

/// Limit of |b - A x| / |b|, where x is a step of backward Euler and A x = b are the reference's equations.
/// Velocities are floats some hundred times as large as their change in a step, so the rounding of their
/// difference alone gives 1e-5.
inline constexpr double step_residual = 1e-3;

}  // namespace pelage::tolerance
