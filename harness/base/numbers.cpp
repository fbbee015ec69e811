#include "harness/base/numbers.hpp"

#include <charconv>
#include <cmath>

namespace pelage {
namespace {

/// Returns the number if the whole text is one.
template <class T>
std::optional<T> whole_text(std::string_view text) {
  T number{};
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc{} || end != text.data() + text.size()) return {};
  return number;
}

}  // namespace

std::optional<Size> size_from_text(std::string_view text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos || text.front() == '-') return {};
  const std::string_view w = text.substr(0, cross), h = text.substr(cross + 1);
  if (w.size() > 9 || h.size() > 9 || h.starts_with('-')) return {};
  const std::optional<int> width = whole_text<int>(w), height = whole_text<int>(h);
  if (!width || !height) return {};
  return Size{*width, *height};
}

std::optional<double> double_of(std::string_view text) {
  return whole_text<double>(text);
}

std::optional<double> number_of(std::string_view text) {
  if (const std::optional<double> number = double_of(text); number && std::isfinite(*number)) return number;
  if (const std::optional<Size> size = size_from_text(text)) return double(size->width) * size->height;
  return {};
}

}  // namespace pelage
