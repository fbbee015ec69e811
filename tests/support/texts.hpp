// Looks for parts of texts.
#pragma once
#include <gtest/gtest.h>

#include <string>

namespace pelage::test {

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void expect_has(const std::string& text, const std::string& part) {
  EXPECT_TRUE(has(text, part)) << "there is no\n" << part << "\nin\n" << text;
}

}  // namespace pelage::test
