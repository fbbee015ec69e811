#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <queue>
#include <span>

#include "harness/mesh/sides.hpp"
#include "harness/mesh/unfold.hpp"

namespace pelage {
namespace {

constexpr double far = std::numeric_limits<double>::max();

struct Edge {
  std::uint32_t a, b;         // indices of the edge's end points, a < b
  std::uint32_t left, right;  // the two faces at the edge; `right` is `no_index` if the edge lies on a border
  double length;
};

struct Graph {
  std::vector<Edge> edge;
  std::vector<std::array<std::uint32_t, 3>> of_face;  // edge k of a face connects its corners k and k + 1
  // at_point lists the indices of the edges at point 0, then those of the edges at point 1, and so on. The
  // indices at one point are in ascending order. row[p] is the position in at_point at which the list of
  // point p starts.
  std::vector<std::uint32_t> row, at_point;
  std::span<const std::uint32_t> of_point(std::uint32_t p) const {
    return {at_point.data() + row[p], at_point.data() + row[p + 1]};
  }
  std::size_t points() const { return row.size() - 1; }
};

Graph make_graph(const Surface& surface) {
  const std::vector<Side> sides = sides_of(surface.triangle);
  Graph graph;
  graph.of_face.resize(surface.triangle.size());
  graph.edge.reserve(sides.size() / 2 + 1);
  for (const Side& side : sides) {
    const bool second =
        !graph.edge.empty() && graph.edge.back().a == side.low && graph.edge.back().b == side.high;
    if (second) {
      graph.edge.back().right = side.face;
    } else {
      graph.edge.push_back({side.low, side.high, side.face, no_index,
                            glm::distance(surface.point[side.low], surface.point[side.high])});
    }
    graph.of_face[side.face][side.corner] = std::uint32_t(graph.edge.size() - 1);
  }
  graph.row.assign(surface.point.size() + 1, 0);
  for (const Edge& edge : graph.edge) ++graph.row[edge.a + 1], ++graph.row[edge.b + 1];
  std::partial_sum(graph.row.begin(), graph.row.end(), graph.row.begin());
  graph.at_point.resize(graph.row.back());
  std::vector<std::uint32_t> next = graph.row;
  for (std::uint32_t e = 0; e < graph.edge.size(); ++e)
    for (const std::uint32_t p : {graph.edge[e].a, graph.edge[e].b}) graph.at_point[next[p]++] = e;
  return graph;
}

// A queue of pairs of distance and index, least distance first. Equal distances are ordered by index, so that
// the result is deterministic.
using Queue = std::priority_queue<std::pair<double, std::uint32_t>,
                                  std::vector<std::pair<double, std::uint32_t>>, std::greater<>>;

// Returns a flag per edge: 1 if the edge is cut. A tree of shortest paths connects the face nearest to `root`
// with all other faces, across the edges that the faces share. At first, all edges are cut except the edges
// that the tree crosses. Then, if a point has exactly one cut edge, this edge is removed from the cut. The
// removal is repeated until no point has exactly one cut edge.
std::vector<char> cut_graph(const Surface& surface, const Graph& graph, glm::dvec3 root) {
  const auto centroid = [&](const Surface::Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return (surface.point[a] + surface.point[b] + surface.point[c]) / 3.0;
  };
  std::vector<char> cut(graph.edge.size(), true);
  std::vector<double> distance(surface.triangle.size(), far);
  std::vector<std::uint32_t> via(surface.triangle.size(), no_index);
  Queue queue;
  const auto nearest = std::ranges::min_element(
      surface.triangle, {}, [&](const auto& triangle) { return glm::distance(centroid(triangle), root); });
  const auto seed = std::uint32_t(nearest - surface.triangle.begin());
  queue.push({distance[seed] = 0, seed});
  while (!queue.empty()) {
    const auto [d, f] = queue.top();
    queue.pop();
    if (d > distance[f]) continue;
    for (const std::uint32_t e : graph.of_face[f]) {
      const std::uint32_t next = graph.edge[e].left == f ? graph.edge[e].right : graph.edge[e].left;
      if (next == no_index) continue;
      const double there = d + glm::distance(centroid(surface.triangle[f]), centroid(surface.triangle[next]));
      if (there < distance[next]) queue.push({distance[next] = there, next}), via[next] = e;
    }
  }
  for (const std::uint32_t e : via)
    if (e != no_index) cut[e] = false;

  std::vector<std::uint32_t> degree(surface.point.size(), 0), ends;
  for (std::uint32_t e = 0; e < graph.edge.size(); ++e)
    if (cut[e]) ++degree[graph.edge[e].a], ++degree[graph.edge[e].b];
  for (std::uint32_t p = 0; p < degree.size(); ++p)
    if (degree[p] == 1) ends.push_back(p);
  while (!ends.empty()) {
    const std::uint32_t p = ends.back();
    ends.pop_back();
    for (const std::uint32_t e : graph.of_point(p)) {
      if (!cut[e]) continue;
      cut[e] = false;
      --degree[p];
      const std::uint32_t other = graph.edge[e].a == p ? graph.edge[e].b : graph.edge[e].a;
      if (--degree[other] == 1) ends.push_back(other);
    }
  }
  return cut;
}

struct Reach {
  std::vector<double> distance;
  std::vector<std::uint32_t> via;  // last edge of the shortest path from the nearest source to each point
  std::uint32_t farthest;
};

// Computes the shortest paths along the edges from the sources to all points by Dijkstra's algorithm. Stops
// when the shortest path to the point `until` is known.
Reach walk(const Graph& graph, const std::vector<std::uint32_t>& sources, std::uint32_t until = no_index) {
  Reach reach{std::vector<double>(graph.points(), far), std::vector<std::uint32_t>(graph.points(), no_index),
              0};
  Queue queue;
  for (const std::uint32_t p : sources) queue.push({reach.distance[p] = 0, p});
  double most = -1;
  while (!queue.empty()) {
    const auto [d, p] = queue.top();
    queue.pop();
    if (d > reach.distance[p]) continue;
    if (p == until) break;
    if (d > most) most = d, reach.farthest = p;
    for (const std::uint32_t e : graph.of_point(p)) {
      const std::uint32_t other = graph.edge[e].a == p ? graph.edge[e].b : graph.edge[e].a;
      const double there = d + graph.edge[e].length;
      if (there < reach.distance[other])
        queue.push({reach.distance[other] = there, other}), reach.via[other] = e;
    }
  }
  return reach;
}

std::vector<std::uint32_t> points_of(const Graph& graph, const std::vector<char>& cut) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t p = 0; p < graph.points(); ++p) {
    const auto edges = graph.of_point(p);
    if (std::any_of(edges.begin(), edges.end(), [&](std::uint32_t e) { return cut[e]; })) points.push_back(p);
  }
  return points;
}

