#include "harness/measure/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

namespace pelage {
namespace {

// The signal handler receives only the signal number, so these static variables hold everything else that the
// handler needs. Masking the signals in this thread would not suffice, because drivers run their own threads
// and any thread may receive a signal.
std::atomic<int> holders{0};
std::atomic<int> pending{0};
const std::string *place = nullptr, *note = nullptr;
constexpr std::string_view nothing_kept = "\npelage: interrupted; nothing was recorded\n";

[[noreturn]] void end(int signal) {
  if (note) {
    const std::string_view text =
        ::access(place->c_str(), F_OK) == 0 ? std::string_view(*note) : nothing_kept;
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    static_cast<void>(written);
  }
  ::_exit(128 + signal);
}

void handle(int signal) {
  pending.store(signal);
  if (holders.load() == 0) end(signal);
}

}  // namespace

void end_on_interrupt(const std::string& where, const std::string& kept) {
  // `place` and `note` are never freed, because the signal handler may still run while the program exits.
  place = new std::string(where);
  note = new std::string("\npelage: interrupted; " + kept + "\n");
  struct sigaction action = {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

HoldInterrupt::HoldInterrupt() {
  holders.fetch_add(1);
}

HoldInterrupt::~HoldInterrupt() {
  if (holders.fetch_sub(1) == 1 && pending.load() != 0) end(pending.load());
}

}  // namespace pelage
