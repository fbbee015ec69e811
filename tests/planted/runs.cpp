#include "tests/planted/runs.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>

#include "harness/picture/image_io.hpp"
#include "harness/record/journal.hpp"
#include "harness/report/csv.hpp"
#include "tests/mesh/mesh_files.hpp"

namespace pelage::planted {
namespace {

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
    obj += fmt::format("v {:f} {:f} {:f}\n", points[i], points[i + 1], points[i + 2]);
  for (std::size_t i = 0; i < faces.size(); i += 3)
    obj += fmt::format("f {} {} {}\n", faces[i] + 1, faces[i + 1] + 1, faces[i + 2] + 1);
  folder.write("own.obj", obj);
  folder.write("own.bin", bytes_of(points) + bytes_of(faces));
  folder.write("buffered.gltf", test::gltf_text("own.bin", points.size() / 3, faces.size()));
  write_red(folder.path / "own.png", 0.5F);
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
  cli::done(*folder, "run own.toml -o results");
  return *folder;
}

}  // namespace

std::string base_experiment(const std::string& length) {
  return of_torus("layers = [4, 8]", "fur.length = " + length + "\ndynamics.wind.strength = 0.05");
}

void Runs::take(const std::string& run, const std::string& results) {
  for (const auto& entry : fs::directory_iterator(made(run).path))
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
  refused(pelage("export results"), text);
  refused(pelage("report results -o page"), text);
  refused(resume(), text);
}

void write_red(const fs::path& file, float red) {
  write_picture(file, {2, 2, std::vector<glm::vec4>(4, glm::vec4(red, 0.4F, 0.3F, 1))});
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
