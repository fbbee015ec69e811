// Up to 16 files of a folder are compiled as one unit (docs/code.md), so the functions of their anonymous
// namespaces are one set of overloads. If two files had functions of the same name, a call could select the
// function of the other file without a word. The names must therefore differ.
#include <filesystem>
#include <map>
#include <regex>

#include "tests/house/rules.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace fs = std::filesystem;

namespace {

/// Returns the names of the functions in the anonymous namespaces of a source text. clang-format puts the
/// definitions of a namespace at the start of a line.
std::set<std::string> anonymous_functions(const std::string& text) {
  static const std::regex definition(
      R"(^(?!return|using|struct|class|TEST|INSTANTIATE|static_assert)[A-Za-z_][\w:<>,&*\s\[\]]*[\s&*](\w+)\()");
  std::set<std::string> names;
  bool inside = false;
  for (const std::string& line : pelage::test::lines_of(text)) {
    if (line == "namespace {") inside = true;
    if (line == "}  // namespace") inside = false;
    std::smatch found;
    if (inside && std::regex_search(line, found, definition)) names.insert(found[1]);
  }
  return names;
}

}  // namespace

TEST(House, NoTwoFilesOfAFolderHaveAnonymousFunctionsOfTheSameName) {
  std::map<std::string, std::string> file_of;  // folder and name -> file
  for (const char* top : {"harness", "tests"})
    for (const fs::path& path : pelage::test::files_below(pelage::house::root / top, ".cpp")) {
      const std::string file = path.lexically_relative(pelage::house::root).generic_string();
      for (const std::string& name : anonymous_functions(pelage::test::text_of(path))) {
        const auto [place, added] =
            file_of.try_emplace(fs::path(file).parent_path().string() + " " + name, file);
        EXPECT_TRUE(added) << file << ": " << place->second << " also has a function " << name
                           << "() in its anonymous namespace; name one of them otherwise";
      }
    }
  EXPECT_GT(file_of.size(), 1000u);
}

TEST(House, PlantedAnonymousFunctionsAreFound) {
  EXPECT_EQ(anonymous_functions(
                "int outside(int a) {\nnamespace {\n\ntemplate <class T>\n"
                "const std::map<int, T>& of(T a) {\n  call(a);\n  return found(a);\n}\n"
                "std::string* two(int a,\n                  int b) {\n}  // namespace\nint after(int a) {\n"),
            (std::set<std::string>{"of", "two"}));
}
