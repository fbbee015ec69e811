// Tests the computation of UV maps for large mesh files: the linear solver LaplaceSolver, and flatten(). Also
// tests the progress messages of load_model().
#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "harness/error.hpp"
#include "harness/hash.hpp"
#include "harness/isolated/isolated.hpp"
#include "harness/mesh/laplace.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/steps.hpp"
#include "harness/mesh/unfold.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns the Laplacian matrix of a grid with diagonal edges and fixed values along one side.
LaplaceSolver::Matrix grid(int rows, int columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int here = i * columns + j;
      if (i == 0) entries.emplace_back(here, here, 1.0);
      for (const auto& [a, b] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        if (i + a >= rows || j + b >= columns) continue;
        const int there = here + a * columns + b;
        entries.emplace_back(here, there, -1.0);
        entries.emplace_back(there, here, -1.0);
        entries.emplace_back(here, here, 1.0);
        entries.emplace_back(there, there, 1.0);
      }
    }
  }
  const auto unknowns = Eigen::Index(rows) * columns;
  LaplaceSolver::Matrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Without a preconditioner, conjugate gradients would need thousands of iterations, and the number of
// iterations would grow in proportion to `side`.
TEST(LaplaceSolver, NeedsFewIterationsHoweverManyUnknowns) {
  for (const int side : {100, 200, 400}) {
    const LaplaceSolver::Matrix matrix = grid(side, side);
    const auto unknowns = Eigen::Index(side) * side;
    LaplaceSolver::Columns wanted(unknowns, 2);
    for (int i = 0; i < side * side; ++i) {
      wanted(i, 0) = std::sin(0.02 * i);
      wanted(i, 1) = double(i % side) / side;
    }
    const LaplaceSolver::Columns b = matrix * wanted;
    LaplaceSolver::Columns x = LaplaceSolver::Columns::Zero(unknowns, 2);
    const auto iterations = LaplaceSolver(matrix).solve(b, x);
    ASSERT_TRUE(iterations) << side;
    EXPECT_LE(*iterations, 60) << side;
    EXPECT_LT((matrix * x - b).norm(), 1e-8 * b.norm()) << side;
    EXPECT_LT((x - wanted).cwiseAbs().maxCoeff(), 1e-4) << side;
  }
}

TEST(LaplaceSolver, FactorsSystemsOfAtMost6000Unknowns) {
  for (const auto& [rows, columns] : {std::pair(75, 80), {17, 353}}) {
    const LaplaceSolver::Matrix matrix = grid(rows, columns);
    const LaplaceSolver::Columns wanted = LaplaceSolver::Columns::Random(matrix.rows(), 2),
                                 b = matrix * wanted;
    LaplaceSolver::Columns x = LaplaceSolver::Columns::Zero(matrix.rows(), 2);
    const int iterations = LaplaceSolver(matrix).solve(b, x).value();
    EXPECT_EQ(iterations == 0, matrix.rows() == 6000);
    EXPECT_LT((x - wanted).cwiseAbs().maxCoeff(), iterations == 0 ? 1e-9 : 1e-4);
  }
}

// The products of the residual and of the steps, about 1e-340, are smaller than the least double, so that the
// iterations do not change x. The residual is then the fraction of the solution that is missing at first.
TEST(LaplaceSolver, EndsAfter300Iterations) {
  const LaplaceSolver::Matrix matrix = grid(17, 353) * 1e150;
  LaplaceSolver::Columns wanted = LaplaceSolver::Columns::Zero(matrix.rows(), 2), x;
  wanted.row(0).setConstant(1e-240);
  const LaplaceSolver::Columns b = matrix * wanted;
  const LaplaceSolver solver(matrix);
  EXPECT_EQ(solver.solve(b, x = wanted), 0);
  EXPECT_EQ(solver.solve(b, x = wanted * (1 - 1e-6)), 300);
  EXPECT_EQ(solver.solve(b, x = wanted * (1 - 1e-4)), std::nullopt);
}

// The corners divide a circle of the area 2 in the ratio 2 : 2 sqrt(2) : 2 of the sides. The weights of the
// sides to the inner point are half the sums of two cotangents, (3 + 3) / 2, (1 + 2) / 2 and (2 + 1) / 2.
TEST(Flatten, BeginsWithTheHarmonicMapOntoACircle) {
  Surface surface;
  surface.point = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}};
  const Disk disk{{0, 1, 2, 3}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const FlatDisk flat = flatten(surface, disk, "triangle", {}, 0);
  EXPECT_FALSE(flat.rigid);
  const double radius = std::sqrt(2 / M_PI), angle = 2 * M_PI / (2 + std::sqrt(2.0));
  const double x = radius * std::cos(angle), y = radius * std::sin(angle);
  const glm::dvec2 wanted[] = {{radius, 0.0}, {x, y}, {x, -y}, {(radius + x) / 2, 0.0}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(glm::distance(flat.uv[i], wanted[i]), 1e-12);
  const FlatDisk rigid = flatten(surface, disk, "triangle", {}, 1);
  EXPECT_TRUE(rigid.rigid && glm::length(rigid.uv[0]) < 1e-12);
}

// The surface is three quarters of a cylinder, which can be flattened without stretch.
TEST(Flatten, UnrollsWhatCanBeUnrolled) {
  const int across = 120, along = 90;
  Surface surface;
  Disk disk;
  for (int i = 0; i <= across; ++i) {
    for (int j = 0; j <= along; ++j) {
      const double angle = 1.5 * 3.14159265358979 * i / across;
      surface.point.emplace_back(std::cos(angle), std::sin(angle), 3.0 * j / along);
      disk.point.push_back(std::uint32_t(disk.point.size()));
    }
  }
  const auto at = [&](int i, int j) { return std::uint32_t(i * (along + 1) + j); };
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < along; ++j) {
      disk.triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      disk.triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  surface.triangle = disk.triangle;
  std::vector<double> told;
  const FlatDisk flat = flatten(surface, disk, "roll", [&](double part) { told.push_back(part); });
  EXPECT_TRUE(flat.rigid && flat.flipped == 0);
  EXPECT_TRUE(!bits_of_cgal || Hash().values(flat.uv).hex() == "e5ce79b2ea7017d3");
  for (const auto& t : disk.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = t[k], q = t[(k + 1) % 3];
      const double ratio =
          glm::distance(flat.uv[p], flat.uv[q]) / glm::distance(surface.point[p], surface.point[q]);
      EXPECT_NEAR(ratio, 1, 0.05);
    }
  ASSERT_EQ(told.size(), 12u);  // the harmonic map has two parts, and each of the ten iterations has one
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], double(i) / 12);
  // Degenerate faces do no harm: here all corners of a face lie at one point.
  surface.point[at(60, 45)] = surface.point[at(61, 46)] = surface.point[at(61, 45)];
  EXPECT_TRUE(flatten(surface, disk, "roll", {}, 1).rigid);
}

