// The rules of the repository: functions that find violations in the path and the text of a file.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pelage::house {

inline const std::filesystem::path root = PELAGE_SOURCE_DIR;  ///< folder of the checkout

/// Returns the source files and documents of the checkout, relative to its root. Pictures and files of
/// results/ are data and are left out.
std::vector<std::string> written_files();

using Faults = std::vector<std::string>;  ///< one line per violation, "path:line: what"

/// A room is a library of CMakeLists.txt. Maps each room to the rooms whose headers it may include. These are
/// the rooms that its pelage_room() line lists. If a listed room links other rooms as PUBLIC, directly or
/// through further rooms, the headers of these rooms are allowed, too.
using Links = std::map<std::string, std::set<std::string>>;
Links room_links(const std::string& cmake_lists);

/// Finds includes that the rules forbid. `path` is relative to the repository and uses '/'.
Faults include_faults(const std::string& path, const std::string& text, const Links& links);

/// Finds files of more than 400 lines, documents of more than 7000 words, notes about work to be done later,
/// absolute paths of a developer's machine, a missing newline at the end, and blanks or tabs at the end of a
/// line.
Faults text_faults(const std::string& path, const std::string& text);

/// Finds copies of two computations. Perspective-correct interpolation (arithmetic with iw1 or iw2) must be
/// in rasterize/coverage/perspective.clh and in no other kernel file, and the code that writes interpolated
/// attributes into the struct Surface in rasterize/shading/surface.clh.
Faults copy_faults(const std::string& path, const std::string& text);

/// Finds launches of kernels outside of harness/cl/program.cpp, and launches that leave the size of the
/// work-groups to the driver: PoCL compiles a kernel again for each size.
Faults launch_faults(const std::string& path, const std::string& text);

}  // namespace pelage::house
