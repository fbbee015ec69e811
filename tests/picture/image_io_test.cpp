// Tests that a picture keeps its pixels, within the precision of the format, if it is written to a file and
// read again. Also tests that a failed write leaves no incomplete file.
#include "harness/picture/image_io.hpp"

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>

#include "harness/atomic_file.hpp"
#include "harness/error.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

struct ImageIo : test::InFolder {
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(place), fs::directory_iterator()));
  }
  const fs::path& place = folder.path;
};

Picture gradient(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.pixel.emplace_back(float(x) / float(width), float(y) / float(height), float(x * y % 7) / 7.0f,
                                 float(x + y) / float(width + height));
    }
  }
  return picture;
}

TEST_F(ImageIo, FloatFormatsKeepEveryBit) {
  Picture picture = gradient(37, 23);
  picture.at(3, 4) = {-0.25f, 7.5f, 1e-20f, 0.0f};  // values must not be clamped or premultiplied
  for (const char* name : {"a.exr", "a.tif", "a.TIFF"}) {
    write_picture(place / name, picture);
    const Picture again = read_picture(place / name);
    ASSERT_EQ(again.width, 37);
    ASSERT_EQ(again.height, 23);
    EXPECT_EQ(again.pixel, picture.pixel) << name;
  }
}

TEST_F(ImageIo, PngRoundsToTheNearestByteAndClamps) {
  Picture picture = gradient(256, 2);
  picture.at(0, 1) = {-1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f};
  picture.at(1, 1) = {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), 0.5f,
                      1.0f};
  write_picture(place / "a.png", picture);
  const Picture again = read_picture(place / "a.png");
  for (int x = 0; x < 256; ++x) {
    EXPECT_LE(std::abs(again.at(x, 0).x - picture.at(x, 0).x), 0.5f / 255.0f + 1e-6f);
    EXPECT_EQ(again.at(x, 0).w, 1.0f);
  }
  EXPECT_EQ(again.at(0, 1), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(again.at(1, 1), glm::vec4(1, 0, 128.0f / 255.0f, 1));
}

// A PNG file must contain the header (8-bit RGB, not interlaced) and the chunk sRGB. It must also contain the
// chunks gAMA and cHRM (gamma and primaries) for viewers that do not know the chunk sRGB.
TEST_F(ImageIo, PngSaysThatItIsSrgb) {
  using namespace std::string_literals;
  write_picture(place / "a.png", gradient(3, 2));
  const std::string bytes = folder.read("a.png");
  EXPECT_EQ(bytes.substr(12, 17), "IHDR\0\0\0\3\0\0\0\2\x08\2\0\0\0"s);
  test::expect_has(bytes, {"gAMA\0\0\xb1\x8f"s, "sRGB\3"s, "cHRM\0\0\x7a\x26\0\0\x80\x84"s});
}

TEST_F(ImageIo, TopRowIsFirst) {
  Picture picture{2, 2, {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}}};
  for (const char* name : {"a.png", "a.exr", "a.tif"}) {
    write_picture(place / name, picture);
    EXPECT_EQ(read_picture(place / name).pixel, picture.pixel) << name;
  }
}

TEST_F(ImageIo, AFailedWriteLeavesWhatWasThere) {
  const fs::path file = place / "kept.txt";
  std::ofstream(file) << "before";
  EXPECT_THROW(write_atomically(file,
                                [](const fs::path& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw InputError("the disk is full");
                                }),
               InputError);
  EXPECT_EQ(test::text_of(file), "before");
  EXPECT_EQ(files(), 1u);
  EXPECT_THROW(write_picture("/dev/full/a.png", gradient(2, 2)), InputError);
  EXPECT_THROW(write_picture(place / "none/a.png", gradient(2, 2)), InputError);
  EXPECT_THROW(write_picture(place / "a.gif", gradient(2, 2)), InputError);
  EXPECT_THROW(write_picture(place / "a.png", Picture{}), InputError);
  EXPECT_THROW(write_picture(place / "a.png", Picture{2, 2, {}}), InputError);
  EXPECT_EQ(files(), 1u);
}

TEST_F(ImageIo, AFullDiskIsNamed) {
  // The test limits the size of files to 64 bytes and ignores the signal SIGXFSZ. A write beyond the limit
  // then fails like a write to a full disk.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{64, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = test::refusal([&] { write_picture(place / "a.png", gradient(64, 64)); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(said, (place / "a.png").string() + ": cannot be written: File too large");
  EXPECT_EQ(files(), 0u);
}

