// Tests that the repository obeys its own rules, and that the functions of rules.hpp find deliberate
// violations.
#include <functional>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

using namespace pelage::house;

namespace {

const Links& links() {
  static const Links known = room_links(pelage::test::text_of(root / "CMakeLists.txt"));
  return known;
}

std::size_t faults_of(const std::string& path, const std::string& include) {
  return include_faults(path, "// first line\n#include " + include + "\n", links()).size();
}

/// Expects that `faults_in`, a rule of rules.hpp, finds nothing in the files of the checkout.
void expect_kept(const std::function<Faults(const std::string& path, const std::string& text)>& faults_in) {
  const std::vector<std::string> files = written_files();
  EXPECT_GT(files.size(), 50u);
  for (const std::string& file : files)
    for (const std::string& fault : faults_in(file, pelage::test::text_of(root / file)))
      ADD_FAILURE() << fault;
}

}  // namespace

TEST(House, KeepsItsRulesOfInclusion) {
  expect_kept([](const auto& path, const auto& text) { return include_faults(path, text, links()); });
}

TEST(House, KeepsItsRulesOfText) {
  expect_kept(text_faults);
}

TEST(House, KeepsOneCopyOfAComputationInTheKernels) {
  expect_kept(copy_faults);
}

TEST(House, LaunchesKernelsInOnePlaceAndInGroupsOfAKnownSize) {
  expect_kept(launch_faults);
  pelage::test::expect_has(pelage::test::text_of(root / "harness/cl/program.cpp"), "clEnqueueNDRangeKernel(");
}

TEST(House, PlantedLaunchesAreFound) {
  const std::string of_driver =
      "check(clEnqueueNDRangeKernel(q, k, 1, nullptr, &n,\n  nullptr, 0, nullptr, &event));";
  const std::string of_size =
      "check(clEnqueueNDRangeKernel(q, k, 1, nullptr, &n, &group, 0, nullptr, &event));";
  EXPECT_EQ(launch_faults("harness/cl/program.cpp", of_driver).size(), 1u);
  EXPECT_EQ(launch_faults("harness/cl/program.cpp", of_size).size(), 0u);
  EXPECT_EQ(
      launch_faults("harness/cl/program.cpp", "group > 0 ? clEnqueueTask(q, k, 0, nullptr, &event) : 0;")
          .size(),
      1u);
  EXPECT_EQ(launch_faults("bench/lod.cpp", of_size).size(), 1u);
}

TEST(House, LinksAreReadFromCMake) {
  const Links small = room_links(
      "function(pelage_room name)\n"
      "pelage_room(a fmt::fmt)\npelage_room(b pelage_a PRIVATE pelage_d) # pelage_e\npelage_room(d)\n"
      "pelage_room(c pelage_b\n  glm::glm)\n");
  EXPECT_EQ(small.at("b"), (std::set<std::string>{"a", "d"}));
  EXPECT_EQ(small.at("c"), (std::set<std::string>{"a", "b"})) << "a private link is not handed on";
  EXPECT_TRUE(small.at("a").empty());
  ASSERT_TRUE(links().count("shells_opencl") == 1);
  EXPECT_TRUE(links().at("shells_opencl").count("cl") == 1);
  EXPECT_TRUE(links().at("scene").count("cl") == 0);
}

// Programs that only read results need neither OpenCL nor the mesh code. CMake links base to every room.
TEST(House, TheFileFormatNeedsNoRenderer) {
  const auto libraries = [](const std::string& room) {
    const std::string text =
        std::regex_replace(pelage::test::text_of(root / "CMakeLists.txt"), std::regex("#[^\n]*"), "");
    std::smatch call;
    std::regex_search(text, call, std::regex("pelage_room\\(" + room + "\\s+([^)]*)\\)"));
    std::istringstream words(call[1]);
    return std::set<std::string>(std::istream_iterator<std::string>(words), {});
  };
  EXPECT_EQ(libraries("base"), (std::set<std::string>{"fmt::fmt"}));
  EXPECT_EQ(libraries("record"), (std::set<std::string>{"nlohmann_json::nlohmann_json", "PRIVATE",
                                                        "ZLIB::ZLIB", "PkgConfig::RE2"}));
  EXPECT_TRUE(links().at("record").empty());
  EXPECT_EQ(links().at("experiment"), (std::set<std::string>{"record", "scene"}));
}

