#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <optional>
#include <regex>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/mesh/archive.hpp"
#include "harness/mesh/cache.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/isolated.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/models.hpp"
#include "harness/mesh/procedural.hpp"
#include "harness/mesh/soup.hpp"
#include "harness/mesh/steps.hpp"
#include "harness/mesh/unfold.hpp"

namespace pelage {
namespace {

// Part of every cache file's name: raise it whenever the same source would give another mesh.
constexpr int recipe = 3;
constexpr int procedural_recipe = 3;  // the same for procedural shapes alone

constexpr std::uint32_t most_faces = 4'000'000;
constexpr int most_torus_faces = 8'000'000;  // it needs no preparation
const std::filesystem::path cgal_archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
const std::filesystem::path glmark2_folder = "/usr/share/glmark2/models";

struct Source {
  std::string kind,
      item;           ///< "procedural", "cgal", "glmark2" and what follows the colon; "file" and its path
  std::string label;  ///< how errors call it
  std::filesystem::path file() const {
    if (kind == "cgal") return cgal_archive;
    return kind == "glmark2" ? glmark2_folder / item : std::filesystem::path(item);
  }
};

Source source_of(const Model& model) {
  const std::size_t colon = model.source.find(':');
  const std::string kind = model.source.substr(0, colon);
  const std::string item = colon == std::string::npos ? "" : model.source.substr(colon + 1);
  return {kind, item, kind == "file" ? item : model.name};
}

// The direction in the source's own axes that `rotation` turns into +y.
glm::dvec3 up_before(glm::dvec3 rotation) {
  const glm::dmat3 matrix = rotation_matrix(rotation);
  return {matrix[0].y, matrix[1].y, matrix[2].y};
}

// "torus-AxB": the torus of A x B quads, however fine; empty for other names.
std::optional<glm::ivec2> finer_torus(const std::string& name) {
  std::smatch quads;
  if (!std::regex_match(name, quads, std::regex("torus-([0-9]{1,4})x([0-9]{1,4})"))) return {};
  const glm::ivec2 count{std::stoi(quads[1]), std::stoi(quads[2])};
  if (std::min(count.x, count.y) < 3 || 2 * count.x * count.y > most_torus_faces)
    throw InputError(
        fmt::format("{}: 3 quads or more each way, and {} faces in all at most", name, most_torus_faces));
  return count;
}

Surface shape_of(const Source& source, const MeshOptions& options) {
  if (source.kind == "procedural") {
    if (source.item == "torus") return make_torus(72, 65, 0.4);
    if (const auto quads = finer_torus(source.item)) return make_torus(quads->x, quads->y, 0.4);
    if (source.item == "pear") return make_pear(6);
    if (source.item.starts_with("square-"))
      return make_square(std::clamp(std::atoi(source.item.c_str() + 7), 1, 1000));
    throw InputError(fmt::format("{}: no procedural shape {}; there are torus, torus-AxB, pear and square-N",
                                 source.label, source.item));
  }
  Soup soup;
  if (source.kind == "cgal") {
    auto bytes = read_member(cgal_archive, "data/meshes/" + source.item);
    if (!bytes)
      throw InputError(fmt::format("{}: no data/meshes/{} in it", cgal_archive.string(), source.item));
    soup = parse_soup(std::move(*bytes), std::filesystem::path(source.item).extension().string().substr(1),
                      source.item);
  } else {
    soup = read_soup(source.file(), options.keep_uv);
  }
  if (options.keep_uv && !soup.uv.empty()) return weld(soup, source.label);
  if (soup.polygon.size() > most_faces)
    throw InputError(fmt::format("{}: {} faces; at most {} can be prepared", source.label,
                                 soup.polygon.size(), most_faces));
  return repair(soup, source.kind != "file", source.label);
}

// A coarse version of what `surface` will become, hole of an odd count included, for trying cuts on.
Surface proxy_of(const Surface& surface, const Model& model) {
  const std::uint32_t wanted = model.faces.value_or(std::uint32_t(surface.triangle.size()));
  const std::uint32_t coarse = 6000 + wanted % 2;
  if (wanted <= coarse && surface.triangle.size() == wanted) return surface;
  try {
    return with_faces(surface, std::min(wanted, coarse), up_before(model.rotation), model.name);
  } catch (const InputError&) {
    return surface;  // it cannot be made so coarse
  }
}

Mesh prepare(const Model& model, const Source& source, const MeshOptions& options, const Say& say) {
  Surface surface = shape_of(source, options);
  std::size_t told = 0;
  const auto tell = [&] {
    for (; told < surface.notes.size(); ++told) say(surface.notes[told]);
  };
  tell();
  if (surface.uv.empty()) {
    if (model.wrap) surface = wrap(surface);
    tell();
    const std::vector<CutPlan> plans = plan_cuts(proxy_of(surface, model), source.label);
    if (model.faces) surface = with_faces(surface, *model.faces, up_before(model.rotation), source.label);
    tell();
    surface = unfold_best(surface, plans, source.label);
    tell();
  } else if (model.faces && *model.faces != surface.triangle.size()) {
    throw InputError(fmt::format("{}: has {} faces and a UV map of its own; another count is not to be had",
                                 source.label, surface.triangle.size()));
  }
  return finish(surface, model.name, model.rotation);
}

void need_source(const Source& source) {
  if (source.kind != "cgal" && source.kind != "glmark2") return;
  if (!std::filesystem::exists(source.file()))
    throw InputError(fmt::format("{}: needs {}; install Debian's package {}", source.label,
                                 source.file().string(),
                                 source.kind == "cgal" ? "libcgal-demo" : "glmark2-data"));
}

std::string key_of(const Model& model, const Source& source, const MeshOptions& options) {
  Hash hash;
  hash.number(recipe)
      .text(model.source)
      .number(model.faces.value_or(0))
      .number(model.wrap)
      .number(options.keep_uv);
  hash.bytes(&model.rotation, sizeof model.rotation);
  if (source.kind == "procedural")
    hash.number(procedural_recipe);
  else
    hash.text(read_bytes(source.file(), std::uint64_t(1) << 30));
  return hash.hex();
}

// Several times what the named models take on a slow machine; what needs more has run away.
Limits limits_for(const Model& model, const Source& source) {
  const std::uint64_t bytes = source.kind == "procedural" ? 0 : std::filesystem::file_size(source.file());
  const std::uint64_t seconds = 300 + 60 * (bytes >> 20) + model.faces.value_or(0) / 200;
  return {(std::uint64_t(4) << 30) + 400 * bytes,
          std::chrono::seconds(std::min<std::uint64_t>(seconds, 7200))};
}

Model model_of(const std::string& name_or_file, const MeshOptions& options) {
  const std::vector<Model> known = models();
  const auto named =
      std::find_if(known.begin(), known.end(), [&](const Model& m) { return m.name == name_or_file; });
  Model model;
  if (named != known.end()) {
    model = *named;
  } else if (finer_torus(name_or_file)) {
    model.name = name_or_file;
    model.source = "procedural:" + name_or_file;
    model.rotation = {25, 0, 0};  // as the torus of the tables stands
  } else {
    if (!std::filesystem::exists(name_or_file)) {
      std::string names;
      for (const Model& m : known) names += (names.empty() ? "" : ", ") + m.name;
      throw InputError(fmt::format("{}: no such file, nor a model; there are {}", name_or_file, names));
    }
    model.name = std::filesystem::path(name_or_file).stem().string();
    model.source = "file:" + name_or_file;
  }
  if (options.faces) {
    if (*options.faces < 4 || *options.faces > most_faces)
      throw InputError(fmt::format("{} faces: 4 to {} can be made", *options.faces, most_faces));
    model.faces = options.faces;
  }
  return model;
}

}  // namespace

std::shared_ptr<const Mesh> load_model(const std::string& name_or_file, const MeshOptions& options) {
  const Model model = model_of(name_or_file, options);
  const Source source = source_of(model);
  need_source(source);
  const Say say = options.progress ? options.progress : [](const std::string&) {};
  const std::filesystem::path cached =
      cache_folder() / "meshes" / fmt::format("{}-{}.mesh", model.name, key_of(model, source, options));
  if (options.cache) {
    if (auto mesh = read_cached(cached)) {
      if (source.kind == "file") std::for_each(mesh->notes.begin(), mesh->notes.end(), say);
      return std::make_shared<Mesh>(std::move(*mesh));
    }
  }
  say(fmt::format("{}: preparing the mesh; this is done once", source.label));
  const std::string bytes = isolated(
      source.label, limits_for(model, source),
      [&](const Say& tell) { return encode(prepare(model, source, options, tell)); }, say);
  auto mesh = decode(bytes);
  if (!mesh) throw std::runtime_error(fmt::format("{}: the prepared mesh came back damaged", model.name));
  if (options.cache && !write_cached(cached, *mesh))
    say(fmt::format("{} could not be written", cached.string()));
  return std::make_shared<Mesh>(std::move(*mesh));
}

}  // namespace pelage
