// Handles SIGINT and SIGTERM: the program ends at once with status 130 or 143, but never while it writes a
// row of results or a picture of an animation.
#pragma once
#include <string>

namespace pelage {

/// On SIGINT or SIGTERM, prints a message to stderr and ends the process. If `place`, a file or a folder,
/// exists then, the message contains `kept`, which says what is kept and how to continue. Call it once per
/// process.
void end_on_interrupt(const std::string& place, const std::string& kept);

/// Defers SIGINT and SIGTERM while at least one object of this class exists.
class HoldInterrupt {
 public:
  HoldInterrupt();
  ~HoldInterrupt();
  HoldInterrupt(const HoldInterrupt&) = delete;
  HoldInterrupt& operator=(const HoldInterrupt&) = delete;
};

}  // namespace pelage
