// Starts processes that use all CPUs, for tests of measurements on a busy machine.
#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <vector>

namespace pelage::test {

/// Uses all CPUs of the machine until it is destroyed.
class BusyMachine {
 public:
  BusyMachine() {
    for (long i = 0; i < sysconf(_SC_NPROCESSORS_ONLN); ++i) {
      const pid_t child = fork();
      if (child == 0)
        for (volatile unsigned long count = 0;;) count = count + 1;
      children_.push_back(child);
    }
  }
  ~BusyMachine() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
  BusyMachine(const BusyMachine&) = delete;
  BusyMachine& operator=(const BusyMachine&) = delete;

 private:
  std::vector<pid_t> children_;
};

}  // namespace pelage::test
