// The order of the points and faces of a mesh file.
#pragma once
#include "harness/mesh/soup.hpp"

namespace pelage {

/// Replaces the order of the file by one that depends only on the surface. Points are sorted by x, then y,
/// then z. All faces refer to the first of coincident points. The corners of a face start with the first of
/// its points and keep their direction of rotation; faces are sorted by their corners. Later steps, such as
/// the cuts of the UV map, choose between equally good results by this order. A surface therefore has the
/// same UV map in whatever order its file lists it. -0 becomes 0.
void sort_soup(Soup& soup);

}  // namespace pelage