TEST(House, PlantedInclusionsAreFound) {
  const std::pair<const char*, const char*> forbidden[] = {
      {"harness/scene/scene_read.cpp", "<CL/cl.h>"},
      {"harness/commands/run.cpp", "<CL/cl.h>"},
      {"harness/error.hpp", "\"CL/cl.h\""},
      {"harness/scene/scene_read.cpp", "<CGAL/Surface_mesh.h>"},
      {"harness/commands/mesh.cpp", "<tiny_gltf.h>"},
      {"harness/report/images.cpp", "<OpenImageIO/imageio.h>"},
      {"harness/commands/render.cpp", "<epoxy/gl.h>"},
      {"harness/scene/scene_read.cpp", "\"harness/shells/opencl/shells.hpp\""},
      {"harness/mesh/load.cpp", "\"harness/scene/scene.hpp\""},
      {"harness/shells/opencl/shells.cpp", "\"harness/shells/reference/reference.hpp\""},
      {"harness/springs/model/layout.cpp", "\"harness/springs/opencl/mass_springs.hpp\""},
      {"harness/shells/reference/render.cpp", "\"harness/shells/opencl/shells.hpp\""},
      {"harness/measure/runner.cpp", "\"harness/subjects/pipelines.hpp\""},
      {"harness/record/row.hpp", "\"harness/cl/program.hpp\""},
      {"harness/record/contradiction.cpp", "\"harness/compare/tolerances.hpp\""},
      {"harness/base/median.cpp", "\"harness/record/row.hpp\""},
      {"harness/cl/device.cpp", "\"harness/commands/commands.hpp\""},
      {"harness/cl/device.cpp", "\"../error.hpp\""},
      {"harness/shells/opencl/shells.cpp", "\"kernels/wet/equations.clh\""},
      {"harness/shells/opencl/shells.cpp", "\"tests/support/opencl_as_cpp.hpp\""},
      {"kernels/wet/equations.clh", "\"simulate/params.h\""},
      {"kernels/wet/equations.clh", "\"wet/lists.clh\""},
      {"kernels/wet/equations.clh", "<math.h>"},
      {"kernels/wet/wet.cl", "\"simulate/equations.clh\""},
      {"kernels/wet/wet.cl", "\"harness/error.hpp\""},
      {"kernels/wet/params.h", "<stdint.h>"},
      {"kernels/common/powers.clh", "\"wet/params.h\""},
      {"kernels/dialect.clh", "\"common/powers.clh\""}};
  for (const auto& [path, include] : forbidden)
    EXPECT_EQ(faults_of(path, include), 1u) << path << " includes " << include;

  const std::pair<const char*, const char*> allowed[] = {
      {"harness/cl/device.hpp", "<CL/cl.h>"},
      {"harness/mesh/repair.cpp", "<CGAL/Surface_mesh.h>"},
      {"harness/shells/opencl/shells.cpp", "\"kernels/wet/params.h\""},
      {"harness/shells/opencl/shells.cpp", "\"harness/cl/program.hpp\""},
      {"harness/scene/scene_read.cpp", "\"harness/error.hpp\""},
      {"harness/commands/run.cpp", "\"harness/shells/opencl/shells.hpp\""},
      {"harness/commands/commands.hpp", "<CLI/CLI.hpp>"},
      {"kernels/wet/equations.clh", "\"wet/params.h\""},
      {"kernels/wet/equations.clh", "\"common/powers.clh\""},
      {"kernels/wet/wet.cl", "\"wet/equations.clh\""},
      {"tests/shells/shim.cpp", "\"kernels/wet/equations.clh\""}};
  for (const auto& [path, include] : allowed)
    EXPECT_EQ(faults_of(path, include), 0u) << path << " includes " << include;
}

