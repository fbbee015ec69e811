// Tests that docs/pelage.1 describes exactly the commands and options that --help lists.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

namespace {

using Options = std::map<std::string, std::set<std::string>>;  // command -> its long options except --help

std::set<std::string> long_options(const std::string& text) {
  static const std::regex option("(^|[\\s,\"])--([a-z][a-z-]*)");
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), option), end; match != end; ++match)
    found.insert((*match)[2]);
  for (const char* everywhere : {"help", "version", "kernels"}) found.erase(everywhere);
  return found;
}

std::string output_of(const std::string& arguments) {
  FILE* pipe = ::popen(fmt::format("'{}' {} 2>&1", PELAGE_BINARY, arguments).c_str(), "r");
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), n);
  EXPECT_EQ(::pclose(pipe), 0) << text;
  return text;
}

Options from_help() {
  const std::string all = output_of("--help");
  std::string commands = all.substr(all.find("Subcommands:") + 12);
  static const std::regex name("\n  ([a-z-]+) ");
  Options options;
  for (std::sregex_iterator match(commands.begin(), commands.end(), name), end; match != end; ++match) {
    // A line that describes an option starts with two blanks and a dash. Other lines may mention options of
    // other commands, so they are skipped.
    std::string lines;
    static const std::regex line("\n  (-[^ ]+)");
    const std::string help = output_of((*match)[1].str() + " --help");
    for (std::sregex_iterator at(help.begin(), help.end(), line); at != end; ++at)
      lines.append(1, ' ').append((*at)[1]);
    options[(*match)[1]] = long_options(lines);
  }
  return options;
}

// Returns the options that the manual page lists. In a section of the page, the line after each .TP contains
// the names of an option.
Options from_page(std::string page) {
  page = std::regex_replace(page, std::regex("\\\\f[A-Z]"), "");
  page = std::regex_replace(page, std::regex("\\\\-"), "-");
  Options options;
  static const std::regex section("\n\\.SS pelage ([a-z-]+)"), heading("\n\\.TP\n([^\n]*)");
  const std::string commands = page.substr(0, page.find("\n.SH ENVIRONMENT"));
  for (std::sregex_iterator match(commands.begin(), commands.end(), section), end; match != end; ++match) {
    const auto start = static_cast<std::size_t>(match->position());
    const std::string text = commands.substr(start, commands.find("\n.SS", start + 1) - start);
    std::string lines;
    for (std::sregex_iterator at(text.begin(), text.end(), heading); at != end; ++at)
      lines.append(1, ' ').append((*at)[1]);
    options[(*match)[1]] = long_options(lines);
  }
  return options;
}

std::string text_of(const Options& options) {
  std::string text;
  for (const auto& [command, names] : options)
    text += fmt::format("{}: {}\n", command, fmt::join(names, " "));
  return text;
}

}  // namespace

TEST(Manual, SaysWhatHelpSays) {
  std::ifstream stream(PELAGE_SOURCE_DIR "/docs/pelage.1");
  const Options page = from_page({std::istreambuf_iterator<char>(stream), {}});
  const Options help = from_help();
  EXPECT_GE(help.size(), 5u);
  EXPECT_EQ(text_of(page), text_of(help));
}

TEST(Manual, APlantedDifferenceIsSeen) {
  const std::string text =
      "\n.SS pelage run \\fIfile\\fR\n.TP\n.BI \\-\\-preset \" NAME\"\nnot --this\n.TP\n.BR \\-o \", \" "
      "\\-\\-output "
      "\"\\fIDIR\\fR\"\nfolder\n.SS pelage list\nno options\n.SH ENVIRONMENT\n.TP\n--nor-this\n";
  EXPECT_EQ(text_of(from_page(text)), "list: \nrun: output preset\n");
}

// --help prints the permitted values of an argument as {a,b,c}. The page must name each of them in the
// section of the command.
TEST(Manual, NamesThePermittedValuesOfCheckAndRender) {
  std::ifstream stream(PELAGE_SOURCE_DIR "/docs/pelage.1");
  std::string page{std::istreambuf_iterator<char>(stream), {}};
  page = std::regex_replace(page, std::regex("\\\\f[A-Z]"), "");
  page = std::regex_replace(page, std::regex("\\\\-"), "-");
  static const std::regex list("\\{([^}]+)\\}"), word("[^,]+");
  for (const std::string command : {"check", "render"}) {
    const std::size_t start = page.find("\n.SS pelage " + command);
    const std::string section = page.substr(start, page.find("\n.SS", start + 1) - start);
    const std::string help = output_of(command + " --help");
    std::size_t values = 0;
    for (std::sregex_iterator found(help.begin(), help.end(), list), end; found != end; ++found) {
      const std::string all = (*found)[1];
      for (std::sregex_iterator value(all.begin(), all.end(), word); value != end; ++value, ++values)
        EXPECT_TRUE(std::regex_search(section, std::regex("(^|[^a-z-])" + value->str() + "($|[^a-z-])")))
            << command << ": " << value->str();
    }
    EXPECT_GE(values, 6U) << help;
  }
}