TEST(PlanCuts, KeepsTwentyTipsIfNoMapCanBeMade) {
  std::vector<double> told;
  const Unfold unfold = [](const Surface&, const CutPlan&, const std::string& name) -> Surface {
    throw InputError(name);
  };
  const auto plans = plan_cuts(make_pear(4), "pear", unfold, [&](double part) { told.push_back(part); });
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].plan.tips.size(), 20u);
  ASSERT_EQ(told.size(), 20u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_DOUBLE_EQ(told[i], double(i + 1) / 21);
}

// Every plan gives the same map: four triangles that make the unit square, and a flipped copy of one of them.
// The copy overlaps 1/4 of the square, and has 1/5 of the sum of the areas.
TEST(PlanCuts, CostsOfAMapAreItsOverlapsAndFlips) {
  Surface map = make_square(1);
  map.packed_uv = true;  // so that the map stays as it is
  map.triangle.push_back({map.triangle[0][0], map.triangle[0][2], map.triangle[0][1]});
  map.uv.push_back({map.uv[0][0], map.uv[0][2], map.uv[0][1]});
  const Unfold unfold = [&](const Surface&, const CutPlan&, const std::string&) { return map; };
  const TriedPlan plan = plan_cuts(make_pear(1), "pear", unfold)[0];
  EXPECT_NEAR(plan.cost, 20 * (1.0 / 4 + 1.0 / 5), 0.05);
  EXPECT_TRUE(plan.plan.tips.empty());  // a cut that does not lower the cost is not kept
  map.uv[1].fill(map.uv[1][0]);
  EXPECT_EQ(plan_cuts(make_pear(1), "pear", unfold)[0].cost, std::numeric_limits<double>::max());
}

// For the mesh of a named model, flatten() must need nearly as few charts as CGAL, whose map the model has,
// and must scale the faces nearly as evenly.
TEST(LargeFile, HasAsGoodAMapAsTheNamedModel) {
  const test::Folder folder;
  for (const auto& [name, faces, hash] : {std::tuple("banisch-elephant", 1148u, "bacdb94651f02e7e"),
                                          {"banisch-dog", 3220u, "a2f9f26f41da853b"}}) {
    const auto named = load_model(name);
    EXPECT_EQ(named->triangle.size(), faces) << name;
    const std::string file = (folder.path / (std::string(name) + ".ply")).string();
    write_ply(file, *named);
    const auto mesh = load_model(file, fresh());
    const UvQuality before = uv_quality(*named), after = uv_quality(*mesh);
    EXPECT_LE(after.charts, 2 * before.charts) << name;
    EXPECT_LT(after.area_high / after.area_low, 1.5 * before.area_high / before.area_low) << name;
    EXPECT_EQ(after.overlapping, 0.0) << name;
    EXPECT_EQ(after.flipped_faces, 0u) << name;
    EXPECT_TRUE(!bits_of_cgal || mesh->hash == hash) << mesh->hash;
  }
}

TEST(LargeFile, TellsItsStagesAndHowFarTheyAre) {
  const test::Folder folder;
  const std::string file = (folder.path / "torus.ply").string();
  write_ply(file, *load_model("torus-40x30"));
  MeshOptions options = fresh();
  options.silent_s = 0;
  std::string said;
  options.progress = [&](const std::string& line) { said += line + "\n"; };
  load_model(file, options);
  for (const char* stage :
       {": reading, 0 s\n", ": welding points, ", ": filling holes, ", ": making a coarse version, ",
        ": choosing the cuts for the UV map, ", ": computing the UV map, ", ": sorting, "})
    EXPECT_NE(said.find(file + stage), std::string::npos) << stage << "\n" << said;
  test::expect_has(said, {": choosing the cuts for the UV map, 1%, ",
                          ": choosing the cuts for the UV map, 76%, ", ": computing the UV map, 50%"});
}

TEST(LargeFile, IsStillAtWorkWhereAStageSaysNothing) {
  std::string said;
  const Limits limits{std::uint64_t(1) << 30, std::chrono::seconds(30), std::chrono::milliseconds(100)};
  isolated(
      "a.obj", limits,
      [](const Say&) {
        ::usleep(1'500'000);
        return std::string("done");
      },
      [&](const std::string& line) { said += line + "\n"; });
  test::expect_has(said, "a.obj: still at work, 1 s\n");
}

}  // namespace
}  // namespace pelage