TEST_F(ImageIo, NothingReadsAnyPrefixOfAPictureAsAPicture) {
  const Picture picture = gradient(20, 20);
  for (const char* name : {"a.png", "a.exr", "a.tif"}) {
    write_picture(place / name, picture);
    const std::string bytes = folder.read(name);
    for (std::size_t size = 0; size + 1 < bytes.size(); size += 1 + size / 16) {
      const fs::path cut = place / (std::string("cut") + name);
      std::ofstream(cut, std::ios::binary) << bytes.substr(0, size);
      try {
        // A truncation that removes only data after the pixels may pass without an error. A truncation that
        // removes pixels must cause an error.
        EXPECT_EQ(read_picture(cut).pixel, read_picture(place / name).pixel) << name << " cut at " << size;
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  }
}

// These inputs were found with libFuzzer. In the calling process, each of them would crash the decoder or
// would make it allocate gigabytes. AddressSanitizer removes the memory limit of the child process and
// reports the crash itself.
TEST_F(ImageIo, ACrashOfTheDecoderIsAnError) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PELAGE_SOURCE_DIR) / "tests/picture/damaged")) {
    ++count;
    const std::string said = test::refusal([&] { read_picture(entry.path()); });
    EXPECT_EQ(said.rfind(entry.path().string() + ": ", 0), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  EXPECT_EQ(count, 3u);
}

TEST_F(ImageIo, DamagedBytesNeverCrash) {
  const Picture picture = gradient(20, 20);
  unsigned state = 1;
  int refused = 0;
  for (const char* name : {"a.png", "a.exr", "a.tif"}) {
    write_picture(place / name, picture);
    const std::string bytes = folder.read(name);
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::string damaged = bytes;
      for (int hit = 0; hit < 4; ++hit) {
        state = state * 1664525u + 1013904223u;
        damaged[(state >> 8) % damaged.size()] = static_cast<char>(state >> 24);
      }
      const fs::path file = place / (std::string("bad") + name);
      std::ofstream(file, std::ios::binary) << damaged;
      try {
        const Picture read = read_picture(file);
        EXPECT_EQ(read.pixel.size(), std::size_t(read.width) * std::size_t(read.height));
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 0);
}

/// A picture of tests/picture/strangers, which other programs wrote.
Picture stranger(const std::string& name) {
  return read_picture(fs::path(PELAGE_SOURCE_DIR) / "tests/picture/strangers" / name);
}

/// The largest difference of a colour, without alpha.
float colour_difference(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  float largest = 0;
  for (std::size_t i = 0; i < a.pixel.size() && i < b.pixel.size(); ++i)
    for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a.pixel[i][c] - b.pixel[i][c]));
  return largest;
}

TEST(Strangers, ColoursAreAsStoredWhateverAlphaAndGammaAre) {
  for (const char* name :
       {"rgba255.png", "rgba-alpha.png", "rgba-alpha0.png", "rgba-alpha-gama.png", "gama1.png"})
    EXPECT_EQ(colour_difference(stranger(name), stranger("rgb.png")), 0) << name;
  EXPECT_LE(colour_difference(stranger("rgb16.png"), stranger("rgb.png")), 1 / 255.0f);
  EXPECT_EQ(colour_difference(stranger("map-la.png"), stranger("map.png")), 0);
  EXPECT_EQ(colour_difference(stranger("map-la-opaque.png"), stranger("map.png")), 0);
}

/// Returns the picture whose pixel (x, y) is at(x, y).
template <class At>
Picture rearranged(const Picture& picture, const At& at) {
  Picture result = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) result.at(x, y) = at(x, y);
  return result;
}

// The files store the pixels of rgb.png. exif6.jpg is turned clockwise and orient4.tif is upside down;
// crop.exr has only the middle of the picture.
TEST(Strangers, WindowsArePlacedAndOrientationsApplied) {
  const Picture rgb = stranger("rgb.png"), full = stranger("full.exr");
  ASSERT_EQ(rgb.width, 64);
  const Picture turned = rearranged(rgb, [&](int x, int y) { return rgb.at(y, 63 - x); });
  EXPECT_LT(colour_difference(stranger("exif6.jpg"), turned), 0.05f);
  const Picture upside_down = rearranged(rgb, [&](int x, int y) { return rgb.at(x, 63 - y); });
  EXPECT_EQ(colour_difference(stranger("orient4.tif"), upside_down), 0);
  const auto inside = [](int i) { return i >= 16 && i < 48; };
  const Picture middle =
      rearranged(full, [&](int x, int y) { return inside(x) && inside(y) ? full.at(x, y) : glm::vec4(0); });
  EXPECT_EQ(colour_difference(stranger("crop.exr"), middle), 0);
}

