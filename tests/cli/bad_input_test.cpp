// Tests that invalid input gives the right exit code and one clear line on stderr, without a crash or a hang.
// The tests also run under the sanitizers, whose reports change the exit code.
#include <vector>

#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

using Bad = std::pair<const char*, const char*>;  ///< arguments, and a text of the message

const std::vector<Bad> usage = {
    {"", "give a command; `pelage --help` lists them"},
    {"fly", "fly"},
    {"--fly", "--fly"},
    {"scene --fly", "--fly"},
    {"scene a.toml b.toml", "b.toml"},
    {"--kernels", "--kernels"},
    {"--kernels nowhere scene", "--kernels nowhere"},
    {"render", "--output"},
    {"render -o", "--output"},
    {"render -o a.png --size 0x0", "--size: image.width: 0 is out of range; give 1 to 16384 pixels"},
    {"render -o a.png --size 800", "--size 800: give width x height"},
    {"render -o a.png --size 800x", "--size 800x: give width x height"},
    {"render -o a.png --size -8x6", "--size -8x6: give width x height"},
    {"render -o a.png --size 8e2x6e2", "give width x height"},
    {"render -o a.png --size 16384x16384", "268435456 pixels; give at most"},
    {"render -o a.png --size 99999999999999999999x1", "give width x height"},
    {"render -o a.png --set fur.layers=1", "--set: fur.layers: 1 is out of range; give 2 to 512"},
    {"render -o a.png --set", "--set"},
    {"render -o a.png --pipeline magic", "--pipeline"},
    {"render -o a.png --mapping magic", "--mapping"},
    {"render -o a.png --reference-bits 7", "--reference-bits"},
    {"render -o a.png --reference-bits 8 --pipeline shells", "add --pipeline reference"},
    {"render -o a.png --device 'no such device'", "no such device"},
    {"check fly", "fly"},
    {"check --filter '('", "--filter (: this is not a valid regular expression"},
    {"check --filter zebra", "--filter zebra: no case has a name that matches"},
    {"check --device 'no such device'", "no such device"},
    {"scene --set fur.layers=\"'\na\n'\"", "fur.layers"},
    {"tune raster", "the stages with tuning axes are rasterize"},
    {"water rain --to -1", "--to"},
    {"water rain --fps 0", "--fps"},
    {"water rain --to 3600 --fps 1000", "3600000 lines; give at most 1000000"},
    {"water nothing", "nothing: there is no such scene file"},
    {"water rain --set wetness.end=1 --set wetness.begin=2", "wetness."},
    {"water rain --set wetness.random=0", "wetness"},
    {"water rain --csv water.png", "water.png: the account of the water is a table"},
};

const std::vector<Bad> scenes = {
    {"scene --set wetness.text=\"' '\" --set wetness.random=9", "wetness.text: has no visible character"},
    {"scene --set wetness.text=caf\xc3\xa9 --set wetness.random=9",
     "wetness.text: byte 4 is not a printable ASCII character"},
    {"scene --set wetness.text=A", "wetness.text: has no effect without random droplets"},
    {"scene wet --case a", "there is no experiment 'wet'"},
    {"scene --case a", "--case a: give also an experiment"},
    {"scene silva2010-fig01 --case dri-640x480", "has no such case; did you mean dry-640x480?"},
    {"diagram mask", "diagram mask: is a picture; give a file with -o, such as mask.png"},
    {"diagram clump -o a.png", "a.png: diagram clump is a table"},
    {"diagram fly", "fly"},
    {"diagram curl -o nowhere/a.csv", "nowhere"},
    {"scene missing.toml", "missing.toml: there is no such scene file"},
    {"scene wet-curlz", "(examples: contact, dry, elephant, figures, grass, grass-closing,"},
    {"scene nowhere/wet.toml", "nowhere/wet.toml: there is no such scene file"},
    {"run typo.toml -o r", "typo.toml: is not an experiment, because it has neither a name nor axes"},
    {"run silva2010-table1 --model gone.obj --dry-run", "gone.obj: neither a file nor a model"},
    {"run silva2010-table1 --up x --dry-run", "--up"},
    {"render text.obj -o a.png", "text.obj: is a mesh file; give a scene and the mesh"},
    {"scene .", ".: is a folder"},
    {"scene binary.toml", "binary.toml:1: not TOML"},
    {"scene typo.toml", "typo.toml:2: fur.lenght: no such key; did you mean fur.length?"},
    {"scene deep.toml", "deep.toml:1: not TOML"},
    {"scene /dev/zero", "is larger than a scene file may be"},
    {"render -o a.png nan.toml", "nan.toml:1: fur.tile: nan is not a finite number"},
};

const std::vector<Bad> models = {
    {"run silva2010-table1 --model broken.obj --dry-run", "broken.obj: the file contains no faces"},
    {"topology banisch-grass --draw grass.png", ".svg"},
    {"topology bunny --draw bunny.svg", "--faces 2000"},
    {"topology banisch-grass --draw nowhere/grass.svg", "does not exist"},
    {"topology banisch-grass --draw grass.svg --length 0", "--length"},
    {"topology no-such-model", "no-such-model"},
};

const std::vector<Bad> meshes = {
    {"--model nothing", "nothing"},   {"--model nothing.obj", "nothing.obj"}, {"--model .", "not a file"},
    {"--model text.obj", "text.obj"}, {"--model text.3ds", "text.3ds"},
};

