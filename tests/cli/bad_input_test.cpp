// Tests that invalid input gives the right exit code and one clear line on stderr, without a crash or a hang.
// The tests also run under the sanitizers, whose reports change the exit code.
#include <gtest/gtest.h>

#include <algorithm>

#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

struct Bad {
  const char* arguments;
  int code;
  const char* expected;  ///< text that the last line on stderr must contain
};

const Bad usage[] = {
    {"", 2, "give a command; `pelage --help` lists them"},
    {"fly", 2, "fly"},
    {"--fly", 2, "--fly"},
    {"scene --fly", 2, "--fly"},
    {"scene a.toml b.toml", 2, "b.toml"},
    {"--kernels", 2, "--kernels"},
    {"--kernels nowhere scene", 2, "--kernels nowhere"},
    {"render", 2, "--output"},
    {"render -o", 2, "--output"},
    {"render -o a.png --size 0x0", 2, "--size: image.width: 0 is out of range; give 1 to 16384 pixels"},
    {"render -o a.png --size 800", 2, "--size 800: give width x height"},
    {"render -o a.png --size 800x", 2, "--size 800x: give width x height"},
    {"render -o a.png --size -8x6", 2, "--size -8x6: give width x height"},
    {"render -o a.png --size 8e2x6e2", 2, "give width x height"},
    {"render -o a.png --size 16384x16384", 2, "268435456 pixels; give at most"},
    {"render -o a.png --size 99999999999999999999x1", 2, "give width x height"},
    {"render -o a.png --set fur.layers=1", 2, "--set: fur.layers: 1 is out of range; give 2 to 512"},
    {"render -o a.png --set fur.length=nan", 2, "nan is not a finite number"},
    {"render -o a.png --set fur.lenght=1", 2, "did you mean fur.length?"},
    {"render -o a.png --set dynamics.step=0", 2, "dynamics.step: 0 is out of range"},
    {"render -o a.png --set dynamics.step=1", 2, "dynamics.step: 1 s is unstable"},
    {"render -o a.png --set", 2, "--set"},
    {"render -o a.png --pipeline magic", 2, "--pipeline"},
    {"render -o a.png --mapping magic", 2, "--mapping"},
    {"render -o a.png --reference-bits 7", 2, "--reference-bits"},
    {"render -o a.png --reference-bits 8 --pipeline shells", 2, "add --pipeline reference"},
    {"render -o a.png --device 'no such device'", 2, "no such device"},
    {"check fly", 2, "fly"},
    {"check --filter '('", 2, "--filter (: this is not a valid regular expression"},
    {"check --filter zebra", 2, "--filter zebra: no case has a name that matches"},
    {"check --device 'no such device'", 2, "no such device"},
    {"scene --set fur.layers=\"'\na\n'\"", 2, "fur.layers"},
};

const Bad scenes[] = {
    {"scene --set wetness.text=\"' '\" --set wetness.random=9", 2, "wetness.text: has no visible character"},
    {"scene --set wetness.text=caf\xc3\xa9 --set wetness.random=9", 2,
     "wetness.text: byte 4 is not a printable ASCII character"},
    {"scene --set wetness.text=A", 2, "wetness.text: has no effect without random droplets"},
    {"scene wet --case a", 2, "there is no experiment 'wet'"},
    {"scene --case a", 2, "--case a: give also an experiment"},
    {"scene silva2010-fig01 --case dri-640x480", 2, "has no such case; did you mean dry-640x480?"},
    {"diagram mask", 2, "diagram mask: is a picture; give a file with -o, such as mask.png"},
    {"diagram clump -o a.png", 2, "a.png: diagram clump is a table"},
    {"diagram fly", 2, "fly"},
    {"diagram curl -o nowhere/a.csv", 2, "nowhere"},
    {"scene missing.toml", 2, "missing.toml: there is no such scene file"},
    {"scene wet-curlz", 2, "wet-curlz: there is no such scene file, and no such example in"},
    {"scene nowhere/wet.toml", 2, "nowhere/wet.toml: there is no such scene file"},
    {"run typo.toml -o r", 2, "typo.toml: is not an experiment, because it has neither a name nor axes"},
    {"run silva2010-table1 --model gone.obj --dry-run", 2, "gone.obj: neither a file nor a model"},
    {"run silva2010-table1 --up x --dry-run", 2, "--up"},
    {"render text.obj -o a.png", 2, "text.obj: is a mesh file; give a scene and the mesh"},
    {"scene .", 2, ".: is a folder"},
    {"scene binary.toml", 2, "binary.toml:1: not TOML"},
    {"scene half.toml", 2, "half.toml:2: not TOML"},
    {"scene twice.toml", 2, "twice.toml:2: not TOML"},
    {"scene typo.toml", 2, "typo.toml:2: fur.lenght: no such key; did you mean fur.length?"},
    {"scene type.toml", 2, "type.toml:1: fur.layers: is a string; give 2 to 512"},
    {"scene deep.toml", 2, "deep.toml:1: not TOML"},
    {"scene /dev/zero", 2, "is larger than a scene file may be"},
    {"render -o a.png nan.toml", 2, "nan.toml:1: fur.tile: nan is not a finite number"},
};

