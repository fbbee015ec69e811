// All tolerances that decide whether a result is accepted, each with its unit and its reason. Commands,
// experiments, tuning and tests use these constants. A test in tests/house fails if another file defines a
// tolerance.
#pragma once

namespace pelage::tolerance {

// Tolerances of pictures. Channel values range from 0 to 1, and only fur pixels are compared
// (harness/compare/metrics.hpp).

/// Smallest accepted PSNR of a picture against the reference's picture, in dB. If rounding to floats is the
/// only difference, the PSNR of the test scenes is 70 dB or more. Every deliberate error that
/// reference::Mutant lists lowers the PSNR below 60 dB.
inline constexpr double picture_psnr = 60.0;
/// A pixel is flipped if one of its channels differs from the reference by more than this value. The value is
/// two steps of an 8-bit display. Rounding alone changes a channel by less than one step. A larger difference
/// means that the pixel sampled another texel or is covered by another triangle.
inline constexpr double flip = 2.0 / 255.0;
/// Largest accepted share of flipped pixels (pixels that differ by more than `flip`) among the fur pixels.
/// Comparisons of floats decide which texel of the wetness mask a pixel samples and which triangles cover the
/// pixel. At the borders of texels and triangles, rounding can change these decisions. Rounding changes such
/// a decision in about 1 of 10^4 pixels.
inline constexpr double flip_share = 1e-3;
/// Largest accepted error of a fill light by its projection to spherical harmonics of degree 2 or less, as a
/// fraction of the light (docs/strands.md, section Light). The projection of the clamped cosine has an error
/// of 0.0938 of the light at the angle of 90 degrees.
inline constexpr double projected_fill = 0.1;
/// Smallest accepted PSNR of a picture of strands whose second segment lies on their first one, in dB.
/// Rounding alone gives 100 dB or more. If the segments are blended in another order, or rounding selects a
/// direction where a strand turns back, the PSNR is below 80 dB.
inline constexpr double folded_psnr = 90.0;
/// Largest accepted relative change of the mean coverage of a picture of strands if strands are left out
/// (docs/strands.md, section "Level of detail").
inline constexpr double kept_coverage = 0.01;
/// Greatest accepted mean error of the shadowed key light if strands.shadow is "exp" (docs/strands.md,
/// section Shadow), as a fraction of the unshadowed light. Tests compare it for three looks of dense fur on
/// the bunny.
inline constexpr double shadow_error = 0.1;
/// Smallest accepted PSNR of the OpenGL baseline against the reference, in dB. OpenGL drivers and the
/// reference filter textures with different arithmetic. Therefore the 99.9th percentile of the baseline's
/// errors and its share of flipped pixels are not checked.
inline constexpr double other_filter_psnr = 55.0;
/// Largest accepted difference of a channel between the pictures of two rasterizer mappings (tile, workgroup,
/// pixel) on one device. The mappings add the same terms in different orders, so their rounding errors
/// differ. The limit is one step of an 8-bit display.
inline constexpr double mapping_difference = 1.0 / 255.0;
/// Largest accepted difference of a channel from the reference in pictures that have too few pixels for a
/// percentile, such as 1 x 1.
inline constexpr double few_pixels_difference = 4.0 / 255.0;

// Tolerances of the tips of Silva's strands, as fractions of the strand's length.

/// Limit for the position error of every tip. Silva's Eq. 3 keeps a tip inside a ball. A tip that reaches the
/// surface of the ball loses its outward speed. Because of rounding, a tip may reach the surface one substep
/// earlier on the device than in the reference. This happens to a few of 10^5 strands. The resulting position
/// error is less than a hundredth of a pixel in the pictures of `pelage check`.
inline constexpr double worst_tip = 1e-3;
/// Limit for the 99.9th percentile of the position errors of all tips, as a fraction of the strand's length.
inline constexpr double usual_tip = 1e-5;

/// Limit for the error of each of the four values of a texel of the wetness mask. The clump's centre and
/// radius are in UV units. The fourth value, the wetness, has no unit. Adjacent texels of the default mask
/// are 4e-3 apart in UV.
inline constexpr double mask_texel = 1e-5;

// Tolerances of the top masses of mass-spring topologies, as fractions of the fur's length.

/// Limit for the distance between the positions of a top mass on the device and in the reference. It applies
/// to every top mass of the topologies "sticks", "separable-sticks" and "separable-prisms".
inline constexpr double stick_top = 1e-4;
/// Limits for the topology "prisms", whose adjacent prisms share their sticks. `prisms_rms` limits the root
/// mean square of the distances between the top masses on the device and in the reference. `prisms_p99`
/// limits the 99th percentile of these distances. Compressed springs buckle in a direction that depends on
/// rounding, so single top masses are not checked.
inline constexpr double prisms_rms = 1e-3, prisms_p99 = 1e-2;
/// Limit for tests that compile the kernels' source as C++ in double precision. It limits the distance of a
/// top mass from its position in the reference, and the relative residual of a backward Euler step. The
/// compiled source still reads gravity, wind and normals as floats.
inline constexpr double float_records = 1e-6;
/// Limit for the position error of a top mass in baselines that compute in double precision. The error comes
/// from rounding, because the positions and velocities are passed to the baselines and back as floats.
inline constexpr double double_baseline = 2e-5;

/// Limit for the root mean square error of a run, where the error is the distance of a top mass from the
/// exact solution. A run with a larger error fails its check, because errors above two fur lengths are
/// meaningless.
inline constexpr double lost_run = 2.0;
/// Limit for the distance of a top mass in the reference from its position in a test's computation. The
/// reference computes in the object's frame. The test computes from Newton's law in the world frame. Both
/// computations use double precision and RK4, with different time steps.
inline constexpr double reference_in_world = 1e-5;

/// Limit for the difference between device and reference in the tests' small scenes, for every tip (in R) and
/// every mask texel (in UV units). The limit allows for the rounding errors of some hundred substeps in
/// floats.
inline constexpr double small_scene = 2e-6;
/// Limit for the velocity error of every tip (in R/s) in the tests' small scenes. A velocity of 5e-4 R/s
/// moves a tip by about 2e-6 R in a substep of 1/240 s.
inline constexpr double velocity = 5e-4;

/// Limit of the relative residual |b - A x| / |b|, where A x = b are the reference's equations of a backward
/// Euler step and x is the device's change of the velocities. The velocities are floats. A velocity is
/// some hundred times as large as its change in a step. The rounding error of the velocity is therefore about
/// 1e-5 of the change, and this error alone gives a residual of 1e-5.
inline constexpr double step_residual = 1e-3;

/// Limits for strands that are simulated as chains of two segments (docs/strands.md). They allow only for the
/// rounding of single-precision numbers. `chain_stop` limits the violation of a stop, that is, of a bound on
/// the cosine of an angle or on a height in strand lengths. `chain_length` limits the deviation of a
/// segment's direction vector from the length 1. `chain_energy_rise` limits the rise of the energy in a step
/// without wind and without motion of the object. Its unit is m L^2 (k1 + g / L), where m is the strand's
/// mass, L its length, k1 the stiffness at the root in 1/s^2 and g the gravitational acceleration.
inline constexpr double chain_stop = 1e-6, chain_length = 1e-6, chain_energy_rise = 1e-6;
/// Limits for the errors of one time step of a chain on the device. The reference computes the same step from
/// the same state. 99.9% of the compared steps must be within the limits. `chain_direction` limits the
/// distance between the two direction vectors of a segment. `chain_rate` limits the distance between the two
/// rates (time derivatives of the directions). Its unit is the square root of k1 + g / L. The rates of a
/// strand that comes to rest at a stop follow from a small difference of energies. Single precision rounds
/// these energies with a relative error of 6e-8, so the rates have an error of about the square root of this
/// number, 2.4e-4.
inline constexpr double chain_direction = 1e-6, chain_rate = 3e-4;
/// Limit for the relative error of a soft strand's oscillation frequency, with time steps of 1/240 s.
inline constexpr double chain_frequency = 0.02;

/// Limits for the distance between a control point of a drawn strand on the device and in the reference, in
/// R. `strand_point` allows for rounding. `styled_strand_point` applies to strands with twist or curvature,
/// whose angles have 16 bits on the device. Where the raising of a tip onto the skin magnifies the errors of
/// these angles by a factor f above 8 (reference::between()), the distance is divided by f/8.
inline constexpr double strand_point = 2e-6, styled_strand_point = 3e-5;

/// Limit for the distance, in R, between a point of a groom and the same point after it was written, placed
/// on the mesh and written again, each time in single precision.
inline constexpr float groom_point = 5e-7f;
/// Least PSNR between pictures of grown strands and of a file with the control points of these strands. The
/// chains of both have different lengths, so strands at nearly equal depths may change places in the order.
inline constexpr double same_groom_psnr = 40.0;

}  // namespace pelage::tolerance
