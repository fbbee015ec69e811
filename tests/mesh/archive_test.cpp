// Tests the reading of one file of a .tar.gz archive. The tests create the archives by the command tar.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "harness/error.hpp"
#include "harness/mesh/soup.hpp"
#include "tests/mesh/temp_folder.hpp"
#include "tests/support/refusal.hpp"

namespace pelage {
namespace {

namespace fs = std::filesystem;

// A name that is longer than the name field of a tar header, which has 100 bytes.
const std::string long_name = "meshes/" + std::string(60, 'a') + "/" + std::string(60, 'b') + ".off";

class Archive : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories((folder_.path / long_name).parent_path());
    std::string noise;
    for (unsigned i = 0, x = 1; i < 100000; ++i) noise += char((x = x * 1664525 + 1013904223) >> 24);
    std::ofstream(folder_.path / "meshes/noise.off", std::ios::binary) << noise;
    std::ofstream(folder_.path / "meshes/empty.off") << "";
    std::ofstream(folder_.path / long_name) << "OFF long";
    noise_ = noise;
    const std::string command =
        "tar -C " + folder_.path.string() + " --sort=name -czf " + whole().string() + " meshes";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  fs::path whole() const { return folder_.path / "whole.tar.gz"; }
  // Returns the message of the InputError that read_member(file, member) throws.
  static std::string error_of(const fs::path& file, const std::string& member) {
    return test::refusal([&] { read_member(file, member); }, "no error");
  }
  TempFolder folder_;
  std::string noise_;
};

TEST_F(Archive, GivesTheBytesOfAMember) {
  EXPECT_EQ(read_member(whole(), "meshes/noise.off"), noise_);
  EXPECT_EQ(read_member(whole(), "meshes/empty.off"), "");
  EXPECT_EQ(read_member(whole(), "meshes/none.off"), std::nullopt);
}

TEST_F(Archive, ReadsNamesOfMoreThan100Bytes) {
  EXPECT_EQ(read_member(whole(), long_name), "OFF long");
}

TEST_F(Archive, SaysInOneLineWhatIsWrong) {
  const fs::path none = folder_.path / "none.tar.gz", cut = folder_.path / "cut.tar.gz",
                 garbage = folder_.path / "garbage.tar.gz";
  EXPECT_EQ(error_of(none, "x"), none.string() + ": no such file");
  EXPECT_EQ(error_of(folder_.path, "x"), folder_.path.string() + ": no such file");
  const std::string bytes = test::text_of(whole()),
                    damage = ": the archive is damaged; install its package again";
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_EQ(error_of(cut, "meshes/noise.off"), cut.string() + damage);
  std::ofstream(garbage, std::ios::binary) << noise_;
  EXPECT_EQ(error_of(garbage, "meshes/noise.off"), garbage.string() + damage);
}

}  // namespace
}  // namespace pelage
