#pragma once
#include "harness/cl/program.hpp"

namespace pelage::test {

/// Returns a queue on the device that $PELAGE_DEVICE selects, or else on the first device.
inline const cl::Queue& queue() {
  static const cl::Queue shared(cl::choose_device(""));
  return shared;
}

}  // namespace pelage::test
