// The kernels' forms for compilers that lack AVX-512 or Clang's builtins, each drawn where the compiler has
// them: copies of the kernels that find none.
#include <gtest/gtest.h>

#include <filesystem>

#include "harness/cl/program.hpp"
#include "tests/shells/opencl/picture_scenes.hpp"
#include "tests/support/fake.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

/// What a form's copy of the kernels reads where they ask for what it lacks.
struct Form {
  const char* name;
  std::string asked, reads;
};
void PrintTo(const Form& form, std::ostream* out) {
  *out << form.name;
}

const Form forms[] = {
    {"without_avx512", "defined(__AVX512", "defined(__NO_AVX512"},
    {"without_builtins", "#define BUILTIN(name) __has_builtin(name)", "#define BUILTIN(name) 0"}};

struct Forms : testing::TestWithParam<Form> {
  const fs::path original = cl::kernel_folder();
  const test::Folder folder;
  void SetUp() override {
    fs::copy(original, folder.path / "kernels", fs::copy_options::recursive);
    int found = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path / "kernels")) {
      if (!entry.is_regular_file()) continue;
      std::string text = test::text_of(entry.path());
      const int before = found;
      for (auto at = text.find(GetParam().asked); at != std::string::npos;
           at = text.find(GetParam().asked, at + GetParam().reads.size()), ++found)
        text.replace(at, GetParam().asked.size(), GetParam().reads);
      if (found != before) test::write_text(entry.path(), text);
    }
    ASSERT_GT(found, 0) << "the kernels ask in other words: " << GetParam().asked;
    cl::set_kernel_folder(folder.path / "kernels");
  }
  void TearDown() override { cl::set_kernel_folder(original); }
};

TEST_P(Forms, LookLikeTheReference) {
  if (pictures::device().info().lanes != 16) GTEST_SKIP() << "the kernels have these forms at 16 lanes only";
  const auto input = pictures::small_frame("wet");
  const Agreement agreement =
      compare(pictures::drawn_by_reference(*input), pictures::drawn_by_device(input, "tile"));
  EXPECT_TRUE(within(agreement)) << pictures::describe(agreement);
  EXPECT_GT(agreement.pixels, 5000u);
}

INSTANTIATE_TEST_SUITE_P(SixteenLanes, Forms, testing::ValuesIn(forms),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace pelage