// Orientation 5 is that of the transposed picture, 7 that of the picture transposed at the other diagonal.
TEST(Strangers, TransposedPicturesAreTransposedAgain) {
  const test::Folder folder;
  const std::string five("\x12\x01\x03\0\x01\0\0\0\x05", 9);  // the entry Orientation of the TIFF file
  const auto with = [&](char orientation) {
    std::string bytes =
        test::text_of(fs::path(PELAGE_SOURCE_DIR) / "tests/picture/strangers/orientation5.tif");
    const std::size_t place = bytes.find(five);
    EXPECT_NE(place, std::string::npos);
    bytes[place + five.size() - 1] = orientation;
    return read_picture(folder.write("turned.tif", bytes));
  };
  const Picture stored = with(1), five_turned = with(5), seven_turned = with(7);
  EXPECT_EQ(five_turned.width, stored.height);
  EXPECT_EQ(
      colour_difference(five_turned, rearranged(five_turned, [&](int x, int y) { return stored.at(y, x); })),
      0);
  EXPECT_EQ(colour_difference(seven_turned, rearranged(seven_turned,
                                                       [&](int x, int y) {
                                                         return stored.at(stored.width - 1 - y,
                                                                          stored.height - 1 - x);
                                                       })),
            0);
}

// The file has the channels B, G, R, Z, id and left.R.
TEST(Strangers, ExrChannelsAreChosenByTheirNames) {
  const Picture found = stranger("channels.exr");
  EXPECT_EQ(found.at(0, 0), glm::vec4(0.984375f, 0.25f, 0.375f, 1));
  EXPECT_EQ(found.at(3, 0), glm::vec4(0.4375f, 0.9375f, 0.53125f, 1));
}

TEST(Strangers, BytesAfterAJpegAreIgnoredAndMissingOnesAreNot) {
  EXPECT_EQ(colour_difference(stranger("trail.jpg"), stranger("rgb.jpg")), 0);
  const test::Folder folder;
  const fs::path from = fs::path(PELAGE_SOURCE_DIR) / "tests/picture/strangers";
  for (const char* name : {"rgb.jpg", "progressive.jpg", "rgb.png"}) {
    std::ifstream stream(from / name, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    bytes.resize(bytes.size() - 2);
    folder.write(name, bytes);
    test::expect_has(test::refusal([&] { read_picture(folder.path / name); }),
                     "the file ends before the end");
  }
}

/// Returns a picture in which the red value of each pixel is its column and the green value is its row.
Picture ramp(int width, int height) {
  Picture picture{width, height, std::vector<glm::vec4>(std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y) = {float(x), float(y), 1, 1};
  return picture;
}

TEST(Reduce, AWholeFactorAveragesBlocks) {
  const Picture small = reduced(ramp(8, 4), 4);
  ASSERT_EQ(small.width, 4);
  ASSERT_EQ(small.height, 2);
  EXPECT_FLOAT_EQ(small.at(0, 0).x, 0.5f);
  EXPECT_FLOAT_EQ(small.at(3, 1).x, 6.5f);
  EXPECT_FLOAT_EQ(small.at(3, 1).y, 2.5f);
  EXPECT_FLOAT_EQ(small.at(2, 0).z, 1.0f);
}

TEST(Reduce, AnyFactorKeepsTheMean) {
  const Picture full = ramp(37, 23), small = reduced(full, 10);
  ASSERT_EQ(small.height, 6);
  const auto mean = [](const Picture& picture) {
    const glm::vec4 sum = std::accumulate(picture.pixel.begin(), picture.pixel.end(), glm::vec4(0));
    return sum / float(picture.pixel.size());
  };
  EXPECT_NEAR(mean(small).x, mean(full).x, 1e-4);
  EXPECT_NEAR(mean(small).y, mean(full).y, 1e-4);
  EXPECT_NEAR(mean(small).w, 1, 1e-5);
}

TEST(Reduce, ASmallPictureIsUnchanged) {
  EXPECT_EQ(reduced(ramp(5, 3), 5).pixel, ramp(5, 3).pixel);
}

TEST(Reduce, OneRowRemains) {
  EXPECT_EQ(reduced(ramp(1000, 1), 10).height, 1);
}

TEST(Reduce, WebpHasItsSignature) {
  Picture picture = ramp(16, 8);
  for (glm::vec4& pixel : picture.pixel) pixel *= 0.05f;
  const std::string bytes = webp_of(picture, 80);
  ASSERT_GT(bytes.size(), 20u);
  EXPECT_EQ(bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(bytes.substr(8, 4), "WEBP");
  EXPECT_LT(bytes.size(), webp_of(picture, 100).size() + 1);
}

}  // namespace
}  // namespace pelage
