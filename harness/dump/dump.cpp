#include "harness/dump/dump.hpp"

#include <fmt/format.h>

#include "harness/atomic_file.hpp"
#include "harness/dump/datasets.hpp"
#include "harness/error.hpp"

namespace pelage {
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
    dump::write_notes(file, input.scene, *input.mesh, output.pipeline, output.frames);
    dump::write_scene_text(file, input.scene);
    dump::write_shape(file, *input.mesh);
    dump::write_mesh(file, input);
    dump::write_strands(file, input, output);
    dump::write_wetness(file, input, output);
    dump::write_textures(file, input);
    dump::write_layers(file, input, output);
    dump::write_camera(file, input.camera);
    dump::write_style(file, input);
    const Picture& image = output.image;
    file.write("image", {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width), 4},
               dump::flat<float>(image.pixel), "1",
               "RGBA in gamma space, top row first; alpha is 1 where the base surface is visible, and the "
               "coverage of the fur elsewhere");
    file.close();
  });
}

}  // namespace pelage
