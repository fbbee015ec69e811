// Tests the error message of a build without libepoxy. It must say that OpenGL is missing and name the
// package to install.
#include <gtest/gtest.h>

#include "harness/shells/opengl/opengl.hpp"
#include "harness/system/shells/backends.hpp"
#include "harness/system/strands/backends.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

template <class Work>
void expect_refusal(const Work& work) {
  const std::string said = test::refusal([&] { work(); });
  EXPECT_NE(said.find("no OpenGL in this build: install libepoxy-dev"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos);
}

TEST(OpenGlAbsent, SaysWhatToInstall) {
  expect_refusal([] { opengl_renderer(); });
  expect_refusal([] { shells::open_opengl({}, {}); });
  expect_refusal([] { strands::open_opengl({}, {}); });
  expect_refusal([] { shader_hash(); });
}

}  // namespace
}  // namespace pelage