std::uint32_t nearest_point(const Surface& surface, glm::dvec3 to) {
  const auto nearest =
      std::ranges::min_element(surface.point, {}, [&](const glm::dvec3& p) { return glm::distance(p, to); });
  return std::uint32_t(nearest - surface.point.begin());
}

std::vector<char> cut_as_planned(const Surface& surface, const Graph& graph, const CutPlan& plan) {
  std::vector<char> cut = cut_graph(surface, graph, plan.root);
  std::vector<std::uint32_t> sources = points_of(graph, cut);
  for (const glm::dvec3& tip : plan.tips) {
    std::uint32_t p = nearest_point(surface, tip);
    // A closed surface without handles has an empty cut graph. The first cut then begins at the first point
    // of plan.tips.
    if (sources.empty()) sources.push_back(p);
    const Reach reach = walk(graph, sources, p);
    while (reach.via[p] != no_index) {
      const Edge& edge = graph.edge[reach.via[p]];
      cut[reach.via[p]] = true;
      sources.push_back(p);
      p = edge.a == p ? edge.b : edge.a;
    }
  }
  return cut;
}

}  // namespace

Tip farthest_from_cut(const Surface& surface, const CutPlan& plan, const std::vector<glm::dvec3>& avoid) {
  const Graph graph = make_graph(surface);
  std::vector<std::uint32_t> sources = points_of(graph, cut_as_planned(surface, graph, plan));
  for (const glm::dvec3& p : plan.tips) sources.push_back(nearest_point(surface, p));
  for (const glm::dvec3& p : avoid) sources.push_back(nearest_point(surface, p));
  if (sources.empty()) sources.push_back(nearest_point(surface, plan.root));
  const Reach reach = walk(graph, sources);
  return {surface.point[reach.farthest], reach.distance[reach.farthest]};
}

Disk cut_open(const Surface& surface, const CutPlan& plan) {
  const Graph graph = make_graph(surface);
  const std::vector<char> cut = cut_as_planned(surface, graph, plan);
  Disk disk;

  // A surface point on a cut becomes several vertices of the disk. If two triangles share an uncut edge, they
  // share one vertex of the disk at each end point of the edge.
  Groups groups(surface.triangle.size() * 3);
  const auto corner = [&](std::uint32_t f, std::uint32_t p) {
    const auto& t = surface.triangle[f];
    return 3 * f + (t[0] == p ? 0u : t[1] == p ? 1u : 2u);
  };
  for (std::uint32_t e = 0; e < graph.edge.size(); ++e) {
    const Edge& edge = graph.edge[e];
    if (cut[e] || edge.right == no_index) continue;
    for (const std::uint32_t p : {edge.a, edge.b}) groups.join(corner(edge.left, p), corner(edge.right, p));
  }
  const std::vector<std::uint32_t> number = groups.numbers();
  disk.triangle.resize(surface.triangle.size());
  for (std::uint32_t c = 0; c < number.size(); ++c) {
    if (number[c] == disk.point.size()) disk.point.push_back(surface.triangle[c / 3][c % 3]);
    disk.triangle[c / 3][c % 3] = number[c];
  }
  return disk;
}

}  // namespace pelage
