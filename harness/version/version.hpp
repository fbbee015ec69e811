// Version and revision of the source, and compiler of this binary.
#pragma once
#include <string>

namespace pelage {

struct BuildInfo {
  std::string version;   ///< the release, "0.1.0"
  std::string revision;  ///< git's commit, 40 hex digits; "unknown" if neither git nor revision.txt has it
  bool dirty = false;    ///< true if tracked files differed from that commit during the build
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< compiler flags of the harness
};

/// Returns the version, the revision, the compiler and the compiler flags of this binary. The build reads the
/// revision from git. In a copy without .git, the build reads the revision from revision.txt, which
/// `git archive` fills in.
const BuildInfo& build_info();

}  // namespace pelage
