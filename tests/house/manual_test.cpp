// Tests that the manual page describes the commands and options that --help lists.
#include <regex>

#include "tests/cli/shell.hpp"
#include "tests/support/texts.hpp"

namespace {

std::string output_of(const std::string& arguments) {
  const pelage::cli::Folder folder;
  return pelage::cli::done(folder, arguments).out;
}

std::string plain(const std::string& page) {
  return std::regex_replace(std::regex_replace(page, std::regex("\\\\f[A-Z]"), ""), std::regex("\\\\-"), "-");
}

}  // namespace

TEST(Manual, SaysWhatHelpSays) {
  const std::string page = plain(output_of("manual " PELAGE_SOURCE_DIR "/docs/pelage.1"));
  pelage::test::expect_has(page, {"\n.SH NAME\n", "\n.SH ENVIRONMENT\n", "\n.SH EXAMPLES\n"});
  const std::string all = output_of("--help");
  const std::string commands = all.substr(all.find("Subcommands:") + 12);
  static const std::regex name("\n  ([a-z-]+) "), option("\n  (-[^ ]+)"), list("\\{([^}]+)\\}");
  int tested = 0;
  for (std::sregex_iterator match(commands.begin(), commands.end(), name), end; match != end; ++match) {
    const std::string command = (*match)[1], help = output_of(command + " --help");
    const std::size_t start = page.find("\n.SS pelage " + command);
    ASSERT_NE(start, std::string::npos) << command;
    const std::string section = page.substr(start, page.find("\n.S", start + 1) - start);
    // A line that describes an option starts with two blanks and a dash. The permitted values of an option
    // stand in braces.
    for (std::sregex_iterator at(help.begin(), help.end(), option); at != end; ++at, ++tested)
      if (at->str(1) != "-h,--help") {
        EXPECT_NE(section.find(std::regex_replace(at->str(1), std::regex(".*,"), "")), std::string::npos)
            << command << ": " << at->str(1);
      }
    for (std::sregex_iterator at(help.begin(), help.end(), list); at != end; ++at)
      EXPECT_NE(section.find(at->str(1)), std::string::npos) << command << ": " << at->str(1);
  }
  EXPECT_GT(tested, 100);
}
