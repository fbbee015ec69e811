// Handles SIGINT and SIGTERM: the program ends at once with status 130 or 143, but never while it writes a
// row of results.
#pragma once
#include <string>

namespace pelage {

/// Installs a signal handler. On SIGINT or SIGTERM, the handler prints a message to stderr and ends the
/// process. If `folder` exists when the signal arrives, the message explains how to resume the run in
/// `folder`. Call this function once per process.
void end_on_interrupt(const std::string& folder);

/// Defers SIGINT and SIGTERM while at least one object of this class exists. If a signal arrives meanwhile,
/// the process ends when the last object is destroyed.
class HoldInterrupt {
 public:
  HoldInterrupt();
  ~HoldInterrupt();
  HoldInterrupt(const HoldInterrupt&) = delete;
  HoldInterrupt& operator=(const HoldInterrupt&) = delete;
};

}  // namespace pelage
