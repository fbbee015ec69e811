#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/mesh/cache.hpp"
#include "harness/mesh/finish.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/models.hpp"
#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/steps.hpp"
#include "harness/mesh/unfold.hpp"
#include "harness/mesh/uv_pieces.hpp"

namespace pelage {
namespace {

// Version of the preparation of all meshes. The file name of every cached mesh depends on it. Increase it
// whenever a change of the code changes the prepared mesh of any model or file.
constexpr int recipe = 4;
constexpr int procedural_recipe = 3;  // version of the preparation of procedural shapes
constexpr int file_recipe = 6;        // version of the preparation of users' mesh files

constexpr std::uint32_t most_faces = 8'000'000;
constexpr int most_torus_faces = 8'000'000;
const std::filesystem::path cgal_archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
const std::filesystem::path glmark2_folder = "/usr/share/glmark2/models";

struct Source {
  /// kind: "procedural", "cgal", "glmark2" or "file". item: the name of a procedural shape, the name of a
  /// file in the package of CGAL or glmark2, or the path of a file.
  std::string kind, item;
  std::string label;  ///< name of the source in messages
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

// Returns the direction, in the coordinate system of the source, that `rotation` maps to +y.
glm::dvec3 up_before(glm::dvec3 rotation) {
  return glm::row(rotation_matrix(rotation), 1);
}

// Returns the numbers of quads A and B in a name "torus-AxB"; empty for other names. Throws InputError if
// A or B is less than 3, or if the torus would have more than most_torus_faces faces.
std::optional<glm::ivec2> finer_torus(const std::string& name) {
  glm::ivec2 count{};
  if (!RE2::FullMatch(name, "torus-([0-9]{1,4})x([0-9]{1,4})", &count.x, &count.y)) return {};
  if (std::min(count.x, count.y) < 3 || 2 * count.x * count.y > most_torus_faces)
    throw InputError(
        fmt::format("{}: give at least 3 quads per direction and at most {} faces", name, most_torus_faces));
  return count;
}

[[noreturn]] void refuse_uv(const Source& source, const std::string& what) {
  throw InputError(
      fmt::format("{}: {}, so no UV map can be kept; leave out --keep-uv, or give fur.uv = \"computed\"",
                  source.label, what));
}

Surface shape_of(const Source& source, const MeshOptions& options, Stages& stages) {
  if (source.kind == "procedural") {
    if (options.keep_uv) refuse_uv(source, "is no file");
    if (source.item == "torus") return make_torus(72, 65, 0.4);
    if (const auto quads = finer_torus(source.item)) return make_torus(quads->x, quads->y, 0.4);
    if (source.item == "pear") return make_pear(6);
    if (int side{}; RE2::FullMatch(source.item, "square-([1-9][0-9]{0,2}|1000)", &side))
      return make_square(side);
    throw InputError(fmt::format("{}: no procedural shape {}; there are torus, torus-AxB, pear and square-N",
                                 source.label, source.item));
  }
  Soup soup;
  std::string joined;
  stages.begin("reading");
  if (source.kind == "cgal") {
    auto bytes = read_member(cgal_archive, "data/meshes/" + source.item);
    if (!bytes)
      throw InputError(
          fmt::format("{}: the archive has no data/meshes/{}", cgal_archive.string(), source.item));
    soup = parse_soup(std::move(*bytes), std::filesystem::path(source.item).extension().string().substr(1),
                      source.item);
  } else {
    soup = read_soup(source.file(), options.keep_uv);
  }
  const bool file = source.kind == "file";
  if (file) {
    stages.begin("sorting points and faces");
    sort_soup(soup);
    joined = weld_near(soup);
  }
  if (options.keep_uv && soup.uv.empty()) refuse_uv(source, "has no UV map of its own");
  const auto noted = [&](Surface surface) {
    if (!joined.empty()) surface.notes.insert(surface.notes.begin(), joined);
    return surface;
  };
  if (options.keep_uv) return noted(weld(soup, source.label));
  if (soup.polygon.size() > most_faces)
    throw InputError(fmt::format("{}: {} faces; at most {} can be prepared", source.label,
                                 soup.polygon.size(), most_faces));
  return noted(repair(soup, {!file, !file || options.largest_only}, source.label, stages));
}

// Returns a coarse version of the surface with about `faces` faces. plan_cuts() tests possible cuts on it. A
// closed surface has an even number of faces. If the model must have an odd number of faces, with_faces()
// therefore removes one face, which leaves a hole. The coarse version then also gets an odd number of faces,
// so that it has such a hole too. Returns `surface` itself if it cannot be made coarser.
Surface proxy_of(const Surface& surface, const Model& model, std::uint32_t faces,
                 const std::function<void(double)>& part) {
  const std::uint32_t wanted = model.faces.value_or(std::uint32_t(surface.triangle.size()));
  try {
    return with_faces(surface, std::min(wanted, faces + wanted % 2), up_before(model.rotation), model.name,
                      part);
  } catch (const InputError&) {
    return surface;
  }
}

// Computes the UV map of a component of a mesh file, and returns the component with this map. plan_cuts()
// tests possible cuts on a coarse version of the component. The more components the file has, the fewer faces
// the coarse version has.
Surface mapped(const Surface& component, Model model, const std::string& label, std::size_t number,
               std::size_t count, Stages& stages) {
  const std::string of = count == 1 ? "" : fmt::format(", component {} of {}", number + 1, count);
  model.faces.reset();
  stages.begin("making a coarse version" + of);
  const auto coarse = std::uint32_t(std::max(300.0, 6000 / std::sqrt(double(count))));
  const Surface proxy = proxy_of(component, model, coarse, stages.parts());
  stages.begin("choosing the cuts for the UV map" + of);
  const auto unfold_proxy = [](const Surface& surface, const CutPlan& plan, const std::string& name) {
    return unfold_file(surface, plan, name);
  };
  std::vector<TriedPlan> plans = plan_cuts(proxy, label, unfold_proxy, stages.parts());
  stages.begin("computing the UV map" + of);
  return unfold_first(component, std::move(plans), label,
                      [&](const Surface& surface, const CutPlan& plan, const std::string& name) {
                        return unfold_file(surface, plan, name, stages.parts());
                      });
}

// Prepares the repaired surface of a mesh file and computes its UV map, which has one chart per component.
// The time of every step grows linearly with the number of triangles.
Surface mapped_file(Surface surface, const Model& model, const std::string& label, Stages& stages) {
  if (model.faces) {
    stages.begin("changing the number of faces");
    surface = with_faces(surface, *model.faces, up_before(model.rotation), label, stages.parts());
  }
  std::vector<Surface> parts = split(surface);
  if (parts.size() == 1) {
    parts.clear();
    return mapped(surface, model, label, 0, 1, stages);
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i] = mapped(parts[i], model, label, i, parts.size(), stages);
  stages.begin("packing charts");
  return packed(surface, parts);
}

// Removes the overlaps of a computed UV map. A map without overlaps stays unchanged.
Surface without_overlaps(Surface surface, bool even, const std::string& label, Stages& stages) {
  if (surface.periodic_uv) return surface;
  stages.begin("searching the UV map for overlaps");
  Surface fitted = surface;
  fit_uv(fitted);
  const bool changed = recut(fitted, even, label);
  return changed ? fitted : surface;
}

Mesh prepare(const Model& model, const Source& source, const MeshOptions& options, const Say& say) {
  Stages stages(say, source.label, options.silent_s);
  Surface surface = shape_of(source, options, stages);
  std::size_t told = 0;
  const auto tell = [&] {
    for (; told < surface.notes.size(); ++told) say(surface.notes[told]);
  };
  tell();
  if (!surface.uv.empty()) {
    if (model.faces && *model.faces != surface.triangle.size())
      throw InputError(fmt::format(
          "{}: has {} faces and a UV map of its own; the face count cannot change while that map is kept",
          source.label, surface.triangle.size()));
  } else if (source.kind == "file") {
    surface = mapped_file(std::move(surface), model, source.label, stages);
  } else {
    if (model.wrap) surface = wrap(surface);
    tell();
    stages.begin("choosing the cuts for the UV map");
    const std::vector<TriedPlan> plans =
        plan_cuts(proxy_of(surface, model, 6000, [](double) {}), source.label, unfold_model, stages.parts());
    if (model.faces) {
      stages.begin("changing the number of faces");
      surface = with_faces(surface, *model.faces, up_before(model.rotation), source.label, stages.parts());
    }
    tell();
    stages.begin("computing the UV map");
    surface = unfold_best(surface, plans, source.label);
  }
  tell();
  if (!options.keep_uv) surface = without_overlaps(std::move(surface), options.even_uv, source.label, stages);
  tell();
  stages.begin("sorting");
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
      .text(source.kind != "file"
                ? model.source
                : "file:" + std::filesystem::absolute(source.item).lexically_normal().string())
      .number(model.faces.value_or(0))
      .number(model.wrap)
      .number(options.keep_uv);
  if (options.even_uv) hash.text("even");
  hash.bytes(&model.rotation, sizeof model.rotation);
  if (source.kind == "file") hash.number(file_recipe).number(options.largest_only);
  if (source.kind == "procedural")
    hash.number(procedural_recipe);
  else
    hash.text(read_bytes(source.file(), largest_mesh_file));
  if (source.kind == "file")
    for (const std::filesystem::path& part : detail::gltf_files(source.file()))
      hash.text(read_bytes(part, largest_mesh_file));
  return hash.hex();
}

// Returns limits for the process that prepares the mesh, so that it ends: several times the time and memory
// that the models of experiments/models.toml need on a slow machine.
Limits limits_for(const Model& model, const Source& source) {
  const std::uint64_t bytes = source.kind == "procedural" ? 0 : std::filesystem::file_size(source.file());
  const std::uint64_t seconds = 300 + 60 * (bytes >> 20) + model.faces.value_or(0) / 200;
  return {mesh_memory(bytes), std::chrono::seconds(std::min<std::uint64_t>(seconds, 7200))};
}

Model model_of(const std::string& name_or_file, const MeshOptions& options) {
  const std::vector<Model> known = models();
  const auto named = std::ranges::find_if(known, [&](const Model& m) { return m.name == name_or_file; });
  Model model;
  if (named != known.end()) {
    model = *named;
  } else if (finer_torus(name_or_file)) {
    model.name = name_or_file;
    model.source = "procedural:" + name_or_file;
    model.rotation = {25, 0, 0};  // the same rotation as that of the model "torus"
  } else {
    if (!std::filesystem::exists(name_or_file)) {
      std::string names;
      for (const Model& m : known) names += (names.empty() ? "" : ", ") + m.name;
      throw InputError(fmt::format("{}: neither a file nor a model; the models are {}", name_or_file, names));
    }
    model.name = std::filesystem::path(name_or_file).stem().string();
    model.source = "file:" + name_or_file;
  }
  if (options.faces) {
    if (*options.faces < 4 || *options.faces > most_faces)
      throw InputError(fmt::format("the number of faces is {}; give 4 to {}", *options.faces, most_faces));
    model.faces = options.faces;
  }
  return model;
}

}  // namespace

void require_model(const std::string& name_or_file) {
  model_of(name_or_file, {});
}

std::shared_ptr<const Mesh> load_model(const std::string& name_or_file, const MeshOptions& options) {
  const Model model = model_of(name_or_file, options);
  const Source source = source_of(model);
  need_source(source);
  const glm::dvec3 rotate(options.rotate);
  if (!(glm::all(glm::lessThanEqual(glm::abs(rotate), glm::dvec3(360)))))
    throw InputError(
        fmt::format("{}: the rotation is {}, {} and {} degrees; each angle must be -360 to 360 degrees",
                    source.label, rotate.x, rotate.y, rotate.z));
  const Say say = options.progress ? options.progress : [](const std::string&) {};
  const bool from_file = source.kind == "file";
  const std::filesystem::path cached =
      cache_folder() / "meshes" / fmt::format("{}-{}.mesh", model.name, key_of(model, source, options));
  if (const auto kept = options.cache ? read_cache_file(cached) : std::nullopt)
    if (auto mesh = decode(*kept)) {
      if (from_file)
        for (const std::string& note : mesh->notes) say(fmt::format("{}: {}", source.label, note));
      mesh->from_file = from_file;
      return std::make_shared<Mesh>(turned(std::move(*mesh), rotate));
    }
  say(fmt::format("{}: preparing the mesh; this is done once", source.label));
  const std::string bytes = isolated(
      source.label, limits_for(model, source),
      [&](const Say& tell) { return encode(prepare(model, source, options, tell)); }, say);
  auto mesh = decode(bytes);
  if (!mesh)
    throw std::runtime_error(fmt::format("{}: the preparing process returned a damaged mesh", model.name));
  mesh->from_file = from_file;
  if (options.cache && !write_cache_file(cached, bytes))
    say(fmt::format("{} could not be written; the mesh is not cached", cached.string()));
  return std::make_shared<Mesh>(turned(std::move(*mesh), rotate));
}

}  // namespace pelage
