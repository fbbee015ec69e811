
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "harness/cl/program.hpp"
#include "harness/error.hpp"
#include "harness/hash.hpp"

namespace pelage::cl {
namespace fs = std::filesystem;
namespace {

std::string read_source(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw InputError(
        fmt::format("{}: cannot be read: no such kernel file in the kernel folder", file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

void add_sources(const fs::path& folder, const std::string& file, SourceTexts& found) {
  if (found.contains(file)) return;
  const std::string& text = found[file] = read_source(folder / file);
  constexpr std::string_view include = "#include \"";
  for (auto at = text.find(include); at != std::string::npos; at = text.find(include, at + 1)) {
    const auto begin = at + include.size();
    if (at == 0 || text[at - 1] == '\n')
      add_sources(folder, text.substr(begin, text.find('"', begin) - begin), found);
  }
}

bool in_a_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Returns whether `name` stands in the text outside of the comments that begin with //.
bool has_name(std::string_view text, std::string_view name) {
  for (auto at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const auto end = at + name.size();
    if ((at > 0 && in_a_name(text[at - 1])) || (end < text.size() && in_a_name(text[end]))) continue;
    const auto line = text.rfind('\n', at) + 1;  // npos + 1 is 0
    if (text.substr(line, at - line).find("//") == std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

SourceTexts source_texts(const fs::path& file) {
  SourceTexts found;
  add_sources(kernel_folder(), file.generic_string(), found);
  return found;
}

Sources hashes_of(const SourceTexts& texts) {
  Sources hashes;
  for (const auto& [file, text] : texts) hashes[file] = Hash().text(text).value();
  return hashes;
}

Sources sources_of(const fs::path& file) {
  return hashes_of(source_texts(file));
}

std::string hash_of(const Sources& sources) {
  Hash hash;
  for (const auto& [path, contents] : sources) hash.text(path).number(contents);
  return hash.hex();
}

std::string options_read(const std::string& options, const SourceTexts& sources) {
  std::istringstream words(options);
  std::string kept;
  for (std::string word; words >> word;) {
    if (word == "-D") {
      std::string macro;
      words >> macro;
      const std::string name = macro.substr(0, macro.find('='));
      if (std::ranges::none_of(sources, [&](const auto& source) { return has_name(source.second, name); }))
        continue;
      word += ' ' + macro;
    }
    kept += (kept.empty() ? "" : " ") + word;
  }
  return kept;
}

}  // namespace pelage::cl
