#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include "harness/mesh/read/formats.hpp"
#include "harness/mesh/read/text.hpp"

namespace pelage::detail {
namespace {

enum class Kind { whole, natural, real };  ///< natural: whole and not negative

struct Type {
  std::string_view name, other_name;
  std::size_t bytes;
  Kind kind;
  bool whole() const { return kind != Kind::real; }
};

constexpr std::array<Type, 8> types{{{"char", "int8", 1, Kind::whole},
                                     {"uchar", "uint8", 1, Kind::natural},
                                     {"short", "int16", 2, Kind::whole},
                                     {"ushort", "uint16", 2, Kind::natural},
                                     {"int", "int32", 4, Kind::whole},
                                     {"uint", "uint32", 4, Kind::natural},
                                     {"float", "float32", 4, Kind::real},
                                     {"double", "float64", 8, Kind::real}}};

/// What the reader does with a property.
enum class Use { none, x, y, z, u, v, corners, corner_uv, strips };

struct Property {
  std::string_view name;
  Type type;
  std::optional<Type> count = {};  ///< for lists: type of the number that states the list's length
  Use use = Use::none;
};

struct Element {
  std::string_view name;
  std::int64_t count;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { text, little_endian, big_endian } format = Format::text;
  std::vector<Element> elements;
  std::string_view body;  ///< the bytes after the header
};

constexpr std::string_view formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// Names of the properties, by which programs call the same value.
struct Names {
  Use use;
  std::string_view element;
  bool list;
  std::vector<std::string_view> names;
};

const std::vector<Names>& uses() {
  static const std::vector<Names> all{{Use::x, "vertex", false, {"x"}},
                                      {Use::y, "vertex", false, {"y"}},
                                      {Use::z, "vertex", false, {"z"}},
                                      {Use::u, "vertex", false, {"s", "u", "texture_u", "texture_s"}},
                                      {Use::v, "vertex", false, {"t", "v", "texture_v", "texture_t"}},
                                      {Use::corners, "face", true, {"vertex_indices", "vertex_index"}},
                                      {Use::corner_uv, "face", true, {"texcoord"}},
                                      {Use::strips, "tristrips", true, {"vertex_indices", "vertex_index"}}};
  return all;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name, bool with_uv)
      : size_(bytes.size()), name_(name), with_uv_(with_uv), lines_(bytes) {}

