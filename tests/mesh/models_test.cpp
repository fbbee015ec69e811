#include "harness/mesh/models.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "harness/error.hpp"
#include "harness/mesh/mesh.hpp"
#include "harness/mesh/quality.hpp"
#include "harness/mesh/steps.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

void expect_well_made(const Mesh& mesh) {
  float farthest = 0;
  for (const glm::vec3& p : mesh.position) farthest = std::max(farthest, glm::length(p));
  EXPECT_NEAR(farthest, 1.0f, 1e-5f) << mesh.name;
  for (const glm::vec2& uv : mesh.uv)
    EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << mesh.name;
  const Topology t = topology(mesh);
  EXPECT_TRUE(t.manifold()) << mesh.name;
  EXPECT_EQ(t.components, 1u) << mesh.name;
  const UvQuality q = uv_quality(mesh, 1024);
  EXPECT_LE(q.charts, 40u) << mesh.name;
  EXPECT_EQ(q.flipped, 0.0) << mesh.name;
  EXPECT_EQ(q.overlapping, 0.0) << mesh.name;
  EXPECT_TRUE(uv_warnings(mesh).empty()) << mesh.name;
  EXPECT_GT(q.area_low, 0.2) << mesh.name;
  EXPECT_LT(q.area_high, 1.8) << mesh.name;
}

// This test takes minutes if no mesh is cached. If all meshes are cached, it takes about one second.
using NamedFaces = std::pair<const char*, std::size_t>;
struct ModelsOfTable1 : testing::TestWithParam<NamedFaces> {};

TEST_P(ModelsOfTable1, have_the_papers_face_counts) {
  const auto mesh = load_model(GetParam().first);
  EXPECT_EQ(mesh->triangle.size(), GetParam().second);
  expect_well_made(*mesh);
}

INSTANTIATE_TEST_SUITE_P(Small, ModelsOfTable1,
                         testing::Values(NamedFaces{"torus", 9360}, NamedFaces{"pear", 20845},
                                         NamedFaces{"bunny", 142307}));
INSTANTIATE_TEST_SUITE_P(Full, ModelsOfTable1,
                         testing::Values(NamedFaces{"hippo", 44452}, NamedFaces{"cow", 92689},
                                         NamedFaces{"horse", 95533}, NamedFaces{"elephant", 154789},
                                         NamedFaces{"lion", 365118}));

TEST(Models, of_the_grass_paper_have_its_face_counts) {
  const std::pair<const char*, std::size_t> table[] = {
      {"banisch-elephant", 1148}, {"banisch-dog", 3220}, {"banisch-grass", 16}};
  for (const auto& [name, faces] : table) EXPECT_EQ(load_model(name)->triangle.size(), faces) << name;
}

TEST(Models, are_prepared_to_the_same_bits_every_time) {
  // The hash of the pear is that of the recorded rows (results/).
  for (const auto& [name, hash] :
       {std::pair("pear", "ee1169402f3b0429"), {"banisch-elephant", "c475a7c1bffbad5d"}}) {
    const auto once = load_model(name, fresh()), again = load_model(name, fresh());
    EXPECT_EQ(once->hash, again->hash) << name;
    EXPECT_TRUE(!bits_of_cgal || once->hash == hash) << once->hash;
    EXPECT_EQ(once->notes, again->notes) << name;
  }
}

TEST(Models, the_pear_is_closed_and_smooth) {
  const Surface pear = make_pear(4);
  EXPECT_EQ(pear.triangle.size(), 20u * 256);
  EXPECT_EQ(pear.point.size(), 2u + 10 * 256);  // Euler: V - E + F = 2 with E = 3F/2
  double lowest = 0, highest = 0;
  for (const glm::dvec3& p : pear.point) {
    lowest = std::min(lowest, p.y);
    highest = std::max(highest, p.y);
  }
  EXPECT_NEAR(lowest, -0.98, 0.03);
  EXPECT_NEAR(highest, 0.9, 0.1);
}

TEST(Models, can_be_had_at_another_face_count) {
  for (const std::uint32_t faces : {500u, 501u})
    EXPECT_EQ(load_model("banisch-dog", fresh(faces))->triangle.size(), faces);
}

// A model that is loaded from a mesh file keeps all large components of the file (components_test.cpp). A
// named model keeps only the largest component of its source.
TEST(Models, keep_the_largest_piece_of_their_source) {
  const auto horse = load_model("horse", fresh(2000));
  EXPECT_EQ(std::count(horse->notes.begin(), horse->notes.end(),
                       "kept the largest of 13 components, 7148 of 7172 faces"),
            1);
  EXPECT_EQ(topology(*horse).components, 1u);
}

TEST(Models, all_say_where_they_come_from) {
  for (const Model& model : models()) {
    EXPECT_FALSE(model.licence.empty()) << model.name;
    EXPECT_FALSE(model.footnote.empty()) << model.name;
  }
}