const Bad meshes[] = {
    {"--model nothing", 2, "nothing"},
    {"--model nothing.obj", 2, "nothing.obj"},
    {"--model .", 2, "not a file"},
    {"--model text.obj", 2, "text.obj"},
    {"--model empty.off", 2, "empty.off"},
    {"--model truncated.off", 2, "truncated.off"},
    {"--model infinite.off", 2, "infinite.off"},
    {"--model flat.off", 2, "flat.off"},
    {"--model range.obj", 2, "range.obj"},
    {"--model text.ply", 2, "text.ply"},
    {"--model huge.ply", 2, "huge.ply"},
    {"--model text.stl", 2, "text.stl"},
    {"--model text.3ds", 2, "text.3ds"},
    {"--model text.gltf", 2, "text.gltf"},
    {"--model text.xyz", 2, "text.xyz"},
};

const Bad images[] = {
    {"--set coat.image=missing.png", 2, "missing.png: there is no such file"},
    {"--set coat.image=.", 2, "not a file"},
    {"--set coat.image=text.png", 2, "text.png: not a readable picture"},
    {"--set coat.image=half.png", 2, "half.png: "},
    {"--set coat.image=half.tif", 2, "half.tif: "},
    {"--set coat.image=half.exr", 2, "half.exr: "},
    {"--set coat.image=half.jpg", 2, "half.jpg: "},
    {"--set coat.image=huge.png", 2, "huge.png: "},
    {"--set coat.image=text.gif", 2,
     "text.gif: pelage does not read this format; it reads PNG, JPEG, TIFF and EXR"},
    {"--set wetness.text=A --set wetness.random=10 --set wetness.text_font=missing.ttf", 2,
     "missing.ttf: there is no such font file"},
    {"--set wetness.text=A --set wetness.random=10 --set wetness.text_font=text.png", 2,
     "text.png: not a readable font; give a TrueType or OpenType file"},
    {"--set wetness.text=WWWWWW --set wetness.random=10 --set wetness.text_height=0.9", 2,
     "leaves the unit square; give a smaller wetness.text_height"},
    {"--set wetness.image=missing.png --set wetness.random=10", 2, "missing.png: there is no such file"},
};

const Bad outputs[] = {
    {"-o a.jpg", 2, "a.jpg: a picture is written as .png, .exr or .tif"},
    {"-o a", 2, "a: a picture is written as"},
    {"-o nowhere/a.png", 2, "nowhere/a.png: cannot be written, because the folder 'nowhere' does not exist"},
    {"-o folder.png", 2, "folder.png: cannot be written, because it is a folder"},
    {"-o /proc/a.png", 2, "/proc/a.png: cannot be written"},
    {"-o /proc/a.exr", 2, "/proc/a.exr: cannot be written"},
    {"-o a.png --dump a.txt", 2, "a.txt: the name of a dump must end in .h5 or .hdf5"},
    {"-o a.png --dump nowhere/a.h5", 2, "nowhere/a.h5: cannot be written"},
    {"-o a.png --dump /proc/a.h5", 2, "/proc/a.h5: cannot be written"},
};

std::string last_line(const std::string& text) {
  if (text.empty()) return text;
  const auto end = text.back() == '\n' ? text.size() - 1 : text.size();
  const auto start = text.rfind('\n', end - 1);
  return text.substr(start == std::string::npos ? 0 : start + 1,
                     end - (start == std::string::npos ? 0 : start + 1));
}

void expect(const Folder& folder, const Bad& bad, const std::string& command, bool only_line) {
  const Outcome outcome = pelage(folder, command);
  EXPECT_EQ(outcome.code, bad.code) << command << "\n" << outcome.err;
  const std::string line = last_line(outcome.err);
  EXPECT_EQ(line.rfind("pelage: ", 0), 0u) << command << "\n" << outcome.err;
  EXPECT_NE(line.find(bad.expected), std::string::npos) << command << "\n" << outcome.err;
  EXPECT_EQ(outcome.out, "") << command;
  if (only_line) {
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command << "\n" << outcome.err;
  }
}

TEST(BadInput, Usage) {
  const Folder folder;
  for (const Bad& bad : usage) expect(folder, bad, bad.arguments, true);
}

TEST(BadInput, Scenes) {
  const Folder folder;
  folder.write("binary.toml", std::string("\x7f\x45\x4c\x46\0\1\2\3", 8));
  folder.write("half.toml", "[fur]\nlength = ");
  folder.write("twice.toml", "model = 'torus'\nmodel = 'cow'\n");
  folder.write("typo.toml", "[fur]\nlenght = 0.1\n");
  folder.write("type.toml", "fur.layers = '16'\n");
  folder.write("deep.toml", "a = " + std::string(100000, '['));
  folder.write("nan.toml", "fur.tile = nan\n");
  for (const Bad& bad : scenes) expect(folder, bad, bad.arguments, true);
}

