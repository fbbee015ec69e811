// Places the strands of a file on the mesh of a scene.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "harness/mesh/mesh.hpp"
#include "harness/mesh/read/polylines.hpp"
#include "harness/scene/scene.hpp"

namespace pelage {

/// Reads scene.strands.file. Throws InputError if it is not usable.
Polylines read_strands(const Scene& scene);

/// Returns the mesh with the strands `lines` of the file scene.strands.file (docs/grooms.md, section
/// "Placement"). `mesh` is that of scene.model; it is null if the model is `no_model`: the result then has no
/// triangles, and R is the radius of the strands' bounding sphere. The notes of the result say what was
/// changed; `progress` receives them. Throws InputError if the strands are not on the mesh.
std::shared_ptr<const Mesh> with_strands(const Scene& scene, Polylines lines,
                                         const std::shared_ptr<const Mesh>& mesh,
                                         const std::function<void(const std::string&)>& progress);

}  // namespace pelage
