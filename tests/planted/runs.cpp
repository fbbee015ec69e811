#include "tests/planted/runs.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>

#include "harness/picture/image_io.hpp"
#include "harness/record/journal.hpp"
#include "harness/report/csv.hpp"

namespace pelage::planted {
namespace {

namespace fs = std::filesystem;

constexpr int around = 24, across = 12;

/// Returns the vertices of a torus around the y axis. `thickness` is the radius of the tube.
std::vector<float> torus_points(float thickness) {
  std::vector<float> points;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const float a = 2 * std::numbers::pi_v<float> * float(i) / around,
                  b = 2 * std::numbers::pi_v<float> * float(j) / across;
      const float radius = 1 + thickness * std::cos(b);
      points.insert(points.end(), {radius * std::cos(a), thickness * std::sin(b), radius * std::sin(a)});
    }
  return points;
}

std::vector<std::uint16_t> torus_faces() {
  std::vector<std::uint16_t> faces;
  const auto vertex = [](int i, int j) { return std::uint16_t((i % around) * across + j % across); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j)
      for (const std::uint16_t v : {vertex(i, j), vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j),
                                    vertex(i, j + 1), vertex(i + 1, j + 1)})
        faces.push_back(v);
  return faces;
}

std::string bytes_of(const auto& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

/// Writes the mesh files, the texture and the experiment of the run "files" (see Runs).
void write_files(const Folder& folder) {
  const std::vector<float> points = torus_points(0.4F);
  const std::vector<std::uint16_t> faces = torus_faces();
  std::string obj;
  for (std::size_t i = 0; i < points.size(); i += 3)
    obj += "v " + std::to_string(points[i]) + " " + std::to_string(points[i + 1]) + " " +
           std::to_string(points[i + 2]) + "\n";
  for (std::size_t i = 0; i < faces.size(); i += 3)
    obj += "f " + std::to_string(faces[i] + 1) + " " + std::to_string(faces[i + 1] + 1) + " " +
           std::to_string(faces[i + 2] + 1) + "\n";
  folder.write("own.obj", obj);
  folder.write("own.bin", bytes_of(points) + bytes_of(faces));
  const std::string all = std::to_string(4 * points.size()), rest = std::to_string(2 * faces.size()),
                    both = std::to_string(4 * points.size() + 2 * faces.size());
  folder.write(
      "buffered.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":)" +
          both + R"(,"uri":"own.bin"}],"bufferViews":[{"buffer":0,"byteLength":)" + all +
          R"(},{"buffer":0,"byteOffset":)" + all + R"(,"byteLength":)" + rest +
          R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
          std::to_string(points.size() / 3) +
          R"(,"type":"VEC3","min":[-2,-2,-2],"max":[2,2,2]},{"bufferView":1,"componentType":5123,"count":)" +
          std::to_string(faces.size()) + R"(,"type":"SCALAR"}]})");
  write_picture(folder.path() / "own.png", {2, 2, std::vector<glm::vec4>(4, glm::vec4(0.5F, 0.4F, 0.3F, 1))});
  folder.write("own.toml", experiment("model = [\"own.obj\", \"buffered.gltf\"]\nsize = [\"320x240\"]",
                                      "fur.layers = 4\ncoat.image = \"own.png\""));
}

/// Returns the folder with the results of the run `run`. The first call for each name runs pelage.
const Folder& made(const std::string& run) {
  static std::map<std::string, std::unique_ptr<Folder>> known;
  std::unique_ptr<Folder>& folder = known[run];
  if (folder) return *folder;
  folder = std::make_unique<Folder>();
  if (run == "files")
    write_files(*folder);
  else
    folder->write("own.toml", base_experiment(run == "other" ? "0.12" : "0.1"));
  done(*folder, "run own.toml -o results");
  return *folder;
}

}  // namespace

std::string base_experiment(const std::string& length) {
  return of_torus("layers = [4, 8]", "fur.length = " + length + "\ndynamics.wind.strength = 0.05");
}

void Runs::take(const std::string& run, const std::string& results) {
  for (const auto& entry : fs::directory_iterator(made(run).path()))
    fs::copy(entry.path(),
             path(entry.path().filename() == "results" ? results : entry.path().filename().string()),
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

void Runs::edit_kernel(const std::string& file, const std::string& from, const std::string& to) const {
  fs::copy(PELAGE_SOURCE_DIR "/kernels", path("mine"), fs::copy_options::recursive);
  folder.edit("mine/" + file, from, to);
}

fs::path Runs::journal(const std::string& results) const {
  const std::vector<fs::path> all = journals_of({path(results).string()});
  EXPECT_EQ(all.size(), 1U);
  return all.front();
}

std::vector<Row> Runs::rows(const std::string& results) const {
  return read_contents(journal(results)).rows;
}

void Runs::reseal(const std::function<void(Row&)>& change, const std::string& results) const {
  std::string text;
  for (Row row : rows(results)) {
    change(row);
    text += to_line(row) + "\n";
  }
  std::ofstream(journal(results), std::ios::binary) << text;
}

void Runs::expect_apart(const std::function<void(Row&)>& change, const std::string& differs,
                        const std::string& text) {
  take("base");
  take("base", "second");
  reseal(
      [&](Row& row) {
        row.run_id += "1";
        change(row);
        slow_down(row);
      },
      "second");
  EXPECT_EQ(kept_apart({path("results"), path("second")}), std::vector<std::string>{differs});
  fs::rename(path("results"), path("first"));
  fs::rename(path("second"), path("results"));
  refused(resume(), text);
}

void Runs::expect_unreadable(const std::string& text) {
  refused(cli::pelage(folder, "export results"), text);
  refused(cli::pelage(folder, "report results -o page"), text);
  refused(resume(), text);
}

void slow_down(Row& row) {
  for (double& ms : row.samples["frame"].wall_ms) ms *= 1.5;
  row.metrics.erase("fragments_per_s");
}

std::vector<std::string> kept_apart(const std::vector<fs::path>& results) {
  std::vector<std::string> differs;
  const std::vector<InputSet> sets = input_sets(read_results({results.begin(), results.end()}));
  for (std::size_t i = 1; i < sets.size(); ++i) differs.push_back(sets[i].differs);
  return differs;
}

std::vector<Cell> cells_in(const std::vector<fs::path>& results) {
  return cells_of(read_results({results.begin(), results.end()}));
}

}  // namespace pelage::planted
