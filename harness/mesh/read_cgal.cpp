#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <sstream>

#include "harness/mesh/soup.hpp"

namespace pelage::detail {

bool read_by_cgal(const std::string& bytes, std::string_view format, Soup& soup) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::istringstream in(bytes, std::ios::binary);
  const auto options = CGAL::parameters::verbose(false);
  bool good = false;
  if (format == "obj") good = CGAL::IO::read_OBJ(in, points, polygons, options);
  if (format == "off") good = CGAL::IO::read_OFF(in, points, polygons, options);
  if (format == "ply") good = CGAL::IO::read_PLY(in, points, polygons, options);
  if (format == "stl") good = CGAL::IO::read_STL(in, points, polygons, options);
  soup.point.reserve(points.size());
  for (const Point& p : points) soup.point.emplace_back(p.x(), p.y(), p.z());
  soup.polygon.reserve(polygons.size());
  for (const auto& polygon : polygons) {
    auto& copy = soup.polygon.emplace_back();
    for (const std::size_t index : polygon)
      copy.push_back(index > 0xffffffffu ? 0xffffffffu : std::uint32_t(index));
  }
  return good;
}

}  // namespace pelage::detail
