// Messages of errors that a test expects, and parts of texts.
#pragma once
#include <gtest/gtest.h>

#include <initializer_list>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/error.hpp"

namespace pelage::test {

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Returns how often the text has the part.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

/// Replaces the only `from` in the text by `to`. The test ends if the text does not have `from` exactly once.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  if (count_of(text, from) != 1)
    throw std::runtime_error(from + "\nis there " + std::to_string(count_of(text, from)) +
                             " times, not once");
  return text.replace(text.find(from), from.size(), to);
}

/// Returns the parts of the text that match the pattern: their group 1, or all of it if the pattern has none.
inline std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  const int group = pattern.mark_count() > 0 ? 1 : 0;
  return {std::sregex_token_iterator(text.begin(), text.end(), pattern, group), {}};
}

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

/// The place of a call, which a failure names. clang 14 has no std::source_location.
struct Place {
  const char* file;
  int line;
  static constexpr Place current(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Expects each of `parts` in the text. A failure names the line of the call.
inline void expect_has(const std::string& text, std::initializer_list<std::string> parts,
                       const Place& at = Place::current()) {
  for (const std::string& part : parts)
    if (!has(text, part)) ADD_FAILURE_AT(at.file, at.line) << "there is no\n" << part << "\nin\n" << text;
}

inline void expect_has(const std::string& text, const std::string& part, const Place& at = Place::current()) {
  expect_has(text, {part}, at);
}

/// Expects none of `parts` in the text.
inline void expect_lacks(const std::string& text, std::initializer_list<std::string> parts,
                         const Place& at = Place::current()) {
  for (const std::string& part : parts)
    if (has(text, part)) ADD_FAILURE_AT(at.file, at.line) << part << "\nis in\n" << text;
}

inline void expect_lacks(const std::string& text, const std::string& part,
                         const Place& at = Place::current()) {
  expect_lacks(text, {part}, at);
}

/// Names the tests of a parameterized suite by the text or by the field `name` of their parameters, or by
/// those of the elements of a pair or a tuple. A character that a name must not have becomes '_'.
struct ByParameter {
  template <class T>
  static std::string text(const T& value) {
    if constexpr (requires { value.name; })
      return std::string(value.name);
    else if constexpr (requires { std::tuple_size<T>::value; })
      return std::apply(
          [](const auto& first, const auto&... others) { return (text(first) + ... + ("_" + text(others))); },
          value);
    else if constexpr (std::is_arithmetic_v<T>)
      return std::to_string(value);
    else
      return value;
  }
  template <class T>
  std::string operator()(const testing::TestParamInfo<T>& given) const {
    return std::regex_replace(text(given.param), std::regex("\\W"), "_");
  }
};
inline constexpr ByParameter by_parameter;

/// An input, and a text that the message of its refusal must contain.
using Bad = std::pair<std::string, std::string>;

/// Expects that work(input) throws an InputError for each input. The message must be one line that begins
/// with `start`.
template <class Work>
void expect_refusals(const std::vector<Bad>& list, const Work& work, const std::string& start = "") {
  for (const Bad& bad : list) {
    SCOPED_TRACE(bad.first);
    const std::string said = refusal([&] { work(bad.first); });
    expect_has(said, bad.second);
    expect_lacks(said, "\n");
    EXPECT_TRUE(said.starts_with(start)) << said;
  }
}

}  // namespace pelage::test
