#include "harness/strands/groom/roots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <future>
#include <glm/geometric.hpp>
#include <thread>

#include "harness/error.hpp"
#include "harness/prepare/random.hpp"

namespace pelage::strands {
namespace {

// A disc around each accepted candidate keeps later candidates away. A lower density gives larger discs.
// Below this density the discs do not grow further, because a search within a larger radius would take too
// long. Some of these discs then get no root, so that the roots have the lower density.
constexpr double least_spaced_density = 1.0 / 16;
// A level is one pass of the outer loop in scatter_roots(), with one distance `radius`. The constant is the
// number of candidates of a level, divided by the number of points that fit on the surface at this distance
// from each other. More candidates give more even distances.
constexpr double candidates_per_disc = 2;
constexpr float radius_step = 0.840896415f;  // 2^(-1/4): sqrt(2) times as many points fit in the next level

// The candidates of a level are divided into this many batches. The candidates of a batch are tested in the
// order of the triangles, because neighbouring triangles are near each other in memory. If the first n roots
// of the list end within a batch, the distances between these n roots are less even than for other values of
// n.
constexpr double batches_per_level = 64;

// Least number of candidates for which a thread is started.
constexpr std::size_t least_part = 2048;

// Stream numbers (class Random) for the candidates and for the order of the roots.
constexpr std::uint32_t candidate_stream = 0x726f6f74, order_stream = 0x726f6f75;

std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::uint32_t face) {
  const glm::uvec3 t = mesh.triangle[face];
  return {glm::dvec3(mesh.position[t.x]), glm::dvec3(mesh.position[t.y]), glm::dvec3(mesh.position[t.z])};
}

/// A disc around an accepted candidate. Its radius is `factor` times the variable `radius` of
/// scatter_roots().
struct Disc {
  glm::vec3 centre{0};
  float factor = 1;
  glm::vec3 normal{0};
  std::uint32_t face = 0;
  std::uint32_t next = 0;  ///< index of the next disc in the same bucket of the Grid, or Grid::none
};

/// The discs, in a hash table. The key of a disc is the cell of a regular grid that contains its centre.
class Grid {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Prepares the search of discs that are at most about half a cell away. The discs are sorted by triangle,
  /// because neighbouring triangles are near each other in memory.
  void rebuild(float cell, std::size_t capacity) {
    cell_ = cell;
    heads_.assign(std::bit_ceil(2 * capacity), none);
    std::stable_sort(discs_.begin(), discs_.end(),
                     [](const Disc& a, const Disc& b) { return a.face < b.face; });
    for (std::uint32_t i = 0; i < discs_.size(); ++i) link(i);
  }

  void add(const Disc& disc) {
    discs_.push_back(disc);
    link(std::uint32_t(discs_.size() - 1));
  }

  /// Starts to load the memory that blocks() reads first: the bucket, and the first disc of the bucket.
  void prefetch_bucket(const Disc& wanted) const {
    __builtin_prefetch(&heads_[bucket(cell_of(wanted.centre))]);
  }
  void prefetch_disc(const Disc& wanted) const {
    const std::uint32_t head = heads_[bucket(cell_of(wanted.centre))];
    if (head != none) __builtin_prefetch(&discs_[head]);
  }

  /// Returns whether another disc blocks the disc `wanted`. The other disc blocks `wanted` if the two discs
  /// are on the same side of the surface, and the distance between their centres is less than the smaller
  /// radius.
  bool blocks(const Disc& wanted, float radius) const {
    const float farthest = radius * wanted.factor;
    const glm::ivec3 own = cell_of(wanted.centre);
    if (bucket_blocks(bucket(own), wanted, radius)) return true;  // most blocking discs are in this cell
    const glm::ivec3 low = cell_of(wanted.centre - farthest), high = cell_of(wanted.centre + farthest);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
          if (glm::ivec3(x, y, z) != own && bucket_blocks(bucket({x, y, z}), wanted, radius)) return true;
    return false;
  }

