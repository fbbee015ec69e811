#include "harness/experiment/filter.hpp"

#include <fmt/format.h>
#include <re2/re2.h>

#include "harness/error.hpp"

namespace pelage {

Filter::Filter(const std::string& expression) {
  re2::RE2::Options options;
  options.set_log_errors(false);
  const auto pattern = std::make_shared<const re2::RE2>(expression, options);
  // The expression may be very long, and RE2's error message quotes the invalid part of it. Both texts are
  // therefore shortened.
  const auto shortened = [](const std::string& text) {
    return text.size() > 80 ? text.substr(0, 80) + "..." : text;
  };
  if (!pattern->ok())
    throw InputError(fmt::format("--filter {}: this is not a valid regular expression: {}",
                                 shortened(expression), shortened(pattern->error())));
  expression_ = pattern;
}

bool Filter::finds(const std::string& name) const {
  return re2::RE2::PartialMatch(name, *expression_);
}

}  // namespace pelage
