// The GLSL programs of the OpenGL baseline of strands (shaders/strands).
#pragma once
#include "harness/gl/program.hpp"
#include "harness/strands/drawing/drawing.hpp"

namespace pelage::strands {

/// The program that draws the strips of a picture. `instanced`: each strand is an instance of a triangle
/// strip.
gl::Program strand_program(const DrawingScene& scene, bool instanced);

/// The program that draws the strips of the opacity map.
gl::Program map_program(const DrawingScene& scene, bool instanced);

/// The program that draws the skin.
gl::Program skin_program(const DrawingScene& scene);

}  // namespace pelage::strands
