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

void write_dump(const std::filesystem::path& path, const DumpedFrame& frame,
                const std::function<void(Hdf5File&)>& arrays) {
  check_dump_path(path);
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, path.string());
    dump::write_notes(file, frame.scene, frame.mesh, frame.title, frame.frames);
    dump::write_scene_text(file, frame.scene);
    dump::write_shape(file, frame.mesh);
    arrays(file);
    const Picture& image = frame.picture;
    file.write("image", {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)},
               image.pixel, "1",
               "RGBA in gamma space, top row first; alpha is 1 where the base surface is visible, and the "
               "coverage of the fur elsewhere");
    file.close();
  });
}

void dump::write_shells(Hdf5File& file, const FrameInput& input, const FrameOutput& output) {
  write_mesh(file, input);
  write_strands(file, input, output);
  write_wetness(file, input, output);
  write_textures(file, input);
  write_layers(file, input, output);
  write_camera(file, input.camera);
  write_style(file, input);
}

}  // namespace pelage
