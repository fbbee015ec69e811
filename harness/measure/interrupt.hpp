// SIGINT and SIGTERM: the program ends at once with 130 or 143, but never inside a row.
#pragma once
#include <string>

namespace pelage {

/// From here on the two signals print `message` (how to go on) to stderr and end the process. Once per
/// process.
void end_on_interrupt(const std::string& message);

/// While one lives, a signal waits until the last of them is gone.
class HoldInterrupt {
 public:
  HoldInterrupt();
  ~HoldInterrupt();
  HoldInterrupt(const HoldInterrupt&) = delete;
  HoldInterrupt& operator=(const HoldInterrupt&) = delete;
};

}  // namespace pelage
