// GLSL programs, and their inputs from the scene: constants, "#define" lines and the layer table.
#pragma once
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "harness/gl/objects.hpp"
#include "harness/gl/program.hpp"
#include "harness/prepare/frame_input.hpp"
#include "harness/shells/opengl/opengl.hpp"

namespace pelage::rivals {

/// A constant of the scene that the shaders read: 1 to 4 floats.
struct Constant {
  std::string name;
  std::vector<float> value;
};

std::vector<Constant> scene_constants(const FrameInput& input);

/// Returns the "#define" lines that select the parts of the shaders to compile. `wet` is true if any texel of
/// the mask is wet.
std::string scene_defines(const FrameInput& input, const OpenGlOptions& options, bool wet);

/// Returns three vectors per layer, which shaders/layers.glsl calls "bend", "step" and "look". The shaders
/// compute the positions of the vertices from "bend", the strand direction from "step", and the displacement
/// by clumps and the self-shadow from "look". shaders/layers.glsl describes the components of the vectors.
std::vector<glm::vec4> layer_table(const Scene& scene);

/// Returns the program of the files `vertex` and `fragment` of the shader folder. Both shaders get `defines`
/// and `constants`, whose values are literals. Throws DeviceError with OpenGL's log if OpenGL cannot compile
/// or link the shaders.
gl::Program scene_program(const std::string& vertex, const std::string& fragment, const std::string& defines,
                          const std::vector<Constant>& constants);

/// Returns the "#define" lines of the scene's colliders; "" without colliders.
std::string contact_defines(const FrameInput& input);

/// Returns the distance field of the mesh among the colliders as a 3D texture; one texel without a mesh.
gl::Object field_texture(const FrameInput& input);

/// Sets the uniforms of shaders/contact.glsl in `program` to the colliders at `time`, in s since the start of
/// the simulation.
void set_colliders(GLuint program, const FrameInput& input, double time);

}  // namespace pelage::rivals