 private:
  void link(std::uint32_t i) {
    std::uint32_t& head = heads_[bucket(cell_of(discs_[i].centre))];
    discs_[i].next = head;
    head = i;
  }
  bool bucket_blocks(std::size_t bucket, const Disc& wanted, float radius) const {
    for (std::uint32_t i = heads_[bucket]; i != none; i = discs_[i].next) {
      const Disc& other = discs_[i];
      const float reach = radius * std::min(wanted.factor, other.factor);
      const glm::vec3 apart = other.centre - wanted.centre;
      if (glm::dot(apart, apart) < reach * reach && glm::dot(other.normal, wanted.normal) > 0) return true;
    }
    return false;
  }
  glm::ivec3 cell_of(glm::vec3 p) const { return glm::ivec3(glm::floor(p / cell_)); }
  /// Cells that are neighbours in x have neighbouring buckets, so that a search reads few cache lines.
  std::size_t bucket(glm::ivec3 c) const {
    return (std::size_t(c.x) + 7919 * std::size_t(c.y) + std::size_t(7907) * 7919 * std::size_t(c.z)) &
           (heads_.size() - 1);
  }
  float cell_ = 1;
  std::vector<std::uint32_t> heads_;
  std::vector<Disc> discs_;
};

/// Returns the disc of a root. `density` is the density at the root, or least_spaced_density if that is
/// greater.
Disc disc_of(const Mesh& mesh, const Root& root, double density) {
  const auto [a, b, c] = corners_of(mesh, root.face);
  return {glm::vec3(position_of(mesh, root)), float(1 / std::sqrt(density)),
          glm::vec3(glm::cross(b - a, c - a)), root.face, Grid::none};
}

struct Candidate {
  Root root;
  Disc disc;
  bool rooted = false;  ///< whether the candidate's disc gets a root
};

/// Draws random points of the surface. Their expected number per area is proportional to the density, or to
/// least_spaced_density if this is greater.
class Candidates {
 public:
  Candidates(const Mesh& mesh, const Density& density, std::uint32_t seed, const std::vector<bool>& bare)
      : mesh_(mesh), density_(density), random_(seed, candidate_stream) {
    sums_.reserve(mesh.triangle.size());
    double sum = 0;
    for (std::uint32_t f = 0; f < mesh.triangle.size(); ++f) {
      const auto [a, b, c] = corners_of(mesh, f);
      if (bare.empty() || !bare[f]) sum += 0.5 * glm::length(glm::cross(b - a, c - a));
      sums_.push_back(sum);
    }
  }

  double area() const { return sums_.empty() ? 0 : sums_.back(); }

  /// Draws the candidates `from` to `to` - 1 of a batch of `count` candidates. The batch has the indices
  /// `first` to `first` + `count` - 1. The surface is divided into `count` strips of equal area, and each
  /// strip gets one candidate. The function keeps a candidate with the probability Candidate::density, and
  /// none where the density is 0. It returns the kept candidates, in the order of the triangles.
  std::vector<Candidate> draw(std::uint64_t first, std::size_t count, std::size_t from,
                              std::size_t to) const {
    std::vector<Candidate> kept;
    auto face = sums_.begin();
    for (std::size_t k = from; k < to; ++k) {
      const std::uint64_t index = first + k;
      const double sum = (double(k) + random_.uniform(index, 0)) / double(count) * area();
      face = above(face, sum);
      Candidate candidate;
      candidate.root.face = std::uint32_t(face - sums_.begin());
      double a = random_.uniform(index, 1), b = random_.uniform(index, 2);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      candidate.root.weight = {float(a), float(std::min(b, 1.0 - double(float(a))))};
      const double density = density_(candidate.root), spaced = std::max(density, least_spaced_density);
      candidate.rooted = random_.uniform(index, 4) * spaced < density;
      if (!(density > 0 && random_.uniform(index, 3) < spaced)) continue;
      candidate.disc = disc_of(mesh_, candidate.root, spaced);
      kept.push_back(candidate);
    }
    return kept;
  }

 private:
  using Sums = std::vector<double>;
  /// Returns the first element from `from` on that is greater than `sum`, or the last element. The search
  /// doubles its distance from `from` and then bisects, because the element is often near.
  Sums::const_iterator above(Sums::const_iterator from, double sum) const {
    std::ptrdiff_t step = 1;
    while (sums_.end() - from > step && from[step - 1] <= sum) {
      from += step;
      step *= 2;
    }
    const auto found = std::upper_bound(from, from + std::min(step, sums_.end() - from), sum);
    return found == sums_.end() ? found - 1 : found;
  }

