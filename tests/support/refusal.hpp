// The message of an error that a test expects.
#pragma once
#include <string>

#include "harness/error.hpp"

namespace pelage::test {

/// Returns the message of the Error that work() throws, or `otherwise` if it throws none.
template <class Error = InputError, class Work>
std::string refusal(const Work& work, const std::string& otherwise = "accepted") {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return otherwise;
}

}  // namespace pelage::test
