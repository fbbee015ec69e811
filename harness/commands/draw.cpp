// pelage render, pelage animate and pelage scene: pictures and animations of a scene, and the scene itself.
#include <fmt/format.h>

#include <chrono>

#include "harness/animation/animation.hpp"
#include "harness/cl/program.hpp"
#include "harness/commands/commands.hpp"
#include "harness/commands/progress.hpp"
#include "harness/commands/scene_options.hpp"
#include "harness/dump/dump.hpp"
#include "harness/error.hpp"
#include "harness/file_hash.hpp"
#include "harness/measure/interrupt.hpp"
#include "harness/picture/image_io.hpp"
#include "harness/scene/keyframes.hpp"
#include "harness/scene/scene_toml.hpp"
#include "harness/version/version.hpp"

namespace pelage {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string output, dump;
  RendererOptions renderer;
};

int render(const RenderOptions& options) {
  check_picture_path(options.output);
  if (!options.dump.empty()) check_dump_path(options.dump);
  const Scene resolved = resolve_scene(options.scene, options.renderer.pipeline);
  const Scene scene = scene_at(resolved, double(resolved.dynamics.time));
  // The device is opened before the mesh is prepared. Otherwise the user would learn of an invalid device
  // name only after the preparation, which may take minutes.
  const std::unique_ptr<Renderer> renderer = open_renderer(options.renderer, resolved, scene);
  const Picture picture = renderer->draw(scene, load_drawn_mesh(options.renderer, scene));
  if (!renderer->device().empty())  // otherwise the pipeline runs on the host
    fmt::print(stderr,
               "{}: {:.1f} ms for the first frame, without warm-up; use `pelage run` to time frames\n",
               renderer->device(), renderer->ms());
  write_picture(options.output, picture);
  if (!options.dump.empty()) renderer->dump(options.dump);
  return 0;
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
  auto [command, options] =
      add_command<RenderOptions>(app, chosen, "render", "Draw one picture of a scene", render);
  add_scene_options(command, options.scene, true);
  add_value(command, "-o,--output", options.output, "IMAGE",
            "Picture to write: .png (8-bit), .exr or .tif (float)")
      ->required();
  add_renderer_options(command, options.renderer);
  add_value(command, "--dump", options.dump, "FRAME.h5",
            "Write all inputs and intermediate arrays of the frame as HDF5");
}

