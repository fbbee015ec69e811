// The option --filter: a regular expression that selects cases by their names.
#pragma once
#include <memory>
#include <string>

namespace re2 {
class RE2;
}

namespace pelage {

/// A regular expression in RE2's syntax. RE2 matches every expression in a time proportional to the length of
/// the text. Matching with std::regex can take exponential time or overflow the stack.
class Filter {
 public:
  /// Throws InputError if the expression is invalid, or if its compiled form needs more than 8 MiB.
  explicit Filter(const std::string& expression);
  bool finds(
      const std::string& name) const;  ///< whether a part of `name` matches; true for the empty expression

 private:
  std::shared_ptr<const re2::RE2> expression_;
};

}  // namespace pelage
