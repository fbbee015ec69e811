#include "harness/compare/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "harness/compare/tolerances.hpp"
#include "harness/error.hpp"

namespace pelage {
namespace {

double distance(float a, float b) {
  const double d = std::abs(double(a) - double(b));
  return std::isfinite(d) ? d : 1e6;
}

/// Returns the PSNR in dB (peak 1) of `pixels` pixels. `squares` is the sum of the squared differences of
/// red, green and blue over these pixels.
double decibels(double squares, std::size_t pixels) {
  const double mean = squares / (3.0 * double(pixels));
  return mean > 1e-20 ? -10.0 * std::log10(mean) : 200.0;
}

std::vector<char> selected(const Picture& picture, const std::vector<Window>& windows) {
  std::vector<char> chosen(picture.pixel.size(), windows.empty() ? 1 : 0);
  for (const Window& w : windows)
    for (int y = std::max(0, w.y); y < std::min(picture.height, w.y + w.height); ++y)
      for (int x = std::max(0, w.x); x < std::min(picture.width, w.x + w.width); ++x)
        chosen[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)] = 1;
  return chosen;
}

bool has_fur(const Picture& picture, const Window& w) {
  for (int y = std::max(0, w.y); y < std::min(picture.height, w.y + w.height); ++y)
    for (int x = std::max(0, w.x); x < std::min(picture.width, w.x + w.width); ++x)
      if (picture.at(x, y).w > 0.0f) return true;
  return false;
}

double luma(const glm::vec4& pixel) {
  return std::clamp(0.299 * double(pixel.x) + 0.587 * double(pixel.y) + 0.114 * double(pixel.z), 0.0, 1.0);
}

/// Returns the SSIM of one window.
double similarity(const Picture& a, const Picture& b, int left, int top, int side) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x) {
      const double p = luma(a.at(x, y)), q = luma(b.at(x, y));
      sum_a += p;
      sum_b += q;
      aa += p * p;
      bb += q * q;
      ab += p * q;
    }
  const double count = double(side) * double(side), mean_a = sum_a / count, mean_b = sum_b / count;
  const double var_a = aa / count - mean_a * mean_a, var_b = bb / count - mean_b * mean_b;
  const double covariance = ab / count - mean_a * mean_b;
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

}  // namespace

Agreement compare(const Picture& a, const Picture& b, const std::vector<Window>& windows) {
  if (a.width != b.width || a.height != b.height || a.pixel.size() != b.pixel.size())
    throw InputError(fmt::format("pictures of {}x{} and {}x{} cannot be compared: the sizes must be equal",
                                 a.width, a.height, b.width, b.height));
  const std::vector<char> chosen = selected(a, windows);
  Agreement result;
  // `squares` is the sum of the squared differences over the compared fur pixels. `kept` is the same sum
  // without the pixels in which a channel differs by more than tolerance::flip.
  double squares = 0, kept = 0;
  std::vector<double> differences;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const glm::vec4 &p = a.at(x, y), &q = b.at(x, y);
      // NaN <= 0 is false, so a pixel whose alpha is NaN counts as fur.
      if (!chosen[std::size_t(y) * std::size_t(a.width) + std::size_t(x)] || (p.w <= 0.0f && q.w <= 0.0f))
        continue;
      double largest = distance(p.w, q.w), of_pixel = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = distance(p[c], q[c]);
        of_pixel += d * d;
        largest = std::max(largest, d);
      }
      squares += of_pixel;
      if (largest > tolerance::flip)
        ++result.flips;
      else
        kept += of_pixel;
      if (largest > result.worst) {
        result.worst = largest;
        result.worst_x = x;
        result.worst_y = y;
      }
      differences.push_back(largest);
    }
  result.pixels = differences.size();
  if (differences.empty()) return result;
  result.psnr = decibels(squares, result.pixels);
  if (result.flips < result.pixels) result.psnr_without_flips = decibels(kept, result.pixels - result.flips);
  // `rank` is the index of the 99.9th percentile if the differences are sorted in ascending order.
  const std::size_t rank = std::size_t(std::ceil(0.999 * double(differences.size()))) - 1;
  std::nth_element(differences.begin(), differences.begin() + std::ptrdiff_t(rank), differences.end());
  result.p999 = differences[rank];
  return result;
}

