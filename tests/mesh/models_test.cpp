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
  double volume = 0;
  for (const auto& [a, b, c] : pear.triangle)
    volume += glm::dot(pear.point[a], glm::cross(pear.point[b], pear.point[c])) / 6;
  EXPECT_NEAR(volume, 1.51499144593, 1e-10);
  glm::dvec3 squares(0);
  for (const glm::dvec3& p : pear.point) squares += p * p;
  EXPECT_NEAR(squares.x, 350.048741498, 1e-8);
  EXPECT_NEAR(squares.z, 345.196247818, 1e-8);
}

TEST(Models, can_be_had_at_another_face_count) {
  for (const auto& [faces, hash] : {std::pair(500u, "9e9ea9c04d66a6ba"), {501u, "c423a605e62dc930"}}) {
    const auto mesh = load_model("banisch-dog", fresh(faces));
    EXPECT_EQ(mesh->triangle.size(), faces);
    EXPECT_TRUE(!bits_of_cgal || mesh->hash == hash) << mesh->hash;
  }
}

TEST(Models, change_their_face_count_only_where_they_must) {
  std::vector<double> told;
  const auto notes = [&](std::uint32_t faces) {
    return with_faces(make_pear(0), faces, {0, 1, 0}, "a", [&](double part) { told.push_back(part); }).notes;
  };
  EXPECT_EQ(notes(80)[0], "subdivided 20 faces into 80 by Loop subdivision (steps: 1)");
  EXPECT_EQ(notes(80).size() + notes(19).size(), 2u);
  EXPECT_TRUE(told.empty());
  notes(310);  // of 320 faces, of which a collapse removes two
  EXPECT_EQ(std::pair(told.front(), told.back()), std::pair(0.0, 0.8));
}

// A model that is loaded from a mesh file keeps all large components of the file (components_test.cpp). A
// named model keeps only the largest component of its source.
TEST(Models, keep_the_largest_piece_of_their_source) {
  const auto horse = load_model("horse", fresh(2000));
  EXPECT_EQ(std::ranges::count(horse->notes, "kept the largest of 13 components, 7148 of 7172 faces"), 1);
  EXPECT_EQ(topology(*horse).components, 1u);
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
  EXPECT_EQ(message(head + "published.sticks = [100000000, 0]\n"), "accepted");
  const auto sticks = read_models(folder.path / "models.toml")[0].published.at("sticks");
  EXPECT_EQ(sticks, (std::array<std::uint32_t, 2>{100'000'000, 0}));
  for (const char* counts : {"[4, -2]", "[4, 100000001]", "[4, 2, 1]", "[4, 'two']", "4"})
    EXPECT_EQ(
        message(head + "published.sticks = " + counts + "\n"),
        "models.toml:6: published must be a table with entries TOPOLOGY = [number of masses, number of springs] or mesh = [number of vertices, number of faces]");
  EXPECT_EQ(message("[[model]]\nname = \"a\"\n"), "models.toml:1: source = \"...\" is missing");
  EXPECT_EQ(message("x = 1\n"), "models.toml: the file has no [[model]]");
  std::string dotted = "a";
  for (int i = 1; i < 50'000; ++i) dotted += ".a";
  EXPECT_EQ(message(head + "published = {" + dotted + " = 1}\n"),
            "models.toml:6: the key has 50000 parts separated by dots; the limit is 32");
}

TEST(Torus, is_72_by_65_quads_with_a_map_that_wraps) {
  const auto mesh = load_model("torus", fresh());
  EXPECT_EQ(mesh->triangle.size(), 9360u);
  EXPECT_EQ(mesh->welded, 72u * 65u);
  EXPECT_EQ(mesh->position.size(), 73u * 66u);
  EXPECT_TRUE(mesh->periodic_uv);
  EXPECT_EQ(topology(*mesh).genus, 1);
  EXPECT_TRUE(!bits_of_cgal || mesh->hash == "1eb4167d06e99db2") << mesh->hash;
}

TEST(Torus, is_as_fine_as_its_name_says) {
  const auto coarse = load_model("torus-12x10");
  EXPECT_EQ(coarse->triangle.size(), 240u);
  EXPECT_EQ(coarse->welded, 120u);
  EXPECT_TRUE(load_model("torus-72x65")->position == load_model("torus")->position);
  for (const char* name : {"torus-2x9", "torus-9999x9999"}) EXPECT_THROW(require_model(name), InputError);
  for (const char* name : {"torus-3x3", "torus-2000x2000"}) require_model(name);
}

TEST(Square, of_the_grass_has_13_vertices_and_16_faces) {
  const auto mesh = load_model("banisch-grass", fresh());
  EXPECT_TRUE(!bits_of_cgal || mesh->hash == "abf175265eccb231") << mesh->hash;
  EXPECT_EQ(mesh->triangle.size(), 16u);
  EXPECT_EQ(mesh->position.size(), 13u);
  EXPECT_EQ(mesh->welded, 13u);
  EXPECT_FALSE(mesh->periodic_uv);
}

}  // namespace
}  // namespace pelage
