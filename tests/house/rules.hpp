// The rules of the house as functions from a file's path and text to what is wrong with it.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pelage::house {

using Faults = std::vector<std::string>;  ///< one line each, "path:line: what"

/// room -> the rooms whose headers it may include: what its pelage_room() line in CMakeLists.txt links, and
/// what those link publicly.
using Links = std::map<std::string, std::set<std::string>>;
Links room_links(const std::string& cmake_lists);

/// Who may include what. `path` is relative to the repository, with '/'.
Faults include_faults(const std::string& path, const std::string& text, const Links& links);

/// At most 400 lines; no note for later; no path of somebody's own machine; lines end in a newline, without
/// trailing blanks or tabs.
Faults text_faults(const std::string& path, const std::string& text);

}  // namespace pelage::house