TEST(House, PlantedTextsAreFound) {
  const auto count = [](const std::string& text) { return text_faults("harness/x.cpp", text).size(); };
  EXPECT_EQ(count("int x;\n"), 0u);
  EXPECT_EQ(count("int x;"), 1u) << "no newline";
  EXPECT_EQ(count("int x; \n"), 1u) << "trailing blank";
  EXPECT_EQ(count("int x;\r\n"), 1u) << "carriage return";
  EXPECT_EQ(count(std::string("// TO") + "DO later\n"), 1u);
  EXPECT_EQ(count(std::string("open(\"/ho") + "me/me/x\")\n"), 1u);
  EXPECT_EQ(count(std::string("see /wo") + "rk/notes\n"), 1u);
  EXPECT_EQ(count("a/tmp/b and $XDG/tmp/x and /usr/share/doc\n"), 0u);
  std::string lines;
  for (int i = 0; i < 400; ++i) lines += "x\n";
  EXPECT_EQ(count(lines), 0u);
  EXPECT_EQ(count(lines + "x\n"), 1u);
  EXPECT_EQ(text_faults("long.md", lines + "x\n").size(), 0u);
  std::string words;
  for (int i = 0; i < 7000; ++i) words += "a\n";
  EXPECT_EQ(text_faults("long.md", words).size(), 0u);
  EXPECT_EQ(text_faults("long.md", words + "a\n").size(), 1u);
}

// Lines of the two computations that rules.hpp describes.
TEST(House, PlantedCopiesOfAComputationAreFound) {
  const char* const copies[] = {"  h.iw = fma(b2, iw2 - iw, fma(b1, iw1 - iw, iw));",
                                "  h.b1 = b1 * iw1 * w;",
                                "  h.b2 = b2 * t.iw2 * w;",
                                "  h.b2 = w * d->iw2[slot];",
                                "  h.b1 = d->iw1[slot] * b1 * w;",
                                "  p.uv = vec2(c[0], c[1]);",
                                "  p->a = vec3(row[2], row[3], row[4]);",
                                "  p.along_u = vec3(t.s0, t.s1, t.s2);",
                                "  p.curl_v = vec3(c[3], c[4], c[5]);"};
  for (const char* copy : copies)
    for (const char* file : {"kernels/rasterize/workgroup/batch.clh", "kernels/rasterize/tile/points.clh"})
      EXPECT_EQ(copy_faults(file, std::string("// first line\n") + copy + "\n").size(), 1u) << copy;
  const char* const others[] = {"  s.iw1 = s.swapped ? c.iw : b.iw;",
                                "  float iw[SLOTS], iw1[SLOTS], iw2[SLOTS];",
                                "  bool seen = fmax(t.iw, fmax(t.iw1, t.iw2)) >= least_iw;",
                                "  Planes p = {t.slope[0].right, t.iw, t.iw1, t.iw2};",
                                "  // b1 * iw1 * w",
                                "  f.uv = vec2(fma(REAL(l.rate), f.pull.x, p.x), f.uv.y);",
                                "  c.a = column3(vertex, ROOT_X, s->vertices, block);"};
  for (const char* other : others)
    EXPECT_TRUE(copy_faults("kernels/rasterize/tile/points.clh", other).empty()) << other;
  EXPECT_TRUE(copy_faults("harness/shells/reference/render.cpp", copies[1]).empty());
  // copies[1] is perspective-correct interpolation. Each of the two files must contain its own computation.
  EXPECT_TRUE(copy_faults("kernels/rasterize/coverage/perspective.clh", copies[1]).empty());
  EXPECT_EQ(copy_faults("kernels/rasterize/coverage/perspective.clh", "").size(), 1u);
  EXPECT_EQ(copy_faults("kernels/rasterize/shading/surface.clh", "").size(), 1u);
}
