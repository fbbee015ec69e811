// The backends that draw fur as single strands, and what `pelage check` does with them.
#pragma once
#include "harness/compare/strands.hpp"
#include "harness/strands/raycast/raycast.hpp"
#include "harness/system/system.hpp"

namespace pelage::strands {

std::unique_ptr<Backend> open_opencl(const BackendOptions& options, const Scene& scene);
std::unique_ptr<Backend> open_raycast(const BackendOptions& options, const Scene& scene);
std::unique_ptr<Backend> open_opengl(const BackendOptions& options, const Scene& scene);

/// Writes the arrays of a picture.
void dump(Hdf5File& file, StrandInput input, const Scene& scene, const StrandFrame& frame);

/// Draws the present fur with a backend of open_opencl(), and returns its key strands.
std::vector<KeyStrand> keys_of(Backend& device);
/// Makes a backend of open_opengl() draw these key strands, which otherwise the reference simulates.
void show_keys(Backend& opengl, std::vector<KeyStrand> keys);

inline constexpr RaycastOptions rays{.cones = 12, .samples = 4};

/// Ray-casts the strands at rest that a picture of all strands shows, as cones, above the skin if the input
/// has one. The light of the picture is that of the strands, without the opacity map. Uses all cores. Throws
/// InputError if the mesh deforms.
RaycastResult raycast_strands(const StrandInput& input);

/// Throws InputError if the mesh deforms, because a ray-cast picture shows the strands at rest.
void refuse_frames(const Mesh& mesh);

std::vector<StageCheck> check(const CheckRequest& request);
void hash(const CheckRequest& request,
          const std::function<void(const std::string&, const std::string&)>& print);

}  // namespace pelage::strands
