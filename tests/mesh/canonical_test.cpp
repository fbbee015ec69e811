// Tests that a surface gives the same mesh in whatever order its file lists points, faces and corners.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "harness/mesh/read/soup.hpp"
#include "tests/mesh/mesh_files.hpp"

namespace pelage {
namespace {

/// A closed shape with bumps and an open sheet beside it. The shape has triangles at its ends and quads
/// between them. Each corner has a UV; the UV map has a seam at the first column. Some coordinates are 0.
Soup shape() {
  constexpr std::uint32_t rows = 12, columns = 20;
  Soup soup;
  const auto face = [&](std::vector<std::uint32_t> corners, std::vector<glm::dvec2> uv) {
    soup.polygon.push_back(std::move(corners));
    soup.uv.push_back(std::move(uv));
  };
  const auto add = [&](double row, std::uint32_t column) {
    const double a = M_PI * row / rows, b = 2 * M_PI * column / columns;
    const double radius = 1 + 0.3 * std::sin(2 * a) * std::cos(3 * b + 0.4) + 0.1 * std::sin(5 * b + 1);
    const double across = row == 0 || row == rows ? 0 : radius * std::sin(a);
    soup.point.emplace_back(across * std::cos(b), radius * std::cos(a), across * std::sin(b));
  };
  add(0, 0);
  for (std::uint32_t r = 1; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) add(r, c);
  add(rows, 0);
  const auto last = std::uint32_t(soup.point.size() - 1);
  const auto at = [&](std::uint32_t r, std::uint32_t c) { return 1 + (r - 1) * columns + c % columns; };
  const auto uv = [&](double r, double c) { return glm::dvec2(0.9 * c / columns, 0.1 + 0.8 * r / rows); };
  for (std::uint32_t c = 0; c < columns; ++c) {
    face({0, at(1, c + 1), at(1, c)}, {uv(0, c + 0.5), uv(1, c + 1), uv(1, c)});
    for (std::uint32_t r = 1; r + 1 < rows; ++r)
      face({at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)},
           {uv(r, c), uv(r, c + 1), uv(r + 1, c + 1), uv(r + 1, c)});
    face({last, at(rows - 1, c), at(rows - 1, c + 1)},
         {uv(rows, c + 0.5), uv(rows - 1, c), uv(rows - 1, c + 1)});
  }
  for (std::uint32_t row = 0; row < 4; ++row)
    for (std::uint32_t column = 0; column < 4; ++column) soup.point.emplace_back(3 + column, 0, 0.5 * row);
  for (std::uint32_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < 3; ++j) {
      const std::uint32_t a = last + 1 + 4 * i + j;
      const auto flat = [&](double x, double y) { return glm::dvec2(0.91 + 0.02 * (x + j), 0.02 * (y + i)); };
      face({a, a + 1, a + 5, a + 4}, {flat(0, 0), flat(1, 0), flat(1, 1), flat(0, 1)});
    }
  return soup;
}

/// The same surface in another order. Some points are listed twice, and -0 stands for 0. Faces with more than
/// three corners begin with another corner only if `turn_all` is true.
Soup permuted(const Soup& from, unsigned seed, bool turn_all) {
  std::mt19937 random(seed);
  Soup soup = from;
  for (glm::dvec3& p : soup.point)
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] == 0) p[axis] = -0.0;
  soup.point.insert(soup.point.end(), from.point.begin(), from.point.begin() + 50);
  std::vector<std::uint32_t> place(soup.point.size()), order(from.polygon.size());
  std::iota(place.begin(), place.end(), 0u);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<glm::dvec3> point(soup.point.size());
  for (std::size_t i = 0; i < point.size(); ++i) point[place[i]] = soup.point[i];
  soup.point = point;
  for (std::size_t f = 0; f < order.size(); ++f) {
    std::vector<std::uint32_t> corners = from.polygon[order[f]];
    std::vector<glm::dvec2> uv = from.uv[order[f]];
    const auto turn = std::ptrdiff_t(turn_all || corners.size() == 3 ? random() % corners.size() : 0);
    std::rotate(corners.begin(), corners.begin() + turn, corners.end());
    std::rotate(uv.begin(), uv.begin() + turn, uv.end());
    for (std::uint32_t& i : corners)
      i = place[i < 50 && random() % 2 == 0 ? i + std::uint32_t(from.point.size()) : i];
    soup.polygon[f] = corners;
    soup.uv[f] = uv;
  }
  return soup;
}

std::string obj(const Soup& soup) {
  std::string text;
  for (const glm::dvec3& p : soup.point) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& face : soup.uv)
    for (const glm::dvec2& uv : face) text += fmt::format("vt {} {}\n", uv.x, uv.y);
  std::size_t corner = 0;
  for (const auto& face : soup.polygon) {
    text += "f";
    for (const std::uint32_t i : face) text += fmt::format(" {}/{}", i + 1, ++corner);
    text += "\n";
  }
  return text;
}

// The order of a file decides neither how a face is divided into triangles nor anything else.
TEST(Canonical, AFileGivesTheSameMeshInEveryOrder) {
  const test::Folder folder;
  const Soup soup = shape();
  const std::string file = folder.write("shape.obj", obj(soup));
  for (const bool keep_uv : {false, true}) {
    const auto expected = load_model(file, fresh({}, keep_uv));
    for (const unsigned seed : {1u, 2u, 3u}) {
      folder.write("other.obj", obj(permuted(soup, seed, !keep_uv)));
      const auto found = load_model((folder.path / "other.obj").string(), fresh({}, keep_uv));
      EXPECT_EQ(found->hash, expected->hash) << "seed " << seed << (keep_uv ? ", UV map of the file" : "");
    }
  }
}

}  // namespace
}  // namespace pelage
