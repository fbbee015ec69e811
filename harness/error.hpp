// Exceptions by cause. main() prints each as one line on stderr and returns an exit code.
#pragma once
#include <stdexcept>
#include <string>

namespace pelage {

/// Bad usage or input, exit code 2. The text names in one line the error, its place and the permitted values.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No OpenCL device is usable, exit code 3.
struct NoDeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A device refused a call, ran out of memory or could not build a kernel. During a run, the row of the
/// current case records the error. Otherwise the exit code is 1.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pelage