namespace {

namespace fs = std::filesystem;

struct AnimateOptions {
  SceneOptions scene;
  RendererOptions renderer;
  TimeOptions times;
  std::string output, gif, mp4;
  bool resume = false;
};

Scene animated_scene(const AnimateOptions& options) {
  for (const std::string& assignment : options.scene.set)
    if (assignment.starts_with("dynamics.time=") || assignment.starts_with("dynamics.time "))
      throw InputError(fmt::format("--set {}: every frame has its own time; give --from and --to or --frames",
                                   assignment));
  return resolve_scene(options.scene, options.renderer.pipeline);
}

/// Returns the hash of all files in the folder of the kernels.
std::string hash_of_kernels() {
  const fs::path folder = cl::kernel_folder();
  std::map<std::string, std::string> hashes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      hashes[entry.path().lexically_relative(folder).string()] = hash_of_file(entry.path());
  Hash all;
  for (const auto& [name, hash] : hashes) all.text(name).text(hash);
  return all.hex();
}

FrameOrigin origin_of(const AnimateOptions& options, const Scene& scene, const Mesh& mesh,
                      const Renderer& renderer) {
  const BuildInfo& build = build_info();
  const RendererOptions& r = options.renderer;
  // picture_scene() ignores the scene's own time. The other entries explain a difference better than the hash
  // of the scene, so this hash is the last entry.
  Scene timeless = scene;
  timeless.dynamics.time = 0;
  std::erase_if(timeless.keyframes.tracks,
                [](const KeyTrack& track) { return track.key == "dynamics.time"; });
  return {{"program", fmt::format("pelage {}, revision {}{}", build.version, build.revision,
                                  build.dirty ? ", modified" : "")},
          {"kernels", hash_of_kernels()},
          {"size", fmt::format("{}x{}", scene.image.width, scene.image.height)},
          {"frames per second", fmt::format("{}", options.times.fps)},
          {"time of the first frame", fmt::format("{} s", options.times.from)},
          {"pipeline", pipeline_of(r, scene)},
          {"mapping", r.mapping.empty() ? "default" : r.mapping},
          {"options of OpenGL", r.opengl.empty() ? "default" : r.opengl},
          {"bits of the reference", fmt::format("{}", r.bits)},
          {"device", renderer.device().empty() ? "none" : renderer.device()},
          {"mesh", mesh.hash},
          {"scene", scene_hash(timeless)}};
}

/// Draws the frames that the folder does not hold. Returns their number.
int draw_frames(FrameFolder& folder, const Scene& scene, const FrameTimes& times, Renderer& renderer,
                const std::shared_ptr<const Mesh>& mesh) {
  Progress progress{std::size_t(times.count)};
  int drawn = 0;
  for (int frame = 0; frame < times.count; ++frame) {
    if (folder.holds(frame)) {
      progress.skip(1);
      continue;
    }
    const auto from = std::chrono::steady_clock::now();
    const float seconds = times.at(frame);
    progress.start(fmt::format("{}, {:.3f} s", frame_name(frame), seconds));
    const Picture picture = renderer.draw(picture_scene(scene, seconds), mesh);
    {
      const HoldInterrupt hold;  // defers interrupts until the frame is written and recorded
      folder.write(frame, picture);
    }
    ++drawn;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - from;
    progress.finish(fmt::format("drawn in {:.2f} s", spent.count()));
  }
  return drawn;
}

void write_videos(const AnimateOptions& options, const FrameTimes& times) {
  const HoldInterrupt hold;  // defers interrupts until the video is complete or its temporary file removed
  if (!options.gif.empty()) write_gif(options.gif, options.output, times.fps, times.count);
  if (!options.mp4.empty()) write_mp4(options.mp4, options.output, times.fps, times.count);
}

int animate(const AnimateOptions& options) {
  const Scene scene = animated_scene(options);
  const FrameTimes times = frame_times(options.times, scene);
  if (!options.gif.empty()) check_video("--gif", options.gif, options.output);
  if (!options.mp4.empty()) check_video("--mp4", options.mp4, options.output);
  check_frame_folder(options.output, options.resume);
  check_frames(scene, times);
  end_on_interrupt((fs::path(options.output) / frame_record).string(),
                   "finished frames are kept; continue with --resume");
  // The device is opened before the mesh is prepared, so that an invalid name is reported at once.
  const std::unique_ptr<Renderer> renderer =
      open_renderer(options.renderer, scene, picture_scene(scene, times.at(0)));
  const std::shared_ptr<const Mesh> mesh = load_drawn_mesh(options.renderer, scene);
  FrameFolder folder(options.output, origin_of(options, scene, *mesh, *renderer), options.resume);
  const int drawn = draw_frames(folder, scene, times, *renderer, mesh);
  write_videos(options, times);
  fmt::print(stderr, "pelage: {}: {} frames drawn{}\n", options.output, drawn,
             drawn < times.count ? fmt::format(", {} kept", times.count - drawn) : "");
  return 0;
}

void add_time_options(CLI::App& command, TimeOptions& times) {
  add_value(command, "--fps", times.fps, "F", "Frames per second of the scene's time");
  add_value(command, "--from", times.from, "SECONDS", "Time of the first frame in seconds");
  add_value(command, "--to", times.to, "SECONDS",
            "Time of the last frame in seconds (default: the time of the scene's last keyframe)");
  add_value(command, "--frames", times.frames, "N", "Number of frames, instead of --to");
}

}  // namespace

void add_animate(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<AnimateOptions>(
      app, chosen, "animate", "Draw the frames of an animation of a scene", animate);
  add_scene_options(command, options.scene, true);
  add_value(command, "-o,--output", options.output, "FOLDER",
            "Folder for the frames, frame-00000.png and so on")
      ->required();
  add_time_options(command, options.times);
  add_value(command, "--gif", options.gif, "FILE", "Also join the frames to a GIF file (needs ffmpeg)");
  add_value(command, "--mp4", options.mp4, "FILE", "Also join the frames to an MP4 video (needs ffmpeg)");
  command.add_flag("--resume", options.resume,
                   "Continue an interrupted animation: keep the complete frames of the folder");
  add_renderer_options(command, options.renderer);
}

namespace {

int print_scene(const SceneOptions& options) {
  fmt::print("{}", write_scene(resolve_scene(options)));
  return 0;
}

}  // namespace

void add_scene(CLI::App& app, Chosen& chosen) {
  auto [command, options] = add_command<SceneOptions>(
      app, chosen, "scene",
      "Print a scene with all overrides: value, meaning, unit, range and default of each key", print_scene);
  add_scene_options(command, options, false);
}

}  // namespace pelage
