// Builds OpenCL programs on a thread of its own, while the caller prepares the data for them. PoCL needs
// about 22 ms to preprocess a program, even if its cache has the compiled kernels.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "harness/cl/program.hpp"

namespace pelage::cl {

/// While the object exists, each Program of a listed text and of the same device uses the build of this
/// object. A listed text that no Program needs costs its build time, and changes nothing else. An error in
/// a build is thrown by the Program that needs it.
class BuildAhead {
 public:
  /// Starts to build the programs in the order of the list.
  BuildAhead(const Device& device, std::vector<ProgramText> texts);
  ~BuildAhead();  ///< waits for the build that is running; starts no other
  BuildAhead(const BuildAhead&) = delete;
  BuildAhead& operator=(const BuildAhead&) = delete;

  /// Returns the texts that no Program has used so far.
  std::vector<ProgramText> unused() const;

  /// Returns the build of an existing object, or null if no object lists this text for this device. Waits
  /// for the end of the build and throws its error.
  static std::shared_ptr<const BuiltProgram> take(const Device& device, const ProgramText& text);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pelage::cl
