#include "tests/house/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <regex>
#include <sstream>

#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage::house {
namespace {

// Returns the name of the folder directly below `parent` that contains `path`. With the parent "harness", it
// returns "cl" for "harness/cl/device.hpp", and an empty string for "harness/error.hpp".
std::string room_of(const std::string& path, const std::string& parent) {
  if (!path.starts_with(parent + "/")) return {};
  const std::string rest = path.substr(parent.size() + 1);
  const auto slash = rest.find('/');
  return slash == std::string::npos ? std::string{} : rest.substr(0, slash);
}

// Returns the name of the room of a file under harness/. A room is a library of CMakeLists.txt. The name of a
// room is the path of its folder with '_' in place of '/': "harness/springs/model/network.hpp" is in the room
// "springs_model". If the folders of several rooms contain the file, the result is the room with the longest
// path. If the file is in no room, the result is the name of the folder directly below harness/.
std::string harness_room_of(const std::string& path, const Links& links) {
  if (!path.starts_with("harness/")) return {};
  std::string folder = path.substr(8);
  for (auto slash = folder.rfind('/'); slash != std::string::npos; slash = folder.rfind('/')) {
    folder.resize(slash);
    std::string room = folder;
    std::replace(room.begin(), room.end(), '/', '_');
    if (links.count(room) > 0) return room;
  }
  return room_of(path, "harness");
}

// Returns the reason why the file `path` must not include the file `what`, or an empty string if it may.
std::string kernel_fault(const std::string& path, const std::string& what) {
  const std::string room = room_of(path, "kernels");
  const bool common = room_of("kernels/" + what, "kernels") == "common" && what.ends_with(".clh");
  const bool lanes = what.starts_with("lanes") && what.find('/') == std::string::npos;
  if (path == "kernels/dialect.clh" && !lanes) return "the dialect includes its lanes and nothing else";
  if (path.ends_with("params.h")) return "a record shared with the host includes nothing";
  if (what == "dialect.clh" || common || (lanes && path == "kernels/dialect.clh")) return {};
  if (room == "common") return "common/ uses dialect.clh and common/ only";
  const std::string folder = path.substr(0, path.rfind('/')).substr(std::string("kernels/").size());
  if (what == room + "/params.h" || what == folder + "/params.h") return {};
  if (path.ends_with("/equations.clh"))
    return "equations use dialect.clh, their room's params.h and common/*.clh only";
  if (what.starts_with(room + "/") && what.ends_with(".clh")) return {};
  return "a kernel uses its own room, dialect.clh and common/ only";
}

std::string harness_fault(const std::string& path, const std::string& what, const Links& links) {
  const std::string room = harness_room_of(path, links);
  const bool everything = room == "commands" || path == "harness/main.cpp";
  if (what.starts_with("CL/") && room != "cl") return "only harness/cl includes OpenCL";
  if (what.starts_with("CGAL/") && room != "mesh") return "only harness/mesh includes CGAL";
  if (what == "tiny_gltf.h" && room != "mesh_read") return "only harness/mesh/read includes tinygltf";
  if (what.starts_with("OpenImageIO/") && room != "picture")
    return "only harness/picture includes OpenImageIO";
  if (what.starts_with("epoxy/") && room != "gl") return "only harness/gl includes OpenGL";
  if (what.starts_with("tests/")) return "the harness does not include tests";
  if (what.starts_with("kernels/"))
    return what.ends_with("/params.h") ? "" : "of kernels/ the harness includes a room's params.h only";
  const std::string other = harness_room_of(what, links);
  if (other.empty() || other == room || other == "base" || everything) return {};
  if (other == "commands") return "commands are included by main.cpp only";
  const auto allowed = links.find(room);
  if (allowed != links.end() && allowed->second.count(other) > 0) return {};
  return fmt::format("CMakeLists.txt does not link {} to {}", room.empty() ? "the harness's root" : room,
                     other);
}

}  // namespace

std::vector<std::string> written_files() {
  static const std::set<std::string> kinds{".cpp", ".hpp", ".in", ".cl", ".clh",  ".h", ".cmake", ".vert",
                                           ".txt", ".sh",  ".py", ".md", ".toml", ".1", ".glsl",  ".frag"};
  std::vector<std::string> files;
  for (const char* folder : {"harness", "kernels", "shaders", "tests", "experiments", "examples", "docs",
                             "bench", "scripts", "python", "cmake", ".ci"})
    if (std::filesystem::is_directory(root / folder))
      for (const auto& file : test::files_below(root / folder))
        if (kinds.contains(file.extension()) || std::string(folder) == ".ci")
          files.push_back(file.lexically_relative(root).generic_string());
  for (const auto& entry : std::filesystem::directory_iterator(root))
    if (entry.is_regular_file() && kinds.contains(entry.path().extension()))
      files.push_back(entry.path().filename().generic_string());
  return files;
}

