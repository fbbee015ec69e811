#include "harness/dump/dump.hpp"

#include <fmt/format.h>

#include "harness/atomic_file.hpp"
#include "harness/dump/datasets.hpp"
#include "harness/error.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

void write_notes(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  const BuildInfo& build = build_info();
  file.note("pelage", fmt::format("{} {}{}", build.version, build.revision, build.dirty ? ", modified" : ""));
  file.note("pipeline", output.pipeline);
  file.note("frames", fmt::format("{}", output.frames));
  file.note("mesh_hash", input.mesh->hash);
  file.note("scene_hash", scene_hash(input.scene));
}

}  // namespace

void check_dump_path(const std::filesystem::path& path) {
  if (path.extension() != ".h5" && path.extension() != ".hdf5") {
    throw InputError(fmt::format("{}: the name of a dump must end in .h5 or .hdf5", path.string()));
  }
  require_place(path);
}

void dump_frame(const std::filesystem::path& path, const FrameInput& input, const FrameOutput& output) {
  check_dump_path(path);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, path.string());
    write_notes(file, input, output);
    dump::write_scene_text(file, input.scene);
    dump::write_mesh(file, input);
    dump::write_strands(file, input, output);
    dump::write_wetness(file, input, output);
    dump::write_textures(file, input);
    dump::write_layers(file, input, output);
    dump::write_camera(file, input.camera);
    const Picture& image = output.image;
    file.write("image", {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width), 4},
               dump::flat<float>(image.pixel), "1",
               "RGBA in gamma space, top row first; alpha is 1 where the base surface is visible, and the "
               "coverage of the fur elsewhere");
    file.close();
  });
}

}  // namespace pelage
