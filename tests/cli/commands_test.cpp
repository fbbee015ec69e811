// Tests the commands of pelage with valid input.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "harness/compare/metrics.hpp"
#include "harness/picture/image_io.hpp"
#include "tests/cli/shell.hpp"

namespace pelage::cli {
namespace {

TEST(Commands, HelpAndVersionGoToStdout) {
  const Folder folder;
  const Outcome help = pelage(folder, "--help");
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* command : {"devices", "scene", "render", "check"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    const Outcome one = pelage(folder, std::string(command) + " --help");
    EXPECT_EQ(one.code, 0);
    EXPECT_NE(one.out.find("Usage: pelage " + std::string(command)), std::string::npos) << one.out;
  }
  const Outcome version = pelage(folder, "--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_NE(version.out.find("cite"), std::string::npos);
}

TEST(Commands, ThePrintedSceneReadsBackToItself) {
  const Folder folder;
  const Outcome first = pelage(folder, "scene --set fur.layers=16 --set shading.model=wet --set model=torus");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "");
  folder.write("written.toml", first.out);
  const Outcome second = pelage(folder, "scene written.toml");
  EXPECT_EQ(second.out, first.out);
  EXPECT_NE(second.out.find("\nlayers = 16 "), std::string::npos);
}

/// An HDF5 dataset, converted to floats, with its shape and units.
struct Dataset {
  std::vector<hsize_t> shape;
  std::vector<float> values;
  std::string units;
};

Dataset read(hid_t file, const char* name) {
  Dataset data;
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  if (set < 0) return data;
  const hid_t space = H5Dget_space(set);
  data.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, data.shape.data(), nullptr);
  data.values.resize(
      std::accumulate(data.shape.begin(), data.shape.end(), std::size_t{1}, std::multiplies<>()));
  H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.values.data());
  const hid_t attribute = H5Aopen(set, "units", H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  data.units.resize(H5Tget_size(type));
  H5Aread(attribute, type, data.units.data());
  H5Tclose(type);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Dclose(set);
  return data;
}

float distance(const std::vector<float>& a, std::size_t i, const std::vector<float>& b, std::size_t j) {
  return std::hypot(a[3 * i] - b[3 * j], a[3 * i + 1] - b[3 * j + 1], a[3 * i + 2] - b[3 * j + 2]);
}

using Shape = std::vector<hsize_t>;

TEST(Commands, AnExampleSceneHasAName) {
  const Folder folder;
  const std::string by_path = pelage(folder, "scene '" PELAGE_SOURCE_DIR "/examples/wet-curls.toml'").out;
  EXPECT_NE(by_path.find("[fur]"), std::string::npos);
  for (const char* name : {"wet-curls", "wet-curls.toml"})
    EXPECT_EQ(pelage(folder, std::string("scene ") + name).out, by_path) << name;
  const Outcome turned = pelage(folder, "scene wet-curls --model mine.obj --up z");
  EXPECT_NE(turned.out.find("/mine.obj\""), std::string::npos) << turned.err;
  EXPECT_NE(turned.out.find("up = \"z\""), std::string::npos) << turned.err;
  folder.write("wet-curls", "fur.layers = 7\n");
  EXPECT_NE(pelage(folder, "scene wet-curls").out.find("layers = 7"), std::string::npos)
      << "a file of the user comes before an example";
}

TEST(Commands, TheDumpHoldsAFrameThatFitsTogether) {
  const Folder folder;
  const Outcome outcome = pelage(
      folder,
      "render --model torus --pipeline reference --size 40x30 --set fur.layers=4 --set fur.texture=32 --set "
      "wetness.random=50 --set dynamics.gravity=[0,-9,0] --set dynamics.time=0.2 -o image.exr --dump "
      "frame.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const hid_t file = H5Fopen((folder.path() / "frame.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  for (const char* name :
       {"mesh/position", "mesh/triangle", "mesh/uv", "mesh/normal", "strand/root", "strand/rest",
        "strand/tip", "mask", "fur", "colour", "layer/offset", "camera/view", "camera/projection", "image"}) {
    const Dataset data = read(file, name);
    EXPECT_FALSE(data.values.empty()) << name;
    EXPECT_FALSE(data.units.empty()) << name;
    for (const float value : data.values) ASSERT_TRUE(std::isfinite(value)) << name;
  }
  const Dataset position = read(file, "mesh/position"), triangle = read(file, "mesh/triangle");
  const hsize_t vertices = position.shape[0], faces = 9360;
  EXPECT_EQ(triangle.shape, (Shape{faces, 3}));
  EXPECT_EQ(read(file, "mask").shape, (Shape{256, 256, 4}));
  EXPECT_EQ(read(file, "fur").shape, (Shape{4, 32, 32, 2}));
  EXPECT_EQ(read(file, "fur_mip/1").shape, (Shape{4, 16, 16, 2}));
  const Dataset offset = read(file, "layer/offset");
  EXPECT_EQ(offset.shape, (Shape{4, vertices, 3}));

  // The distance from a root to its tip must be at most the length of the strand. Gravity must have moved
  // some tips.
  const Dataset root = read(file, "strand/root"), rest = read(file, "strand/rest"),
                tip = read(file, "strand/tip");
  float moved = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    EXPECT_NEAR(distance(rest.values, f, root.values, f), 0.09f, 1e-5f);
    EXPECT_LE(distance(tip.values, f, root.values, f), 0.09f + 1e-5f);
    moved = std::max(moved, distance(tip.values, f, rest.values, f));
  }
  EXPECT_GT(moved, 0.005f);

  // A strand's tip offset is its tip minus its root. Each triangle has one strand. Without curl, the offset
  // of the uppermost layer at a surface point is a weighted mean of tip offsets. The mean is over the
  // triangles around the point, and the weights are the areas of the triangles. All vertices at one surface
  // point have bitwise equal positions.
  std::map<std::array<float, 3>, std::array<double, 4>> mean;
  const auto point = [&](std::size_t v) {
    return std::array{position.values[3 * v], position.values[3 * v + 1], position.values[3 * v + 2]};
  };
  for (std::size_t f = 0; f < faces; ++f) {
    std::array<std::size_t, 3> corner{};
    double a[3], b[3];
    for (std::size_t c = 0; c < 3; ++c) corner[c] = static_cast<std::size_t>(triangle.values[3 * f + c]);
    for (std::size_t c = 0; c < 3; ++c) {
      a[c] = double(position.values[3 * corner[1] + c]) - double(position.values[3 * corner[0] + c]);
      b[c] = double(position.values[3 * corner[2] + c]) - double(position.values[3 * corner[0] + c]);
    }
    const double area =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    for (const std::size_t v : corner) {
      auto& sum = mean[point(v)];
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += area * (double(tip.values[3 * f + c]) - double(root.values[3 * f + c]));
      sum[3] += area;
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto& sum = mean.at(point(v));
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(double(offset.values[(3 * vertices + v) * 3 + c]), sum[c] / sum[3], 1e-6);
    }
  }

  // All vertices must be in front of the camera. In the screen coordinates, the picture extends from -1 to 1
  // along x and along y. The means of the vertices' x and y must be between -4 and 4.
  const Dataset view = read(file, "camera/view"), projection = read(file, "camera/projection");
  double x = 0, y = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    double eye[4], screen[4];
    const float* p = &position.values[3 * v];
    for (std::size_t r = 0; r < 4; ++r) {
      eye[r] = double(view.values[4 * r + 3]);
      for (std::size_t c = 0; c < 3; ++c) eye[r] += double(view.values[4 * r + c]) * double(p[c]);
    }
    for (std::size_t r = 0; r < 4; ++r) {
      screen[r] = 0;
      for (std::size_t c = 0; c < 4; ++c) screen[r] += double(projection.values[4 * r + c]) * eye[c];
    }
    ASSERT_GT(screen[3], 0);
    x += screen[0] / screen[3] / double(vertices);
    y += screen[1] / screen[3] / double(vertices);
  }
  EXPECT_LT(std::abs(x), 4);
  EXPECT_LT(std::abs(y), 4);

