// Reads strands that are written here as the formats are described, and files that are not usable.
#include <gtest/gtest.h>

#include "harness/error.hpp"
#include "harness/mesh/read/polylines.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using test::put;

/// The header of a HAIR file.
struct HairText {
  std::uint32_t strands = 2, points = 5, arrays = 3, segments = 0;
  float width = 0, transparency = 0;
  std::vector<float> colour{0, 0, 0};

  /// The file with these arrays.
  std::string with(const std::vector<std::uint16_t>& counts,
                   const std::vector<std::vector<float>>& values) const {
    std::string bytes = "HAIR";
    for (const std::uint32_t number : {strands, points, arrays, segments}) put(bytes, number);
    for (const float number : {width, transparency, colour[0], colour[1], colour[2]}) put(bytes, number);
    bytes.resize(128, ' ');
    for (const std::uint16_t count : counts) put(bytes, count);
    for (const std::vector<float>& array : values)
      for (const float value : array) put(bytes, value);
    return bytes;
  }
};

const std::vector<float> five_points{0, 1, 0, 0, 1.5f, 0, 0, 2, 0, 1, 0, 0, 2, 0, 0};

Polylines hair(const std::string& bytes) {
  return parse_polylines(bytes, "hair", "fur.hair");
}

void expect_refusal(const std::string& bytes, const char* format, const std::string& message) {
  try {
    parse_polylines(bytes, format, "fur");
    ADD_FAILURE() << "not refused: " << message;
  } catch (const InputError& error) {
    test::expect_has(error.what(), message);
  }
}

TEST(Hair, HasItsStrands) {
  const Polylines lines = hair(HairText{}.with({2, 1}, {five_points}));
  EXPECT_EQ(lines.count, (std::vector<std::uint32_t>{3, 2}));
  ASSERT_EQ(lines.point.size(), 5u);
  EXPECT_EQ(lines.point[2], glm::vec3(0, 2, 0));
  EXPECT_EQ(lines.point[4], glm::vec3(2, 0, 0));
  EXPECT_TRUE(lines.width.empty());
  EXPECT_TRUE(lines.colour.empty());
  EXPECT_TRUE(lines.notes.empty());
}

TEST(Hair, HasItsArraysAndItsDefaults) {
  const std::vector<float> widths{1, 2, 3, 4, 5}, colours(15, 0.25f), clear(5, 0.0f), half(5, 0.5f);
  Polylines lines = hair(HairText{.arrays = 31}.with({2, 1}, {five_points, widths, half, colours}));
  EXPECT_EQ(lines.width, widths);
  ASSERT_EQ(lines.colour.size(), 5u);
  EXPECT_EQ(lines.colour[4], glm::vec3(0.25f));
  ASSERT_EQ(lines.notes.size(), 1u);
  test::expect_has(lines.notes[0], "transparencies are not used");
  EXPECT_TRUE(hair(HairText{.arrays = 31}.with({2, 1}, {five_points, widths, clear, colours})).notes.empty());
  lines = hair(HairText{.width = 0.5f, .colour = {1, 0.5f, 0}}.with({2, 1}, {five_points}));
  EXPECT_EQ(lines.width, std::vector<float>(5, 0.5f));
  EXPECT_EQ(lines.colour, std::vector<glm::vec3>(5, glm::vec3(1, 0.5f, 0)));
  EXPECT_EQ(hair(HairText{.segments = 0xffffffff}.with({2, 1}, {five_points})).count.size(), 2u);
  const std::vector<float> four(five_points.begin(), five_points.begin() + 12);
  lines = hair(HairText{.points = 4, .arrays = 2, .segments = 1}.with({}, {four}));
  EXPECT_EQ(lines.count, (std::vector<std::uint32_t>{2, 2}));
  lines = hair(HairText{}.with({2, 1}, {five_points, {0}}));
  ASSERT_EQ(lines.notes.size(), 1u);
  EXPECT_EQ(lines.notes[0], "4 bytes behind its end are not read");
}