bool within(const Agreement& agreement) {
  return agreement.pixels > 0 && agreement.psnr >= tolerance::picture_psnr &&
         agreement.p999 <= tolerance::flip && agreement.flip_share() <= tolerance::flip_share;
}

std::vector<Window> fur_windows(const Picture& picture, std::size_t count, int side, std::uint32_t seed) {
  if (side < 1) throw InputError(fmt::format("windows: the side is {} pixels; it must be at least 1", side));
  std::vector<Window> cells;
  for (int y = 0; y < picture.height; y += side)
    for (int x = 0; x < picture.width; x += side) {
      // The cells of the last row and the last column are moved inwards, so that they are inside the picture
      // and have the full size. If the picture's width is below `side`, the cells have the picture's width.
      // If the picture's height is below `side`, the cells have the picture's height.
      const Window cell{std::max(0, std::min(x, picture.width - side)),
                        std::max(0, std::min(y, picture.height - side)), std::min(side, picture.width),
                        std::min(side, picture.height)};
      if (has_fur(picture, {cell.x - cell.width, cell.y - cell.height, 3 * cell.width, 3 * cell.height}))
        cells.push_back(cell);
    }
  // Moves `taken` random cells to the front of the list. The code does not use std::shuffle, because its
  // results differ between standard libraries.
  std::mt19937 random(seed);
  const std::size_t taken = std::min(count, cells.size());
  for (std::size_t i = 0; i < taken; ++i) std::swap(cells[i], cells[i + random() % (cells.size() - i)]);
  cells.resize(taken);
  std::sort(cells.begin(), cells.end(),
            [](const Window& a, const Window& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return cells;
}

double ssim(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared", a.width,
                                 a.height, b.width, b.height));
  constexpr int side = 8, step = 4;
  double sum = 0;
  int count = 0;
  for (int y = 0; y + side <= a.height; y += step)
    for (int x = 0; x + side <= a.width; x += step) {
      if (!has_fur(a, {x, y, side, side}) && !has_fur(b, {x, y, side, side})) continue;
      sum += similarity(a, b, x, y, side);
      ++count;
    }
  return count > 0 ? sum / count : 1.0;
}

double model_height(const Picture& picture) {
  int rows = 0;
  for (int y = 0; y < picture.height; ++y) {
    const auto row = picture.pixel.begin() + std::ptrdiff_t(y) * picture.width;
    rows += std::any_of(row, row + picture.width, [](const glm::vec4& p) { return p.w > 0; });
  }
  return double(rows) / std::max(1, picture.height);
}

double wet_share(const Mesh& mesh, const std::vector<glm::vec4>& mask, int side) {
  double wet = 0, all = 0;
  auto texel = [side](float u) {
    // nearest sampling (docs/shells.md, section 2)
    return std::min(side - 1, int((u - std::floor(u)) * float(side)));
  };
  for (const glm::uvec3& t : mesh.triangle) {
    const glm::vec3 a = mesh.position[t.x], b = mesh.position[t.y], c = mesh.position[t.z];
    const double area = glm::length(glm::cross(b - a, c - a));
    const glm::vec2 uv = (mesh.uv[t.x] + mesh.uv[t.y] + mesh.uv[t.z]) / 3.0f;
    all += area;
    if (mask[std::size_t(texel(uv.y)) * std::size_t(side) + std::size_t(texel(uv.x))].w > 0) wet += area;
  }
  return all > 0 ? wet / all : 0;
}

}  // namespace pelage
