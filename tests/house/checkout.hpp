// A temporary checkout for tests of the repository's scripts, with stubs in place of other programs.
#pragma once
#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage::house {

using test::expect_has;
using test::expect_lacks;
using test::has;

struct Checkout : test::InFolder {
  std::filesystem::path path(const std::string& name) const { return folder.path / name; }
  std::string read(const std::string& name) const { return folder.read(name); }
  /// Writes a file, whose name is relative to the folder of the folders `bin` and `checkout`.
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(path(name).parent_path());
    folder.write(name, text);
  }
  void write_program(const std::string& name, const std::string& body) const {
    write(name, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(path(name), std::filesystem::perms::owner_all);
  }
  /// Makes a program that the commands of shell() find before the programs of the system.
  void stub(const std::string& program, const std::string& body) const {
    write_program("bin/" + program, body);
  }
  void copy_of_repository(const std::string& file) const {
    std::filesystem::create_directories(path("checkout/" + file).parent_path());
    std::filesystem::copy_file(std::filesystem::path(PELAGE_SOURCE_DIR) / file, path("checkout/" + file));
  }
  /// Runs a command in the checkout. Its messages are in the file `output`. Returns its exit code.
  int shell(const std::string& command) const {
    const int status = std::system(
        fmt::format(
            "cd '{}' && export PATH='{}':\"$PATH\" GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b && ({}) >'{}' 2>&1",
            path("checkout").string(), path("bin").string(), command, path("output").string())
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

}  // namespace pelage::house
