// The exceptions, one class per cause. main() prints the text of an exception on stderr and returns the exit
// code of its class.
#pragma once
#include <stdexcept>
#include <string>

namespace pelage {

/// Bad usage or input, exit code 2. The text is one line that names the error, its place and the permitted
/// values.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No OpenCL device is usable, exit code 3.
struct NoDeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A device refused a call, ran out of memory or could not build a kernel. During `pelage run` the error is
/// recorded in the result of the current case. In all other commands the exit code is 1.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pelage