  // The dataset "image" is equal to the picture that the same command wrote.
  const Dataset image = read(file, "image");
  EXPECT_EQ(image.shape, (Shape{30, 40, 4}));
  const Picture picture = read_picture(folder.path() / "image.exr");
  for (std::size_t i = 0; i < picture.pixel.size(); ++i) {
    for (int c = 0; c < 4; ++c) ASSERT_EQ(image.values[4 * i + std::size_t(c)], picture.pixel[i][c]);
  }
  H5Fclose(file);
}

TEST(Commands, ShellsAndReferenceDrawTheSamePicture) {
  const Folder folder;
  const std::string scene =
      "render --model torus --size 80x60 --set fur.layers=8 --set curl.radius=0.02 --set curl.turns=2 ";
  for (const char* rest :
       {"-o tile.exr", "-o pixel.exr --mapping pixel", "-o reference.exr --pipeline reference",
        "-o eight.exr --pipeline reference --reference-bits 8"}) {
    const Outcome outcome = pelage(folder, scene + rest);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  const Picture reference = read_picture(folder.path() / "reference.exr");
  for (const char* name : {"tile.exr", "pixel.exr"}) {
    EXPECT_TRUE(within(compare(read_picture(folder.path() / name), reference))) << name;
  }
  const Agreement eight = compare(read_picture(folder.path() / "eight.exr"), reference);
  EXPECT_GT(eight.worst, 0.0) << "rounding to 8 bits changed nothing";
  EXPECT_GT(eight.psnr, 30.0);
}

TEST(Commands, ListNamesThePaperAndItsTableWhereThereIsOne) {
  const Folder folder;
  const Outcome outcome = pelage(folder, "list");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("(silva2010-curling-clumping, Table 1)\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("(banisch2006-grass-and-fur)\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find(", )"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("(, "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("()"), std::string::npos) << outcome.out;
}

TEST(Commands, ARowSaysHowManyPixelsAreFlipped) {
  const Folder folder;
  const Outcome run = pelage(folder, "run silva2010-table1 --preset smoke --filter torus-16 -o out");
  ASSERT_EQ(run.code, 0) << run.err;
  std::string rows;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "out"))
    if (entry.path().extension() == ".jsonl")
      rows = folder.read(std::filesystem::relative(entry.path(), folder.path()).string());
  EXPECT_NE(rows.find(R"({"against":"reference","metric":"flips","value":)"), std::string::npos) << rows;
  for (const char* metric : {R"("flips":{"value":)", R"("psnr_without_flips":{"value":)",
                             R"("windows_flips":{"value":)", R"("windows_psnr":{"value":)"})
    EXPECT_NE(rows.find(metric), std::string::npos) << rows;
}

TEST(Commands, CheckComparesOneStage) {
  const Folder folder;
  const Outcome outcome = pelage(folder, "check simulate mask --filter torus");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("simulate"), std::string::npos);
  EXPECT_NE(outcome.out.find("mask"), std::string::npos);
  EXPECT_EQ(outcome.out.find("picture"), std::string::npos);
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos);
}

