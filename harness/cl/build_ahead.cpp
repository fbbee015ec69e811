#include "harness/cl/build_ahead.hpp"

#include <exception>
#include <utility>

namespace pelage::cl {

BuildAhead::BuildAhead(const Device& device, std::vector<ProgramText> texts)
    : thread_([this, device, texts = std::move(texts)] {
        for (const ProgramText& text : texts) {
          if (stop_) return;
          try {
            build_program(device, text);
          } catch (const std::exception&) {  // the Program that needs the text meets the same error
          }
        }
      }) {
#if defined(__SANITIZE_ADDRESS__)
  // isolated() calls fork(). If another thread allocates memory at that moment, GCC 12's AddressSanitizer
  // leaves its allocator locked in the child process, and the child process waits for ever. glibc does not.
  thread_.join();
#endif
}

BuildAhead::~BuildAhead() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace pelage::cl