TEST(Hair, LeavesOutWhatIsNoStrand) {
  std::vector<float> repeated = five_points;
  std::copy_n(five_points.begin(), 3, repeated.begin() + 3);  // point 1 is point 0
  Polylines lines = hair(HairText{}.with({2, 1}, {repeated}));
  EXPECT_EQ(lines.count, (std::vector<std::uint32_t>{2, 2}));
  EXPECT_EQ(lines.point[1], glm::vec3(0, 2, 0));
  ASSERT_EQ(lines.notes.size(), 1u);
  EXPECT_EQ(lines.notes[0], "points that repeat the point before are left out: 1");
  lines = hair(HairText{.strands = 3, .points = 6}.with(
      {2, 0, 1}, {{0, 1, 0, 0, 1.5f, 0, 0, 2, 0, 7, 7, 7, 1, 0, 0, 2, 0, 0}}));
  EXPECT_EQ(lines.count, (std::vector<std::uint32_t>{3, 2}));
  ASSERT_EQ(lines.notes.size(), 1u);
  EXPECT_EQ(lines.notes[0], "strands of one point are left out: 1");
}

TEST(Hair, RefusesWhatItCannotRead) {
  const HairText plain;
  const std::string good = plain.with({2, 1}, {five_points});
  expect_refusal(good.substr(0, 127), "hair", "no HAIR file");
  expect_refusal("hair" + good.substr(4), "hair", "no HAIR file");
  expect_refusal(good.substr(0, good.size() - 1), "hair", "its points need 60 bytes from byte 132 on");
  expect_refusal(HairText{.arrays = 1}.with({2, 1}, {five_points}), "hair", "has no points");
  expect_refusal(HairText{.points = 6}.with({2, 1}, {five_points}), "hair",
                 "its strands have 5 points together, but the header says 6");
  expect_refusal(HairText{.strands = 0xffffffff}.with({2, 1}, {five_points}), "hair", "4294967295 strands");
  expect_refusal(HairText{.strands = 0}.with({}, {}), "hair", "0 strands");
  expect_refusal(HairText{.points = 1u << 31, .arrays = 2, .segments = (1u << 30) - 1}.with({}, {}), "hair",
                 "2147483648 points");
  std::vector<float> bad = five_points;
  bad[7] = NAN;
  expect_refusal(plain.with({2, 1}, {bad}), "hair", "a coordinate of point 2 is nan");
  expect_refusal(HairText{.arrays = 7}.with({2, 1}, {five_points, {1, 1, -1, 1, 1}}), "hair",
                 "the width of point 2 is -1");
  expect_refusal(HairText{.width = NAN}.with({2, 1}, {five_points}), "hair", "the width of point 0 is nan");
  expect_refusal(HairText{.width = -1}.with({2, 1}, {five_points}), "hair", "the width of point 0 is -1");
  expect_refusal(HairText{.arrays = 19}.with({2, 1}, {five_points, std::vector<float>(15, 255)}), "hair",
                 "a colour of point 0 is 255; it must be from 0 to 1");
  expect_refusal(
      HairText{.strands = 1, .points = 2, .arrays = 2, .segments = 1}.with({}, {{1, 1, 1, 1, 1, 1}}), "hair",
      "no strand has two different points");
}

TEST(HairOfObj, HasItsLines) {
  const Polylines lines = parse_polylines(
      "\xef\xbb\xbf# fur\nv 0 1 0\nv 0 1.5 0\nv 0 2 0 # tip\nvt 0 0\nl 1/1 2/1 \\\n3\r\nf 1 2 3\nv 1 0 0\nv 4 0 0 2\nL -2 -1\n",
      "obj", "fur.obj");
  EXPECT_EQ(lines.count, (std::vector<std::uint32_t>{3, 2}));
  EXPECT_EQ(lines.point, hair(HairText{}.with({2, 1}, {five_points})).point);
}

TEST(HairOfObj, RefusesWhatItCannotRead) {
  expect_refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "obj", "the file contains no lines (l)");
  expect_refusal("v 0 0 0\nv 1 0 0\nl 1\n", "obj", "fur:3: a line of 1 corners; give at least two");
  expect_refusal("v 0 0 0\nv 1 0 0\nl 1 3\n", "obj", "fur:3: vertex 3 is out of range; there are 2 vertices");
  expect_refusal("v 0 0 0\nv 1 0 0\nl 0 1\n", "obj", "fur:3: '0' is not a vertex");
  expect_refusal(std::string("\xff\xfe") + "v", "obj", "UTF-16 text");
}

}  // namespace
}  // namespace pelage
