
#include "harness/cl/program.hpp"
#include "harness/shells/opencl/shells.hpp"
#include "harness/tuning/tuning_search.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic.hpp"

namespace pelage {
namespace {

std::shared_ptr<const FrameInput> small() {
  return std::make_shared<FrameInput>(
      synthetic::frame(synthetic::lively_scene(), synthetic::torus(), 48, 32, 60));
}

/// Returns the fault of one run of the stage's kernels in their default configuration, after `text` was
/// replaced by `replacement` in a copy of the kernel source `file`.
std::string fault_of(const std::string& stage, const std::string& file = {}, const std::string& text = {},
                     const std::string& replacement = {}) {
  const fs::path original = cl::kernel_folder();
  const test::Folder folder;
  fs::copy(original, folder.path / "kernels", fs::copy_options::recursive);
  if (!file.empty()) folder.edit("kernels/" + file, text, replacement);
  cl::set_kernel_folder(folder.path / "kernels");
  std::string fault;
  try {
    const auto contender = tuning_scene(stage, "torus", cl::choose_device(""), small()).make({});
    contender->run_ms();
    fault = contender->fault();
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
  }
  cl::set_kernel_folder(original);
  return fault;
}

TEST(Contenders, HaveNoFaultAsTheyAre) {
  EXPECT_EQ(fault_of("simulate"), "");
  EXPECT_EQ(fault_of("wet"), "");
}

// The test changes a kernel: for the first 16 of about 1500 strands, the kernel now adds 1e-3 of the mesh
// radius to the x coordinate of the tip. This error is larger than tolerance::usual_tip.
TEST(Contenders, MayMoveNoStrandElsewhere) {
  EXPECT_NE(fault_of("simulate", "simulate/simulate.cl", "  store_column3(a.tip, state, TIP_X",
                     "  if (block * LANES < 16) a.tip.x += 1e-3f;\n"
                     "  store_column3(a.tip, state, TIP_X"),
            "");
}

TEST(Contenders, MayWetNoTexelMore) {
  EXPECT_NE(fault_of("wet", "wet/cover.clh", "= m.wetness;", "= 0.5f * m.wetness;"), "");
  EXPECT_NE(fault_of("wet", "wet/cover.clh", "= m.radius;", "= 0.5f * m.radius;"), "");
}

// The tuning file of `pelage tune rasterize` and a row (tests/subjects/shells_test.cpp) have equal hashes of
// equal kernels.
TEST(Contenders, HaveTheKernelHashThatARowHas) {
  const auto contender = tuning_scene("rasterize", "torus", cl::choose_device(""), small()).make({});
  const Shells shells(cl::choose_device(""), small());
  EXPECT_EQ(contender->kernel_hash(), shells.kernel_hash());
  EXPECT_EQ(contender->kernel_hash().size(), 16u);
}

}  // namespace
}  // namespace pelage