  Header read() {
    if (!lines_.next(line_) || Words(line_).next() != "ply") fail("the line must be 'ply'");
    if (!lines_.next(line_)) fail("the header has no end_header");
    read_format();
    while (lines_.next(line_)) {
      Words words(line_);
      const std::string_view word = words.next();
      if (word == "end_header") {
        header_.body = lines_.rest();
        choose();
        return std::move(header_);
      }
      if (word == "element") read_element(words);
      if (word == "property") read_property(words);
    }
    detail::fail(name_, 0, "the header has no end_header");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { detail::fail(name_, lines_.number(), what); }

  void read_format() {
    Words words(line_);
    const std::string_view word = words.next(), format = words.next(), version = words.next();
    if (word != "format" || version.empty()) fail("the line must be 'format ascii 1.0' or a binary format");
    const auto found = std::ranges::find(formats, format);
    if (found == std::end(formats)) fail(fmt::format("the format {} is unknown", shown(format)));
    header_.format = Header::Format(found - std::begin(formats));
  }

  void read_element(Words& words) {
    const std::string_view name = words.next();
    const auto count = detail::read<std::int64_t>(words.next());
    if (!count || *count < 0 || *count > std::int64_t(size_))
      fail(fmt::format("the number of elements is missing, negative or too large for a file of {} bytes",
                       size_));
    header_.elements.push_back({name, *count, {}});
  }

  void read_property(Words& words) {
    if (header_.elements.empty()) fail("a property stands before the first element");
    const std::string_view type = words.next();
    Property property;
    if (type == "list") {
      property.count = type_of(words.next());
      if (!property.count->whole()) fail("the length of a list must be a whole number");
      property.type = type_of(words.next());
    } else {
      property.type = type_of(type);
    }
    property.name = words.next();
    if (property.name.empty()) fail("the property has no name");
    header_.elements.back().properties.push_back(property);
  }

  /// Sets Property::use. The first property of each use counts.
  void choose() {
    for (const Names& names : uses()) {
      Element* element = find(names.element);
      const bool is_uv = names.use == Use::u || names.use == Use::v || names.use == Use::corner_uv;
      if (element == nullptr || (is_uv && !with_uv_)) continue;
      for (const std::string_view name : names.names) {
        const auto found = std::ranges::find(element->properties, name, &Property::name);
        if (found == element->properties.end() || found->count.has_value() != names.list) continue;
        found->use = names.use;
        break;
      }
    }
    const Element* vertex = find("vertex");
    if (vertex == nullptr || vertex->count == 0 || (count_of("face") == 0 && count_of("tristrips") == 0))
      detail::fail(name_, 0, "the file contains no faces");
    for (const Use use : {Use::x, Use::y, Use::z})
      if (!has(*vertex, use))
        detail::fail(name_, 0,
                     fmt::format("the vertices have no property {} that is a number",
                                 uses()[std::size_t(use) - 1].names.front()));
    for (const auto& [element, use] : {std::pair("face", Use::corners), {"tristrips", Use::strips}})
      if (const Element* faces = find(element); faces != nullptr && faces->count > 0 && !has(*faces, use))
        detail::fail(name_, 0, fmt::format("the element {} has no list vertex_indices", element));
    for (const Element& element : header_.elements)
      for (const Property& property : element.properties)
        if ((property.use == Use::corners || property.use == Use::strips) && !property.type.whole())
          detail::fail(name_, 0, fmt::format("the list {} must have whole numbers", property.name));
  }

  static bool has(const Element& element, Use use) {
    return std::ranges::find(element.properties, use, &Property::use) != element.properties.end();
  }

  std::int64_t count_of(std::string_view name) {
    const Element* element = find(name);
    return element == nullptr ? 0 : element->count;
  }

  Element* find(std::string_view name) {
    Element* found = nullptr;
    for (Element& element : header_.elements) {
      if (element.name != name) continue;
      if (found != nullptr) detail::fail(name_, 0, fmt::format("two elements have the name {}", name));
      found = &element;
    }
    return found;
  }

  Type type_of(std::string_view name) const {
    for (const Type& type : types)
      if (type.name == name || type.other_name == name) return type;
    fail(fmt::format("the type {} is unknown", shown(name)));
  }

  std::size_t size_;
  const std::string& name_;
  bool with_uv_;
  Lines lines_;
  std::string_view line_;
  Header header_;
};

/// Reads the body (the values after the header) of a PLY file.
class Body {
 public:
  Body(const Header& header, const std::string& name) : rest_(header.body), header_(header), name_(name) {}

  Soup read() {
    for (const Element& element : header_.elements)
      for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        element_ = element.name.substr(0, 20);
        number_ = i + 1;
        if (element.name == "vertex") soup_.point.emplace_back(0), uv_.emplace_back(0);
        if (element.name == "face") corner_uv_.clear();
        for (const Property& property : element.properties) read(property);
        if (element.name == "face") add_face();
      }
    for (std::size_t f = 0; f < soup_.polygon.size() && has_uv_; ++f) {
      auto& uv = soup_.uv.emplace_back();
      for (const std::uint32_t i : soup_.polygon[f]) uv.push_back(i < uv_.size() ? uv_[i] : glm::dvec2(0));
    }
    if (has_corner_uv_) soup_.uv = std::move(all_corner_uv_);
    return std::move(soup_);
  }

 private:
  void read(const Property& property) {
    if (!property.count) return use(property.use, number(property.type));
    const double length = number(*property.count);
    // Each value needs at least one byte, so a list cannot have more values than the file has bytes left.
    if (length < 0 || length > double(rest_.size()))
      fail(fmt::format("a list of {:.0f} values does not fit into the rest of the file, which has {} bytes",
                       length, rest_.size()));
    values_.clear();
    for (std::size_t k = 0; k < std::size_t(length); ++k) values_.push_back(number(property.type));
    if (property.use == Use::corners) corners_ = values_;
    if (property.use == Use::corner_uv) corner_uv_ = values_;
    if (property.use == Use::strips) add_strips();
  }

