#pragma once
#include "harness/cl/program.hpp"
#include "tests/springs/support/scenes.hpp"

namespace pelage::springs::test {

/// Returns a queue on the device that $PELAGE_DEVICE selects, or else on the first device.
inline const cl::Queue& queue() {
  static const cl::Queue shared(cl::choose_device(""));
  return shared;
}

}  // namespace pelage::springs::test
