// Checks PLY files and reduces them to points and faces. CGAL's reader does not check the header: it
// allocates memory for lists of any length that the file states, and crashes on properties of unexpected
// types.
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include "harness/mesh/mesh_text.hpp"
#include "harness/mesh/soup.hpp"

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

struct Property {
  std::string_view name;
  Type type;
  std::optional<Type> count = {};  ///< for lists: type of the number that states the list's length
  bool kept = false;               ///< true for x, y, z and for the list of a face's corners
};

struct Element {
  std::string_view name;
  std::int64_t count;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { text, little_endian, big_endian } format = Format::text;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< size of the header in bytes
};

constexpr std::string_view formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name), lines_(bytes) {}

  Header read() {
    if (!lines_.next(line_) || Words(line_).next() != "ply") fail("the line must be 'ply'");
    if (!lines_.next(line_)) fail("the header has no end_header");
    read_format();
    while (lines_.next(line_)) {
      Words words(line_);
      const std::string_view word = words.next();
      if (word == "end_header") {
        header_.size = std::size_t(line_.data() - bytes_.data()) + line_.size() + 1;
        choose();
        return std::move(header_);
      }
      if (word.empty()) fail("the header has an empty line");
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
    if (!count || *count < 0 || *count > std::int64_t(bytes_.size()))
      fail(fmt::format("the number of elements is missing, negative or too large for a file of {} bytes",
                       bytes_.size()));
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

  // Marks the properties that the reduced file keeps: the first x, y and z of the vertices, and the corners
  // of the faces.
  void choose() {
    Element &vertex = one("vertex"), &face = one("face");
    for (const std::string_view name : {"x", "y", "z"}) {
      const auto found = std::ranges::find(vertex.properties, name, &Property::name);
      if (found == vertex.properties.end() || found->count || found->type.whole())
        detail::fail(name_, 0, fmt::format("the vertices have no property {} of type float or double", name));
      found->kept = true;
    }
    for (const std::string_view name : {"vertex_indices", "vertex_index"}) {
      const auto found = std::ranges::find(face.properties, name, &Property::name);
      if (found == face.properties.end() || !found->count || !found->type.whole() || found->type.bytes != 4)
        continue;
      found->kept = true;
      return;
    }
    detail::fail(name_, 0, "the faces have no list vertex_indices of type int or uint");
  }

  Element& one(std::string_view name) {
    Element* found = nullptr;
    for (Element& element : header_.elements) {
      if (element.name != name) continue;
      if (found != nullptr) detail::fail(name_, 0, fmt::format("two elements have the name {}", name));
      found = &element;
    }
    if (found == nullptr || found->count == 0) detail::fail(name_, 0, "the file contains no faces");
    return *found;
  }

  Type type_of(std::string_view name) const {
    for (const Type& type : types)
      if (type.name == name || type.other_name == name) return type;
    fail(fmt::format("the type {} is unknown", shown(name)));
  }

  std::string_view bytes_;
  const std::string& name_;
  Lines lines_;
  std::string_view line_;
  Header header_;
};

/// Returns the header of the reduced PLY file, which contains only the properties marked as `kept`.
std::string kept_header(const Header& header) {
  std::string text = fmt::format("ply\nformat {} 1.0\n", formats[int(header.format)]);
  for (const Element& element : header.elements) {
    if (element.name != "vertex" && element.name != "face") continue;
    text += fmt::format("element {} {}\n", element.name, element.count);
    for (const Property& property : element.properties) {
      if (!property.kept) continue;
      const std::string list = property.count ? fmt::format("list {} ", property.count->name) : "";
      text += fmt::format("property {}{} {}\n", list, property.type.name, property.name);
    }
  }
  return text + "end_header\n";
}

/// Reads the body (the values after the header) of a PLY file, and copies the values of the properties marked
/// as `kept` to the text of the reduced file.
class Body {
 public:
  Body(std::string_view bytes, const Header& header, const std::string& name)
      : rest_(bytes.substr(std::min(header.size, bytes.size()))), header_(header), name_(name) {}

  void copy(std::string& kept) {
    for (const Element& element : header_.elements)
      for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i)
        for (const Property& property : element.properties) {
          element_ = element.name.substr(0, 20);
          number_ = i + 1;
          copy(property, kept);
        }
  }

 private:
  void copy(const Property& property, std::string& kept) {
    const std::string_view before = rest_;
    const std::int64_t count = property.count ? whole(*property.count) : 1;
    // Each value needs at least one byte, so a list cannot have more values than the file has bytes left.
    if (property.count && (count < 0 || std::uint64_t(count) > rest_.size()))
      fail(fmt::format("a list of {} values does not fit into the rest of the file, which has {} bytes",
                       count, rest_.size()));
    if (header_.format != Header::Format::text)
      take(std::size_t(count) * property.type.bytes);
    else
      for (std::int64_t k = 0; k < count; ++k)
        property.type.whole() ? void(whole(property.type)) : need_number();
    if (!property.kept) return;
    kept += before.substr(0, before.size() - rest_.size());
    if (header_.format == Header::Format::text) kept += ' ';
  }

  std::int64_t whole(const Type& type) {
    const int bits = int(8 * type.bytes);
    const bool negative = type.kind == Kind::whole;
    if (header_.format == Header::Format::text) {
      const std::string_view word = next_word();
      const auto value = detail::read<std::int64_t>(word);
      const std::int64_t most = (std::int64_t(1) << (negative ? bits - 1 : bits)) - 1;
      if (!value || *value > most || *value < (negative ? -most - 1 : 0))
        fail(fmt::format("found {}, but the value must be a {}", shown(word), type.name));
      return *value;
    }
    const std::string_view bytes = take(type.bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t place = header_.format == Header::Format::big_endian ? i : bytes.size() - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    const bool below_0 = negative && (value >> (bits - 1) & 1) != 0;
    return below_0 ? std::int64_t(value) - (std::int64_t(1) << bits) : std::int64_t(value);
  }

  void need_number() {
    const std::string_view word = next_word();
    if (!detail::read<double>(word))
      fail(fmt::format("found {}, but the value must be a number", shown(word)));
  }

  std::string_view next_word() {
    const std::size_t start = std::min(rest_.find_first_not_of(" \t\r\n\v\f"), rest_.size());
    rest_.remove_prefix(start);
    if (rest_.empty()) fail("the file is truncated");
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n\v\f"), rest_.size());
    return take(end);
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
};

}  // namespace

std::string check_ply(std::string_view bytes, const std::string& name) {
  const Header header = HeaderReader(bytes, name).read();
  std::string kept = kept_header(header);
  Body(bytes, header, name).copy(kept);
  return kept;
}

}  // namespace pelage::detail
