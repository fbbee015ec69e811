#include "harness/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/numbers.hpp"

namespace pelage {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Removes the digits at the start of the text, and returns them without leading zeros.
std::string_view take_digits(std::string_view& text) {
  const std::size_t count = std::size_t(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view digits = text.substr(0, count);
  text.remove_prefix(count);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

/// Compares two texts character by character, but numbers in them by value. Returns a negative number, 0 or a
/// positive number.
int compare_texts(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view left = take_digits(a), right = take_digits(b);
      if (left.size() != right.size()) return left.size() < right.size() ? -1 : 1;
      if (const int order = left.compare(right)) return order;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front() ? -1 : 1;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return int(!a.empty()) - int(!b.empty());
}

}  // namespace

Value text_value(const std::string& text) {
  return {text, text};
}

Value number_value(std::optional<double> number) {
  if (!number) return {"", "-"};
  return {fmt::format("{:.6g}", *number), three_digits(*number)};
}

Value count_value(std::optional<double> number) {
  if (!number) return {"", "-"};
  const std::string text = fmt::format("{:.0f}", *number);
  return {text, text};
}

std::string three_digits(double number) {
  if (number == 0 || !std::isfinite(number)) return fmt::format("{}", number);
  const int decimals = 2 - int(std::floor(std::log10(std::abs(number)) + 1e-9));
  if (decimals > 6) return fmt::format("{:.3g}", number);
  return fmt::format("{:.{}f}", number, std::max(decimals, 0));
}

int column_of(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name, &Column::name);
  return found == table.columns.end() ? -1 : int(found - table.columns.begin());
}

bool natural_less(const std::string& a, const std::string& b) {
  const std::optional<double> left = number_of(a), right = number_of(b);
  if (left && right && *left != *right) return *left < *right;
  if (left.has_value() != right.has_value()) return left.has_value();
  return compare_texts(a, b) < 0;
}

std::string with_value(const Column& column, const std::string& value) {
  std::string label = column.label;
  if (const std::size_t place = label.find("{}"); place != std::string::npos) label.replace(place, 2, value);
  return label;
}

bool precedes(const Column& column, const std::string& a, const std::string& b) {
  const auto place = [&](const std::string& v) {
    return std::find(column.order.begin(), column.order.end(), v) - column.order.begin();
  };
  return place(a) != place(b) ? place(a) < place(b) : natural_less(a, b);
}

}  // namespace pelage
