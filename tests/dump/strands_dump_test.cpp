// Tests the datasets of a dump of strands, with which the second table of docs/dump.md is written.
#include <unistd.h>

#include <cstdlib>

#include "harness/dump/dump.hpp"
#include "tests/dump/table.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// Every dataset of a dump of strands that other dumps do not have has a line in docs/dump.md. The sizes of
// the frame differ from each other and from the constants of docs/dump.md.
TEST(StrandsDumpTable, IsWrittenFromTheDump) {
  Scene scene;
  scene.model = "torus";
  scene.image.width = 60;
  scene.image.height = 40;
  scene.strands.layers.resize(5, scene.strands.layers.front());
  for (auto& layer : scene.strands.layers) layer.count = 61;
  scene.strands.fills.resize(9);
  const auto input =
      strands::prepare_strands(scene, std::make_shared<Mesh>(synthetic::grid(synthetic::torus(), 9, 6)));
  const StrandFrame frame = reference_strands(*input, 1);
  std::string folder = (fs::temp_directory_path() / "pelage-dump-XXXXXX").string();
  ASSERT_TRUE(mkdtemp(folder.data()));
  const fs::path path = fs::path(folder) / "frame.h5";
  write_dump(path, {scene, *input->mesh, frame.picture, "strands-reference", 1},
             [&](Hdf5File& file) { dump::write_strand_frame(file, *input, frame); });
  Dumped dump{"", datasets_of(path), {}};
  fs::remove_all(folder);
  const auto text = [](auto number) { return fmt::format("{}", number); };
  dump.symbols = {{text(input->fur.keys.size()), "K"},
                  {text(input->fur.strands.size()), "S"},
                  {text(frame.order.size()), "D"},
                  {text(input->look.fills.size()), "L"},
                  {text(input->look.layers.size()), "B"},
                  {text(input->look.film.size()), "M"},
                  {text(input->mesh->position.size()), "V"},
                  {"40", "height"},
                  {"60", "width"}};
  EXPECT_EQ(dump.symbols.size(), 9u) << "two sizes of the frame are equal";
  std::erase_if(dump.file, [](const auto& one) {
    return one.first == "scene" || one.first.starts_with("mesh/") || one.first.starts_with("camera/");
  });
  EXPECT_GT(dump.file.size(), 20u);
  expect_in_document("strands", table_of({dump}));
}

}  // namespace
}  // namespace pelage
