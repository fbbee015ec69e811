// The rules of the repository: functions that find violations in the path and the text of a file.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pelage::house {

using Faults = std::vector<std::string>;  ///< one line per violation, "path:line: what"

/// Maps each room (a library of CMakeLists.txt) to the rooms whose headers it may include. These are the
/// rooms that its pelage_room() line lists. If a listed room links other rooms publicly, these are included
/// too, and so on.
using Links = std::map<std::string, std::set<std::string>>;
Links room_links(const std::string& cmake_lists);

/// Finds includes that the rules forbid. `path` is relative to the repository and uses '/'.
Faults include_faults(const std::string& path, const std::string& text, const Links& links);

/// Finds files of more than 400 lines, notes about work to be done later, paths of a private machine, a
/// missing newline at the end, and blanks or tabs at the end of a line.
Faults text_faults(const std::string& path, const std::string& text);

/// Two computations may each be in one kernel file only. Perspective-correct interpolation (arithmetic with
/// iw1 or iw2) must be in rasterize/coverage/perspective.clh. The assembly of a Surface from attribute rows
/// must be in rasterize/shading/surface.clh. The function reports copies in other kernel files. It also
/// reports perspective.clh and surface.clh if the file's own computation is missing.
Faults copy_faults(const std::string& path, const std::string& text);

}  // namespace pelage::house
