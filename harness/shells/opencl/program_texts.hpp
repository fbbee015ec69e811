// The OpenCL programs that simulate and draw shells. The classes of this folder build the programs of these
// texts.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"
#include "harness/scene/scene.hpp"
#include "harness/shells/opencl/shells.hpp"

namespace pelage::shells {

/// Values of tuning axes by name. A tuning axis is a parameter of the kernels, or of their launches, that
/// affects only the speed. The files kernels/*/tuning.toml list the axes. An axis that is not in the
/// map keeps its default value.
using Tuning = std::map<std::string, int>;

/// Returns the value of `axis` in `tuning`, or `otherwise` if `tuning` does not contain the axis.
int tuned(const Tuning& tuning, const std::string& axis, int otherwise);

/// Returns the build options of an OpenCL program: "-D LANES=lanes", and one "-D NAME=value" per tuning axis.
/// The axes that no kernel of the program reads are left out when it is built (options_read(), harness/cl).
std::string build_options(int lanes, const Tuning& tuning);

/// Returns the build options that make the rasterizer's kernels read the scene's maps and colliders: "" if
/// there are none.
std::string style_options(const Scene& scene);

/// The program that computes the vertices of a frame and the lists of the tiles. `lanes` and `tuning` are
/// those of the mapping.
cl::ProgramText geometry_text(const Scene& scene, int lanes, const Tuning& tuning);
/// The program that computes the wetness mask.
cl::ProgramText mask_text();
/// The program that computes what depends on the wetness mask.
cl::ProgramText wet_text(const Scene& scene, int lanes);
/// The program that simulates the strands of Silva et al. 2010.
cl::ProgramText simulate_text(const Scene& scene, int lanes);
/// The program that computes the tips from the sticks of a mass-spring topology.
cl::ProgramText sticks_text(int lanes);

/// Returns the programs that Shells will need for this scene, in the order of their first use, except that of
/// a mass-spring topology, which depends on the mesh. Throws InputError if an option is not valid.
std::vector<cl::ProgramText> expected_programs(const cl::Device& device, const Scene& scene,
                                               const ShellOptions& options);

}  // namespace pelage::shells
