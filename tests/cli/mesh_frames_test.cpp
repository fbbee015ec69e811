// Tests strands, and layers on sticks, on a mesh that moves and deforms (scene key mesh.frames).
#include <cmath>
#include <numbers>

#include "harness/compare/metrics.hpp"
#include "harness/picture/image_io.hpp"
#include "tests/cli/frames.hpp"

namespace pelage::cli {
namespace {

/// Returns a sphere without poles as an OBJ file: a tube of 24 x 12 quads whose ends are closed. `lift` moves
/// each point upwards by lift * x^2.
std::string body(double lift) {
  constexpr int around = 24, along = 12;
  std::string text;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j < around; ++j) {
      const double v = std::numbers::pi * (0.05 + 0.9 * i / along), u = 2 * std::numbers::pi * j / around;
      const double x = std::sin(v) * std::cos(u), y = std::cos(v), z = std::sin(v) * std::sin(u);
      text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x, y + lift * x * x, z);
    }
  const auto point = [&](int i, int j) { return i * around + j % around + 1; };
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < around; ++j)
      text +=
          fmt::format("f {} {} {} {}\n", point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j));
  std::string top = "f", bottom = "f";
  for (int j = 0; j < around; ++j) {
    top += fmt::format(" {}", point(0, around - 1 - j));
    bottom += fmt::format(" {}", point(along, j));
  }
  return text + top + "\n" + bottom + "\n";
}

void write_frames(const Folder& folder) {
  for (int frame = 0; frame < 6; ++frame)
    folder.write(fmt::format("body-{}.obj", frame + 7), body(0.06 * frame));
  folder.write(
      "scene.toml",
      "model = \"body-7.obj\"\nmesh.frames = 6\ndynamics.topology = \"chains\"\nimage.width = 240\nimage.height = 180\nstrands.layer = [{ count = 4000, length = 0.15 }, { count = 2000, length = 0.3, lean = 60.0 }]\n");
}

Picture drawn(const Folder& folder, const std::string& options) {
  done(folder, "render scene.toml -o a.exr " + options);
  return read_picture(folder.path / "a.exr");
}

struct MeshFrames : InFolder {};

/// Options for layers on sticks of a topology, in wind.
std::string layers(const std::string& topology) {
  return fmt::format(
      "--set dynamics.topology={} --set fur.length=0.2 --set fur.layers=8 --set dynamics.drag=0.004 --set dynamics.wind.strength=0.01 --set dynamics.gravity=[0,-9.81,0] ",
      topology);
}

TEST_F(MeshFrames, TheDeviceAndTheReferenceDrawTheSamePictures) {
  write_frames(folder);
  const Picture rest = drawn(folder, "--pipeline strands --set mesh.frames=1 --set dynamics.time=0.08");
  // After 0.08 s, the skin still moves; after 0.5 s, it has had the shape of the last frame for some time.
  for (const char* time : {"0.08", "0.5"}) {
    const std::string options = fmt::format("--set dynamics.time={} --pipeline strands", time);
    const Picture device = drawn(folder, options), reference = drawn(folder, options + "-reference");
    const Agreement found = compare(device, reference);
    EXPECT_TRUE(within(found)) << time << " s: " << found.psnr << " dB, " << found.flips << " flips";
    EXPECT_LT(compare(device, rest).psnr, 35);
  }
  const Outcome opengl = pelage("render scene.toml --pipeline strands-opengl -o a.png");
  if (!has(opengl.err, "no OpenGL")) expect_refused(opengl, "does not deform", true);
  const Picture held = drawn(folder, "--pipeline strands --set dynamics.time=0.5");
  const Picture repeated =
      drawn(folder, "--pipeline strands --set dynamics.time=0.5 --set mesh.after_frames=repeat");
  EXPECT_LT(compare(held, repeated).psnr, 35);
}