  void use(Use use, double value) {
    switch (use) {
      case Use::x:
        soup_.point.back().x = value;
        break;
      case Use::y:
        soup_.point.back().y = value;
        break;
      case Use::z:
        soup_.point.back().z = value;
        break;
      case Use::u:
        uv_.back().x = finite(value), has_uv_ = true;
        break;
      case Use::v:
        uv_.back().y = finite(value);
        break;
      default:
        break;
    }
  }

  double finite(double value) const {
    if (!(std::abs(value) <= largest_coordinate)) fail("a texture coordinate is not a number");
    return value;
  }

  /// Larger and negative indices are refused later, as check_soup() does for all formats.
  static std::uint32_t index(double value) {
    return value >= 0 && value < 4294967295.0 ? std::uint32_t(value) : 0xffffffffu;
  }

  void add_face() {
    auto& polygon = soup_.polygon.emplace_back();
    for (const double corner : corners_) polygon.push_back(index(corner));
    auto& uv = all_corner_uv_.emplace_back();
    if (corner_uv_.empty()) return;
    if (corner_uv_.size() != 2 * corners_.size())
      fail(
          fmt::format("{} texture coordinates for a face of {} corners", corner_uv_.size(), corners_.size()));
    has_corner_uv_ = true;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      uv.emplace_back(finite(corner_uv_[2 * k]), finite(corner_uv_[2 * k + 1]));
  }

  /// Adds the triangles of strips, each of which ends at an index -1. Every second triangle is turned.
  void add_strips() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (values_[i] < 0) begin = i + 1;
      if (i < begin + 2) continue;
      const bool odd = (i - begin) % 2 != 0;
      soup_.polygon.push_back(
          {index(values_[i - 2]), index(values_[odd ? i : i - 1]), index(values_[odd ? i - 1 : i])});
      all_corner_uv_.emplace_back();
    }
  }

  double number(const Type& type) {
    if (header_.format == Header::Format::text) return text_number(type);
    const std::string_view bytes = take(type.bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t place = header_.format == Header::Format::big_endian ? i : bytes.size() - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    if (type.kind == Kind::real)
      return type.bytes == 4 ? double(std::bit_cast<float>(std::uint32_t(value)))
                             : std::bit_cast<double>(value);
    const int bits = int(8 * type.bytes);
    const bool below_0 = type.kind == Kind::whole && (value >> (bits - 1) & 1) != 0;
    return below_0 ? double(std::int64_t(value) - (std::int64_t(1) << bits)) : double(value);
  }

  double text_number(const Type& type) {
    const std::string_view word = next_word();
    if (!type.whole()) {
      const auto value = detail::read<double>(word);
      if (!value) fail(fmt::format("found {}, but the value must be a number", shown(word)));
      return *value;
    }
    const int bits = int(8 * type.bytes);
    const bool negative = type.kind == Kind::whole;
    const auto value = detail::read<std::int64_t>(word);
    const std::int64_t most = (std::int64_t(1) << (negative ? bits - 1 : bits)) - 1;
    if (!value || *value > most || *value < (negative ? -most - 1 : 0))
      fail(fmt::format("found {}, but the value must be a {}", shown(word), type.name));
    return double(*value);
  }

  std::string_view next_word() {
    const std::string_view word = Words(rest_).next();
    if (word.empty()) fail("the file is truncated");
    rest_.remove_prefix(std::size_t(word.data() - rest_.data()) + word.size());
    return word;
  }

  std::string_view take(std::size_t count) {
    if (count > rest_.size()) fail("the file is truncated");
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }

  [[noreturn]] void fail(const std::string& what) const {
    detail::fail(name_, 0, fmt::format("{} {}: {}", element_, number_, what));
  }

  std::string_view rest_;
  const Header& header_;
  const std::string& name_;
  std::string_view element_;  // name of the element that is being read, for error messages
  std::int64_t number_ = 0;
  Soup soup_;
  std::vector<glm::dvec2> uv_;                          ///< of each vertex
  std::vector<std::vector<glm::dvec2>> all_corner_uv_;  ///< of each polygon; empty for polygons without
  bool has_uv_ = false, has_corner_uv_ = false;
  std::vector<double> values_, corners_, corner_uv_;  ///< a list; the lists of a face
};

}  // namespace

Soup read_ply(std::string_view bytes, const std::string& name, bool with_uv) {
  const Header header = HeaderReader(bytes, name, with_uv).read();
  return Body(header, name).read();
}

}  // namespace pelage::detail