const std::vector<Bad> images = {
    {"--set coat.image=missing.png", "missing.png: there is no such file"},
    {"--set coat.image=.", "not a file"},
    {"--set coat.image=text.png", "text.png: not a readable picture"},
    {"--set coat.image=half.jpg", "half.jpg: "},
    {"--set coat.image=huge.png", "huge.png: "},
    {"--set coat.image=large.png", "16384 x 16384 pixels; pelage reads pictures of at most 67108864 pixels"},
    {"--set coat.image=text.gif",
     "text.gif: pelage does not read this format; it reads PNG, JPEG, TIFF and EXR"},
    {"--set wetness.text=A --set wetness.random=10 --set wetness.text_font=missing.ttf",
     "missing.ttf: there is no such font file"},
    {"--set wetness.text=A --set wetness.random=10 --set wetness.text_font=text.png",
     "text.png: not a readable font; give a TrueType or OpenType file"},
    {"--set wetness.text=WWWWWW --set wetness.random=10 --set wetness.text_height=0.9",
     "leaves the unit square; give a smaller wetness.text_height"},
    {"--set wetness.image=missing.png --set wetness.random=10", "missing.png: there is no such file"},
};

const std::vector<Bad> outputs = {
    {"-o a.jpg", "a.jpg: a picture is written as .png, .exr or .tif"},
    {"-o a", "a: a picture is written as"},
    {"-o nowhere/a.png", "nowhere/a.png: cannot be written, because the folder 'nowhere' does not exist"},
    {"-o folder.png", "folder.png: cannot be written, because it is a folder"},
    {"-o /proc/a.png", "/proc/a.png: cannot be written"},
    {"-o /proc/a.exr", "/proc/a.exr: cannot be written"},
    {"-o a.png --dump a.txt", "a.txt: the name of a dump must end in .h5 or .hdf5"},
    {"-o a.png --dump nowhere/a.h5", "nowhere/a.h5: cannot be written"},
    {"-o a.png --dump /proc/a.h5", "/proc/a.h5: cannot be written"},
};

const std::string tiny_picture = "render --pipeline reference --model torus --size 16x16 --set fur.layers=2 ";

/// Expects that pelage refuses each of the inputs, which follow `command` (expect_refused).
void expect_all(const Folder& folder, const std::vector<Bad>& list, const std::string& command = "",
                bool steps = false) {
  for (const auto& [arguments, message] : list) {
    const Outcome outcome = pelage(folder, command + arguments);
    expect_refused(outcome, message, steps);
    EXPECT_EQ(outcome.out, "") << outcome.arguments;
  }
}

struct BadInput : InFolder {};

TEST_F(BadInput, Usage) {
  expect_all(folder, usage);
}

TEST_F(BadInput, Scenes) {
  folder.write("binary.toml", std::string("\x7f\x45\x4c\x46\0\1\2\3", 8));
  folder.write("typo.toml", "[fur]\nlenght = 0.1\n");
  folder.write("deep.toml", "a = " + std::string(100000, '['));
  folder.write("nan.toml", "fur.tile = nan\n");
  expect_all(folder, scenes);
}

TEST_F(BadInput, Models) {
  folder.write("broken.obj", "this is no mesh\n");
  expect_all(folder, models, "", true);
}

TEST_F(BadInput, Meshes) {
  folder.write("text.obj", "this is no mesh\n");
  folder.write("text.3ds", "no mesh\n");
  expect_all(folder, meshes, "render -o a.png --pipeline reference --size 16x16 ", true);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a.png"));
}

TEST_F(BadInput, Images) {
  folder.write("half.jpg",  // the header of a JPEG file
               std::string("\xff\xd8\xff\xe0\x00\x10JFIF\x00\x01\x01\x00\x00\x01\x00\x01\x00\x00", 20));
  folder.write("text.png", "this is no picture\n");
  folder.write("text.gif", "this is no picture\n");
  // The header of this file declares 2,000,000 x 2,000,000 pixels, but the file contains no pixels.
  folder.write(
      "huge.png",
      std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x1e\x84\x80\0\x1e\x84\x80\x08\x02\0\0\0\x1f\x4e\x5f\x5f",
                  33) +
          std::string("\0\0\0\0IEND\xae\x42\x60\x82", 12));
  // The header of a grey picture of 16384 x 16384 pixels, and the beginning of its pixels.
  folder.write(
      "large.png",
      std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x08\0\0\0\0\x8c\xa3\x4f\x58", 33) +
          std::string("\0\x04\x93\xe0IDAT", 8) + std::string(300'000, '\0'));
  expect_all(folder, images, tiny_picture + "-o a.png ", true);
}

TEST_F(BadInput, TheModuleOfImageFilesIsMissedOnlyWhereItIsNeeded) {
  write_picture(folder.path / "coat.png", Picture{1, 1, {{1, 1, 1, 1}}});
  std::filesystem::copy_file(PELAGE_BINARY, folder.path / "alone");
  const auto alone = [&](const std::string& more) { return pelage(tiny_picture + more, "", "./alone"); };
  EXPECT_EQ(alone("-o a.png").code, 0);
  for (const char* needy : {"-o a.exr", "-o a.tif", "-o a.png --set coat.image=coat.png"})
    expect_refused(alone(needy), "pelage: pelage_image_module.so is missing");
  expect_refused(alone("-o a.exr --set fur.layers=0"), "is missing");  // before anything else is done
  folder.write("pelage_image_module.so", "not a library");
  expect_refused(alone("-o a.exr"), "pelage: the image module cannot be loaded: ", true);
}

TEST_F(BadInput, Outputs) {
  std::filesystem::create_directory(folder.path / "folder.png");
  expect_all(folder, outputs, tiny_picture, true);
  expect_refused(pelage("scene >/dev/full"), "pelage: standard output cannot be written");
}

TEST_F(BadInput, NoDevice) {
  for (const char* command : {"render -o a.png --model torus", "check", "devices"})
    expect_refused(pelage(command, "OCL_ICD_VENDORS=" + folder.path.string()), "", false, 3);
}

}  // namespace
}  // namespace pelage::cli