TEST_F(MeshFrames, LayersOnSticksFollowThem) {
  write_frames(folder);
  for (const char* topology : {"sticks", "prisms", "separable-sticks", "separable-prisms"}) {
    const std::string options = layers(topology);
    const Picture rest = drawn(folder, options + "--set mesh.frames=1 --set dynamics.time=0.08");
    for (const char* time : {"0", "0.08", "0.5"}) {
      const std::string at = fmt::format("{} --set dynamics.time={}", options, time);
      const Agreement found = compare(drawn(folder, at), drawn(folder, at + " --pipeline reference"));
      EXPECT_TRUE(within(found)) << topology << ", " << time << " s: " << found.psnr << " dB";
    }
    EXPECT_LT(compare(drawn(folder, options + "--set dynamics.time=0.08"), rest).psnr, 35) << topology;
  }
  // Curls with the tangents of each frame, drops on the skin, and a wind that keyframes change.
  const std::string all =
      layers("prisms") +
      "--set curl.radius=0.02 --set curl.turns=2 --set fur.substeps=2 --set wetness.random=12 --set wetness.radius=0.08 --set dynamics.wind.gust=0.4 --set dynamics.time=0.08 ";
  const Agreement found = compare(drawn(folder, all), drawn(folder, all + "--pipeline reference"));
  EXPECT_TRUE(within(found)) << found.psnr << " dB";
  folder.write("gusts.toml", folder.read("scene.toml") +
                                 "keyframes.\"dynamics.wind.strength\" = [[0.0, 0.0], [0.1, 0.03]]\n");
  const std::string gusts = "render gusts.toml --set dynamics.topology=sticks --set dynamics.time=0.08 ";
  done(gusts + "-o a.exr");
  done(gusts + "-o b.exr --pipeline reference");
  EXPECT_TRUE(within(compare(read_picture(folder.path / "a.exr"), read_picture(folder.path / "b.exr"))));
}

TEST_F(MeshFrames, TheFirstPictureShowsTheFirstFile) {
  write_frames(folder);
  const std::string fixed =
      "--pipeline strands --set strands.shadow=none --set camera.framed=false --set camera.eye=[2,2,4] --set dynamics.time=";
  const Picture rest = drawn(folder, fixed + "0 --set mesh.frames=1");
  EXPECT_GT(compare(drawn(folder, fixed + "0"), rest).psnr, 70);
  const Picture second = drawn(folder, fixed + "0.0167");
  EXPECT_LT(compare(second, rest).psnr, 45);
  // After the last file, the first one follows: the skin of the picture 7 is that of the picture 1.
  EXPECT_LT(
      compare(drawn(folder, fixed + "0.0834"), drawn(folder, fixed + "0.1 --set mesh.after_frames=repeat"))
          .psnr,
      35);
}

TEST_F(MeshFrames, AnExperimentTimesThemAndKnowsTheirFiles) {
  write_frames(folder);
  folder.write(
      "mine.toml",
      "name = \"mine\"\n[axes]\nmodel = [\"body-7.obj\"]\nvariant = [\"strands\"]\n[scene]\nfile = \"scene.toml\"\n[variant.strands]\npipeline = \"strands\"\n[variant.layers]\npipeline = \"shells\"\ndynamics.topology = \"sticks\"\nfur.length = 0.2\n[preset.quick]\nwarm_up_s = 0.0\nleast = 9\nmost = 9\nprecision = 0.02\nlimit_s = 20.0\n");
  done("run mine.toml -o rows");
  done("run mine.toml --resume rows");
  done("run mine.toml -o layers --axis variant=layers");
  folder.write("body-12.obj", body(0.5));
  expect_refused(pelage("run mine.toml --resume rows"), "mesh", true);
}

TEST_F(MeshFrames, ContradictionsAreRefused) {
  write_frames(folder);
  const std::pair<const char*, const char*> refused[] = {
      {"--set dynamics.topology=silva", "on sticks only"},
      {"--set dynamics.topology=sticks --set dynamics.motion.spin=1", "must not move"},
      {"--pipeline strands --set mesh.frames=7", "body-13.obj"},
      {"--pipeline strands --model torus", "is no mesh file"},
      {"--pipeline strands --set dynamics.motion.velocity=[1,0,0]", "must not move"},
      {"--pipeline strands --set strands.chain.collision=body", "does not deform"},
      {"--pipeline strands-raycast", "at rest"}};
  for (const auto& [options, message] : refused)
    expect_refused(pelage(std::string("render scene.toml -o a.png ") + options), message, true);
}

TEST_F(MeshFrames, AnAnimationHasThePicturesOfRender) {
  write_frames(folder);
  // Frames of the mesh last 1/60 s, so the animation skips some frames of the mesh.
  EXPECT_EQ(expect_rendered_frames(folder, "scene.toml --pipeline strands --size 64x48", 0, 40, 5), 5u);
}

TEST_F(MeshFrames, AnAnimationOfLayersHasThePicturesOfRender) {
  write_frames(folder);
  EXPECT_EQ(expect_rendered_frames(folder, "scene.toml --size 64x48 " + layers("prisms"), 0, 40, 5), 5u);
}

}  // namespace
}  // namespace pelage::cli
