// What can go wrong, by whose hand. main() turns each into one clear line on stderr and an exit code.
#pragma once
#include <stdexcept>
#include <string>

namespace pelage {

/// Bad usage or input: exit 2. The text says what is wrong, where, and what would be right, in one line.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// No OpenCL device can be used at all: exit 3.
struct NoDeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A device refused a call, ran out of memory or could not build a kernel: the row in hand becomes an error.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pelage
