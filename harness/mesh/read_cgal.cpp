#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <sstream>

#include "harness/mesh/soup.hpp"

namespace pelage::detail {

bool read_by_cgal(const std::string& bytes, std::string_view format, Soup& soup) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  std::istringstream in(bytes, std::ios::binary);
  const auto options = CGAL::parameters::verbose(false);
  const bool good = format == "obj"   ? CGAL::IO::read_OBJ(in, points, polygons, options)
                    : format == "off" ? CGAL::IO::read_OFF(in, points, polygons, options)
                    : format == "ply" ? CGAL::IO::read_PLY(in, points, polygons, options)
                                      : format == "stl" && CGAL::IO::read_STL(in, points, polygons, options);
  soup.point.reserve(points.size());
  for (const Point& p : points) soup.point.emplace_back(p.x(), p.y(), p.z());
  soup.polygon.reserve(polygons.size());
  for (const auto& polygon : polygons) {
    auto& copy = soup.polygon.emplace_back();
    for (const std::size_t index : polygon)
      copy.push_back(std::uint32_t(std::min<std::size_t>(index, 0xffffffffu)));
  }
  return good;
}

}  // namespace pelage::detail