TEST(Models, a_mistake_in_the_file_is_named_with_its_line) {
  const test::Folder folder;
  const auto message = [&](const std::string& text) {
    const std::string said = test::refusal([&] { read_models(folder.write("models.toml", text)); });
    return said == "accepted" ? said : said.substr(folder.path.string().size() + 1);
  };
  const std::string head =
      "[[model]]\nname = \"a\"\nsource = \"cgal:a.off\"\nlicence = \"x\"\nfootnote = \"y\"\n";
  EXPECT_EQ(message(head), "accepted");
  EXPECT_EQ(message(head + "faces = \"many\"\n"),
            "models.toml:6: faces must be a whole number from 1 to 100000000");
  EXPECT_EQ(message(head + "faces = 0\n"), "models.toml:6: faces must be a whole number from 1 to 100000000");
  EXPECT_EQ(message(head + "rotation = [1, 2]\n"), "models.toml:6: rotation must be three numbers");
  EXPECT_EQ(
      message(head + "colour = 1\n"),
      "models.toml:6: the key colour is unknown or has no meaning here (known here: faces, footnote, licence, name, published, rotation, source, stand_in, wrap)");
  EXPECT_EQ(message(head + "published.sticks = [4, 2]\n"), "accepted");
  EXPECT_EQ(
      message(head + "published.sticks = [4, -2]\n"),
      "models.toml:6: published must be a table with entries TOPOLOGY = [number of masses, number of springs]");
  EXPECT_EQ(message("[[model]]\nname = \"a\"\n"), "models.toml:1: source = \"...\" is missing");
  EXPECT_EQ(message("x = 1\n"), "models.toml: the file has no [[model]]");
  std::string dotted = "a";
  for (int i = 1; i < 50'000; ++i) dotted += ".a";
  EXPECT_EQ(message(head + "published = {" + dotted + " = 1}\n"),
            "models.toml:6: the key has 50000 parts separated by dots; the limit is 32");
}

double uv_area(const Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::dvec2 a(mesh.uv[t.x]), b(mesh.uv[t.y]), c(mesh.uv[t.z]);
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_GT(twice, 0);
    area += 0.5 * twice;
  }
  return area;
}

TEST(Torus, is_72_by_65_quads_with_a_map_that_wraps) {
  const auto mesh = load_model("torus");
  EXPECT_EQ(mesh->triangle.size(), 9360u);
  EXPECT_EQ(mesh->welded, 72u * 65u);
  EXPECT_EQ(mesh->position.size(), 73u * 66u);
  EXPECT_TRUE(mesh->periodic_uv);
  EXPECT_NEAR(uv_area(*mesh), 1.0, 1e-5);
  // The torus has the major radius 1 / 1.4 and the minor radius 0.4 / 1.4, so that it fits into the unit
  // sphere. Polygons of 72 and 65 edges approximate the two circles of the torus, and are slightly shorter
  // than the circles.
  EXPECT_NEAR(mesh->length_per_uv.x, 2 * M_PI / 1.4, 0.01);
  EXPECT_NEAR(mesh->length_per_uv.y, 2 * M_PI * 0.4 / 1.4, 0.01);
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::vec3 a = mesh->position[t.x], b = mesh->position[t.y], c = mesh->position[t.z];
    EXPECT_LE(glm::length(a), 1.0001f);
    const glm::vec3 normal = glm::cross(b - a, c - a);
    EXPECT_GT(glm::length(normal), 0.0f);
  }
}

TEST(Torus, is_as_fine_as_its_name_says) {
  const auto coarse = load_model("torus-12x10");
  EXPECT_EQ(coarse->triangle.size(), 240u);
  EXPECT_EQ(coarse->welded, 120u);
  EXPECT_TRUE(load_model("torus-72x65")->position == load_model("torus")->position);
  EXPECT_THROW(load_model("torus-2x9"), InputError);
  EXPECT_THROW(load_model("torus-9999x9999"), InputError);
}

TEST(Square, of_the_grass_has_13_vertices_and_16_faces) {
  const auto mesh = load_model("banisch-grass");
  EXPECT_EQ(mesh->triangle.size(), 16u);
  EXPECT_EQ(mesh->position.size(), 13u);
  EXPECT_EQ(mesh->welded, 13u);
  EXPECT_FALSE(mesh->periodic_uv);
  for (const glm::uvec3& t : mesh->triangle) {
    const glm::vec3 a = mesh->position[t.x], b = mesh->position[t.y], c = mesh->position[t.z];
    EXPECT_GT(glm::cross(b - a, c - a).y, 0.0f);
  }
  const double margin = 2.0 / 256;
  EXPECT_NEAR(uv_area(*mesh), (1 - 2 * margin) * (1 - 2 * margin), 1e-6);
}

}  // namespace
}  // namespace pelage