Links room_links(const std::string& cmake_lists) {
  static const std::regex room_line(R"(pelage_room\(\s*([\w/]+)([^)]*)\))");
  static const std::regex word(R"(\S+)");
  Links direct, exported;
  const std::string text = std::regex_replace(cmake_lists, std::regex("#[^\n]*"), "");
  for (std::sregex_iterator match(text.begin(), text.end(), room_line), end; match != end; ++match) {
    std::string room = (*match)[1];
    const std::string rest = (*match)[2];
    std::replace(room.begin(), room.end(), '/', '_');
    direct[room];
    bool is_public = true;
    for (std::sregex_iterator item(rest.begin(), rest.end(), word); item != end; ++item) {
      const std::string name = item->str();
      if (name == "PUBLIC" || name == "PRIVATE") is_public = name == "PUBLIC";
      if (!name.starts_with("pelage_")) continue;
      direct[room].insert(name.substr(7));
      if (is_public) exported[room].insert(name.substr(7));
    }
  }
  Links reached;
  for (const auto& [room, links] : direct) {
    const std::function<void(const std::string&)> add = [&, to = &reached[room]](const std::string& other) {
      if (!to->insert(other).second) return;
      for (const std::string& next : exported[other]) add(next);
    };
    for (const std::string& other : links) add(other);
  }
  return reached;
}

Faults include_faults(const std::string& path, const std::string& text, const Links& links) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  Faults faults;
  int number = 0;
  for (const std::string& line : test::lines_of(text)) {
    ++number;
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    const std::string what = match[1];
    std::string fault;
    if (what.find("..") != std::string::npos)
      fault = "includes are written from the repository's root";
    else if (path.starts_with("kernels/"))
      fault = kernel_fault(path, what);
    else if (path.starts_with("harness/"))
      fault = harness_fault(path, what, links);
    if (!fault.empty()) faults.push_back(fmt::format("{}:{}: {}: {}", path, number, what, fault));
  }
  return faults;
}

Faults text_faults(const std::string& path, const std::string& text) {
  // The brackets keep text_faults() from finding the words that mark unfinished work in this file.
  static const std::regex later("\\b(TOD[O]|FIXM[E]|XX[X]|HAC[K])\\b");
  static const std::regex machine("(^|[^\\w.~$}/-])/(home|root|work|tmp|Users|mnt)/[\\w.]");
  Faults faults;
  const auto report = [&](int line, const std::string& what) {
    faults.push_back(fmt::format("{}:{}: {}", path, line, what));
  };
  const auto lines = test::lines_of(text);
  // The manual page (.1) may be longer, because it must describe all commands in one file. A document is
  // limited by its words, because the definition of a frame is one page.
  if (path.ends_with(".md")) {
    std::istringstream stream(text);
    const auto words =
        std::distance(std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>());
    if (words > 7000) report(1, fmt::format("{} words, 7000 are enough", words));
  } else if (lines.size() > 400 && !path.ends_with(".1"))
    report(401, fmt::format("{} lines, 400 are enough", lines.size()));
  if (!text.empty() && text.back() != '\n') report(static_cast<int>(lines.size()), "no newline at the end");
  int number = 0;
  for (const std::string& line : lines) {
    ++number;
    if (std::regex_search(line, later)) report(number, "a note for later: do it now or open an issue");
    if (std::regex_search(line, machine)) report(number, "a path of somebody's own machine");
    if (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '\t'))
      report(number, "a blank or carriage return at the end of the line");
  }
  return faults;
}

Faults copy_faults(const std::string& path, const std::string& text) {
  struct Computation {
    std::string file, what;
    std::regex written;
  };
  static const Computation computations[] = {
      {"kernels/rasterize/coverage/perspective.clh", "perspective-correct interpolation",
       std::regex(R"(\biw[12](\[\w+\])?\s*[-*]|[-*]\s*\w*(\.|->)?iw[12]\b)")},
      {"kernels/rasterize/shading/surface.clh", "the assembly of a Surface from attribute rows",
       std::regex(R"((\.|->)(uv|a|b|along_u|along_v|curl_u|curl_v)\s*=\s*vec[23]\(\s*\w+(\[\d|\.s\d))")}};
  Faults faults;
  if (!path.starts_with("kernels/")) return faults;
  for (const Computation& one : computations) {
    bool found = false;
    int number = 0;
    for (const std::string& line : test::lines_of(text)) {
      ++number;
      if (!std::regex_search(line.substr(0, line.find("//")), one.written)) continue;
      found = true;
      if (path != one.file)
        faults.push_back(fmt::format("{}:{}: {} belongs in {}", path, number, one.what, one.file));
    }
    if (path == one.file && !found) faults.push_back(fmt::format("{}: has no longer {}", path, one.what));
  }
  return faults;
}

Faults launch_faults(const std::string& path, const std::string& text) {
  static const std::regex launch(R"(\bclEnqueue(NDRangeKernel|Task)\s*\(([^;]*))"),
      none(R"(\bnullptr\b|\bNULL\b)");
  Faults faults;
  if (path.starts_with("tests/house/")) return faults;
  for (std::sregex_iterator at(text.begin(), text.end(), launch), end; at != end; ++at) {
    const std::string arguments = (*at)[2];
    std::size_t local = 0;  // the sixth argument
    for (int comma = 0; comma < 5 && local != std::string::npos; ++comma)
      local = arguments.find(',', local + 1);
    if (path != "harness/cl/program.cpp")
      faults.push_back(fmt::format("{}: launches a kernel; use cl::Kernel::enqueue()", path));
    else if (local == std::string::npos ||
             std::regex_search(arguments.substr(local, arguments.find(',', local + 1) - local), none))
      faults.push_back(fmt::format("{}: leaves the size of the work-groups to the driver", path));
  }
  return faults;
}

}  // namespace pelage::house
