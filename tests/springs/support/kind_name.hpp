#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "harness/springs/model/network.hpp"

namespace pelage::springs::test {

/// Returns the name of a topology as a part of a test's name, in which '-' is not permitted.
inline std::string kind_name(const testing::TestParamInfo<Kind>& given) {
  std::string text(name(given.param));
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

}  // namespace pelage::springs::test
