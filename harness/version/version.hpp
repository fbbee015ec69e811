// Which source this binary was built from, and how.
#pragma once
#include <string>

namespace pelage {

struct BuildInfo {
  std::string version;   ///< the release, "0.1.0"
  std::string revision;  ///< git's commit in 40 hex digits; "unknown" in a copy that lost it
  bool dirty = false;    ///< tracked files differed from that commit when this was built
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< what the harness was compiled with
};

/// Taken from git at build time; a copy without .git has the revision that `git archive` wrote into
/// revision.txt.
const BuildInfo& build_info();

}  // namespace pelage