TEST(Commands, CheckDrawsFirstWithTheDefaultMappingOfTheDevice) {
  // The check names the mapping of each comparison of pictures. A device with one lane per work-item must not
  // be asked for the mapping `tile`.
  const Folder folder;
  const Outcome all = pelage(folder, "check picture mappings --filter 'torus.*curly'", "PELAGE_LANES=1");
  EXPECT_EQ(all.code, 0) << all.out << all.err;
  const auto group = all.out.find(", group"), pixel = all.out.find(", pixel");
  EXPECT_LT(group, pixel) << all.out;
  EXPECT_NE(pixel, std::string::npos) << all.out;
  EXPECT_EQ(all.out.find("tile"), std::string::npos) << all.out;
  const Outcome one =
      pelage(folder, "check picture --mapping pixel --filter 'torus.*curly'", "PELAGE_LANES=1");
  EXPECT_EQ(one.code, 0) << one.out << one.err;
  EXPECT_NE(one.out.find(", pixel"), std::string::npos) << one.out;
  EXPECT_EQ(one.out.find("group"), std::string::npos) << one.out;
  const Outcome tile = pelage(folder, "check picture --mapping tile", "PELAGE_LANES=1");
  EXPECT_EQ(tile.code, 2) << tile.out << tile.err;
  EXPECT_NE(tile.err.find("mapping 'tile': on "), std::string::npos) << tile.err;
}

TEST(Commands, CheckFailsOnKernelsThatAreWrong) {
  const Folder folder;
  std::filesystem::copy(std::filesystem::path(PELAGE_SOURCE_DIR) / "kernels", folder.path() / "kernels",
                        std::filesystem::copy_options::recursive);
  // The test inserts a mistake into a copy of the kernels: it halves the wetness of all droplets.
  std::string text = folder.read("kernels/wet/equations.clh");
  const std::string right = ": drop.wetness;";
  const auto place = text.find(right);
  ASSERT_NE(place, std::string::npos);
  folder.write("kernels/wet/equations.clh",
               text.substr(0, place) + ": 0.5f * drop.wetness;" + text.substr(place + right.size()));
  const Outcome outcome = pelage(folder, "--kernels kernels check mask --filter 'torus.*wet'");
  EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("FAILED"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace pelage::cli