  const Mesh& mesh_;
  const Density& density_;
  Random random_;
  /// For each triangle, the area of all triangles up to and including it, without bare triangles.
  std::vector<double> sums_;
};

/// Draws a batch of candidates, and returns those that no disc of the grid blocks, in their order. All cores
/// of the machine share the work.
std::vector<Candidate> unblocked(const Candidates& candidates, std::uint64_t first, std::size_t count,
                                 const Grid& grid, float radius) {
  const auto part = [&](std::size_t from, std::size_t to) {
    std::vector<Candidate> drawn = candidates.draw(first, count, from, to);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      // The reads of the table would otherwise take most of the time, because they miss the caches.
      if (i + 16 < drawn.size()) grid.prefetch_bucket(drawn[i + 16].disc);
      if (i + 8 < drawn.size()) grid.prefetch_disc(drawn[i + 8].disc);
      if (!grid.blocks(drawn[i].disc, radius)) drawn[kept++] = drawn[i];
    }
    drawn.resize(kept);
    return drawn;
  };
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t parts = std::clamp<std::size_t>(count / least_part, 1, cores);
  if (parts == 1) return part(0, count);
  std::vector<std::future<std::vector<Candidate>>> running;
  for (std::size_t i = 0; i < parts; ++i)
    running.push_back(std::async(std::launch::async, part, count * i / parts, count * (i + 1) / parts));
  std::vector<Candidate> all;
  for (auto& each : running) {
    const std::vector<Candidate> some = each.get();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Shuffles the roots (Fisher and Yates). The order depends on the numbers of `random` with the
/// indices `first` + 2 to `first` + roots.size().
void shuffle(std::vector<Root>& roots, const Random& random, std::uint64_t first) {
  for (std::size_t i = roots.size(); i > 1; --i)
    std::swap(roots[i - 1], roots[std::size_t(random.uniform(first + i) * double(i))]);
}

}  // namespace

glm::dvec3 position_of(const Mesh& mesh, const Root& root) {
  const auto [a, b, c] = corners_of(mesh, root.face);
  return a + double(root.weight.x) * (b - a) + double(root.weight.y) * (c - a);
}

glm::dvec2 uv_of(const Mesh& mesh, const Root& root) {
  const glm::uvec3 t = mesh.triangle[root.face];
  const glm::dvec2 a(mesh.uv[t.x]), b(mesh.uv[t.y]), c(mesh.uv[t.z]);
  return a + double(root.weight.x) * (b - a) + double(root.weight.y) * (c - a);
}

std::vector<Root> scatter_roots(const Mesh& mesh, const Density& density, std::size_t count,
                                std::uint32_t seed, const std::vector<bool>& bare) {
  const Candidates candidates(mesh, density, seed, bare);
  const auto refuse = [&] {
    throw InputError(fmt::format(
        "{}: the strands have no place, because their density is 0 on almost the whole surface", mesh.name));
  };
  if (!(candidates.area() > 0)) refuse();
  const Random random(seed, order_stream);
  std::vector<Root> roots, added;
  Grid grid;
  // Where the density is 1, `radius` is the least distance between two roots. In a hexagonal packing with
  // this distance, each root takes an area of sqrt(3)/2 radius^2. At first, `radius` is so large that one
  // root takes the area of the whole surface.
  const double packing = std::sqrt(3.0) / 2;
  float radius = float(std::sqrt(candidates.area() / packing));
  const double most_candidates = 1e6 + 1e4 * double(count);
  std::uint64_t index = 0;
  for (; roots.size() < count; radius *= radius_step) {
    grid.rebuild(2 * radius, std::max<std::size_t>(count, 16));
    const double attempts =
        std::ceil(candidates_per_disc * candidates.area() / (packing * double(radius) * radius));
    const auto batch = std::size_t(std::ceil(attempts / batches_per_level));
    for (double tried = 0; tried < attempts && roots.size() < count; tried += double(batch)) {
      if (double(index) > most_candidates) refuse();
      const std::vector<Candidate> wanted = unblocked(candidates, index, batch, grid, radius);
      index += batch;
      added.clear();
      for (const Candidate& candidate : wanted) {
        if (grid.blocks(candidate.disc, radius)) continue;  // by a disc of this batch
        if (candidate.rooted) added.push_back(candidate.root);
        grid.add(candidate.disc);
      }
      shuffle(added, random, index);
      roots.insert(roots.end(), added.begin(), added.end());
    }
  }
  roots.resize(count);
  return roots;
}

}  // namespace pelage::strands
