#include <fmt/format.h>

#include <algorithm>

#include "harness/error.hpp"
#include "harness/mesh/cache.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/models.hpp"
#include "harness/mesh/procedural.hpp"

namespace pelage {

std::shared_ptr<const Mesh> load_model(const std::string& name_or_file, const MeshOptions&) {
  const std::vector<Model> known = models();
  const auto model =
      std::find_if(known.begin(), known.end(), [&](const Model& m) { return m.name == name_or_file; });
  if (model == known.end()) throw InputError(fmt::format("{}: no such model", name_or_file));
  Surface surface;
  if (model->source == "procedural:torus")
    surface = make_torus(72, 65, 0.4);
  else if (model->source == "procedural:square-2")
    surface = make_square(2);
  else if (model->source == "procedural:square-24")
    surface = make_square(24);
  else
    throw InputError(fmt::format("{}: not to be had yet", name_or_file));
  return std::make_shared<Mesh>(finish(surface, model->name, model->rotation));
}

}  // namespace pelage
