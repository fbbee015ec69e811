// Builds OpenCL programs on a thread of its own, while the caller prepares the data for them. PoCL needs
// about 22 ms to preprocess a program, even if its cache has the compiled kernels.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// Builds a list of programs. While this object exists, a Program with a listed text on the same device uses
/// the build of this object instead of a build of its own. If no Program needs a listed text, its build only
/// costs time. If a build fails, the constructor of the Program that needs it throws the error.
class BuildAhead {
 public:
  /// Starts to build the programs in the order of the list.
  BuildAhead(const Device& device, std::vector<ProgramText> texts);
  ~BuildAhead();  ///< waits for the build that is running; starts no other
  BuildAhead(const BuildAhead&) = delete;
  BuildAhead& operator=(const BuildAhead&) = delete;

  /// Returns the texts that no Program has used so far.
  std::vector<ProgramText> unused() const;

  /// Searches the existing objects for a build of `text` on `device`. Waits until the build ends, and returns
  /// its result. Returns null if no object lists this text. Throws the error of the build if it failed.
  static std::shared_ptr<const BuiltProgram> take(const Device& device, const ProgramText& text);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage::cl
