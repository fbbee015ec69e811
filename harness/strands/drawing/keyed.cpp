#include "harness/strands/drawing/keyed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "harness/error.hpp"
#include "harness/strands/drawing/drawing.hpp"
#include "kernels/strands/draw/params.h"

namespace pelage::strands {
namespace {

constexpr std::size_t slice = 16;

void require(bool valid, std::size_t strand, const char* what, float value, const char* range) {
  if (!valid) throw InputError(fmt::format("strand {}: {} {}; it must be {}", strand, what, value, range));
}

void check_keyed(const KeyedStrand& s, std::size_t number, std::size_t keys) {
  for (const std::uint32_t key : s.key)
    if (key >= keys)
      throw InputError(fmt::format("strand {}: key strand {}; there are {} key strands", number, key, keys));
  const float first = 1 - s.weight.x - s.weight.y;
  require(s.weight.x >= 0 && s.weight.x <= 1, number, "weight", s.weight.x, "from 0 to 1");
  require(s.weight.y >= 0 && s.weight.y <= 1, number, "weight", s.weight.y, "from 0 to 1");
  require(first >= -1e-5f, number, "weight of the first key strand", first, "at least 0");
  require(s.length > 0 && s.length <= 100, number, "length", s.length, "above 0 and at most 100");
  require(s.response >= 0 && s.response <= 10, number, "response", s.response, "from 0 to 10");
  require(std::abs(s.twist) <= 360, number, "twist", s.twist, "from -360 to 360 degrees");
  require(std::abs(s.curvature) <= 180, number, "curvature", s.curvature, "from -180 to 180 degrees");
  require(s.width > 0 && s.width <= 10, number, "width", s.width, "above 0 and at most 10");
}

float bits(std::uint32_t value) {
  return std::bit_cast<float>(value);
}

/// The cosine and the sine of an angle in 16 bits each, the cosine in the lower bits (DRAWN_TWIST of
/// kernels/strands/draw/params.h).
std::uint32_t turn_bits(float degrees) {
  const double angle = double(degrees) * std::numbers::pi / 180;
  const auto word = [](double value) { return std::uint32_t(std::uint16_t(std::lround(32767 * value))); };
  return word(std::cos(angle)) | word(std::sin(angle)) << 16;
}

}  // namespace

bool has_styles(const std::vector<KeyedStrand>& strands) {
  return std::ranges::any_of(
      strands, [](const KeyedStrand& s) { return s.response != 1 || s.twist != 0 || s.curvature != 0; });
}

std::vector<float> key_records(const std::vector<KeyStrand>& keys) {
  std::vector<float> records;
  records.reserve(keys.size() * KEY_RECORD);
  for (const KeyStrand& key : keys) {
    for (const glm::vec3& v : {key.root, key.normal, key.first, key.second, key.rest})
      records.insert(records.end(), {v.x, v.y, v.z});
    records.push_back(0);
  }
  return records;
}

std::vector<KeyStrand> keys_of(const std::vector<float>& records, std::size_t count) {
  std::vector<KeyStrand> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto vector = [first = &records[i * KEY_RECORD]](std::size_t k) {
      return glm::vec3(first[3 * k], first[3 * k + 1], first[3 * k + 2]);
    };
    keys[i] = {vector(0), vector(1), vector(2), vector(3), vector(4)};
  }
  return keys;
}

std::vector<float> keyed_columns(const std::vector<KeyedStrand>& strands, std::size_t keys) {
  const std::size_t slices = (strands.size() + slice - 1) / slice;
  std::vector<float> table(slices * slice * DRAWN_COLUMNS, 0.0f);  // unused places refer to key strand 0
  for (std::size_t i = 0; i < strands.size(); ++i) {
    const KeyedStrand& s = strands[i];
    check_keyed(s, i, keys);
    const auto set = [&](int column, float value) {
      table[(i / slice * DRAWN_COLUMNS + std::size_t(column)) * slice + i % slice] = value;
    };
    for (int k = 0; k < 3; ++k) set(DRAWN_KEY + k, bits(s.key[std::size_t(k)]));
    set(DRAWN_WEIGHT, s.weight.x);
    set(DRAWN_WEIGHT + 1, s.weight.y);
    set(DRAWN_LENGTH, s.length);
    set(DRAWN_WIDTH, s.width);
    set(DRAWN_RESPONSE, s.response);
    set(DRAWN_TWIST, bits(turn_bits(s.twist)));
    set(DRAWN_CURVATURE, bits(turn_bits(s.curvature)));
    set(DRAWN_COLOUR, bits(std::uint32_t(s.colour[0]) | std::uint32_t(s.colour[1]) << 8 |
                           std::uint32_t(s.colour[2]) << 16 | std::uint32_t(s.layer) << 24));
  }
  return table;
}

void set_parts(std::vector<DrawnStrand>& curves, const std::vector<KeyedStrand>& strands,
               const std::vector<StrandShape>& shapes) {
  glm::vec3 root(0);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const StrandShape& s = shapes[i];
    if (s.from == 0) root = curves[i].point[0];
    curves[i].part = StrandPart{s.from, s.to, s.width_end, root, strands[i].length, strands[i].key[0]};
  }
}

std::vector<float> shape_columns(const std::vector<StrandShape>& shapes) {
  std::vector<float> table((shapes.size() + slice - 1) / slice * slice * SHAPE_COLUMNS, 0.0f);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const StrandShape& s = shapes[i];
    require(s.from >= 0 && s.from < s.to, i, "start of its part", s.from, "at least 0 and below its end");
    require(s.to <= 1, i, "end of its part", s.to, "at most 1");
    require(s.width_end >= 0 && s.width_end <= 1e7f, i, "relative width", s.width_end, "from 0 to 1e7");
    const auto set = [&](int column, float value) {
      table[(i / slice * SHAPE_COLUMNS + std::size_t(column)) * slice + i % slice] = value;
    };
    set(SHAPE_FROM, s.from);
    set(SHAPE_TO, s.to);
    set(SHAPE_WIDTH_END, s.width_end);
    for (int point = 0; point < 3; ++point)
      for (int axis = 0; axis < 3; ++axis) {
        const float value = s.offset[std::size_t(point)][axis];
        require(std::abs(value) <= 1000, i, "offset", value, "from -1000 to 1000");
        set(SHAPE_OFFSET + 3 * point + axis, value);
      }
  }
  return table;
}

}  // namespace pelage::strands