TEST(BadInput, ADryRunReadsTheMesh) {
  const Folder folder;
  folder.write("broken.obj", "this is no mesh\n");
  expect(folder, {"", 2, "broken.obj: the file contains no faces"},
         "run silva2010-table1 --model broken.obj --dry-run", false);
}

TEST(BadInput, Meshes) {
  const Folder folder;
  folder.write("text.obj", "this is no mesh\n");
  folder.write("empty.off", "OFF\n0 0 0\n");
  folder.write("truncated.off", "OFF\n8 12 0\n0 0 0\n1 0 0\n");
  folder.write("infinite.off",
               "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 inf\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  folder.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 1 1\n2 2 2\n3 0 1 2\n");
  folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  for (const char* name : {"text.ply", "text.stl", "text.3ds", "text.gltf", "text.xyz"})
    folder.write(name, "no mesh\n");
  folder.write(
      "huge.ply",
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float "
      "y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Bad& bad : meshes) {
    expect(folder, bad, std::string("render -o a.png --pipeline reference --size 16x16 ") + bad.arguments,
           false);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.png"));
  }
}

/// Writes the first half of a valid PNG, TIFF and OpenEXR file, and the header of a JPEG file.
void write_halves(const Folder& folder) {
  Picture noise{64, 64, {}};
  for (unsigned i = 0, state = 1; i < 64 * 64; ++i) {
    const auto next = [&] {
      return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
    };
    noise.pixel.emplace_back(next(), next(), next(), 1.0f);
  }
  for (const char* name : {"half.png", "half.tif", "half.exr"}) {
    write_picture(folder.path() / name, noise);
    const std::string bytes = folder.read(name);
    folder.write(name, bytes.substr(0, bytes.size() / 2));
  }
  folder.write("half.jpg",
               std::string("\xff\xd8\xff\xe0\x00\x10JFIF\x00\x01\x01\x00\x00\x01\x00\x01\x00\x00", 20));
}

TEST(BadInput, Images) {
  const Folder folder;
  write_halves(folder);
  folder.write("text.png", "this is no picture\n");
  folder.write("text.gif", "this is no picture\n");
  // The header of this file declares 2,000,000 x 2,000,000 pixels, but the file contains no pixels.
  folder.write(
      "huge.png",
      std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x1e\x84\x80\0\x1e\x84\x80\x08\x02\0\0\0\x1f\x4e\x5f\x5f",
                  33) +
          std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
  for (const Bad& bad : images) {
    expect(
        folder, bad,
        std::string("render -o a.png --pipeline reference --model torus --size 16x16 --set fur.layers=2 ") +
            bad.arguments,
        false);
  }
}

TEST(BadInput, TheModuleOfImageFilesIsMissedOnlyWhereItIsNeeded) {
  const Folder folder;
  write_picture(folder.path() / "coat.png", Picture{1, 1, {{1, 1, 1, 1}}});
  std::filesystem::copy_file(PELAGE_BINARY, folder.path() / "alone");
  const std::string small = "render --pipeline reference --model torus --size 16x16 --set fur.layers=2 ";
  const auto alone = [&](const std::string& more) { return pelage(folder, small + more, "", "./alone"); };
  EXPECT_EQ(alone("-o a.png").code, 0);
  for (const char* needy : {"-o a.exr", "-o a.tif", "-o a.png --set coat.image=coat.png"}) {
    const Outcome outcome = alone(needy);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("pelage: pelage_image_module.so is missing"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_NE(alone("-o a.exr --set fur.layers=0").err.find("is missing"), std::string::npos)
      << "before anything else is done";
  folder.write("pelage_image_module.so", "not a library");
  const Outcome broken = alone("-o a.exr");
  EXPECT_EQ(broken.code, 2);
  EXPECT_NE(broken.err.find("pelage: the image module cannot be loaded: "), std::string::npos) << broken.err;
}

TEST(BadInput, Outputs) {
  const Folder folder;
  std::filesystem::create_directory(folder.path() / "folder.png");
  for (const Bad& bad : outputs) {
    expect(folder, bad,
           std::string("render --pipeline reference --model torus --size 16x16 --set fur.layers=2 ") +
               bad.arguments,
           false);
  }
  const Outcome full = pelage(folder, "scene >/dev/full");
  EXPECT_EQ(full.code, 2);
  EXPECT_EQ(full.err, "pelage: standard output cannot be written\n");
}

TEST(BadInput, NoDevice) {
  const Folder folder;
  for (const char* command : {"render -o a.png --model torus", "check", "devices"}) {
    const Outcome outcome = pelage(folder, command, "OCL_ICD_VENDORS=" + folder.path().string());
    EXPECT_EQ(outcome.code, 3) << command << "\n" << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("pelage: ", 0), 0u) << outcome.err;
  }
}

TEST(BadInput, ThereAreEnoughCases) {
  EXPECT_GE(std::size(usage) + std::size(scenes) + std::size(meshes) + std::size(images) + std::size(outputs),
            70u);
}

}  // namespace
}  // namespace pelage::cli
