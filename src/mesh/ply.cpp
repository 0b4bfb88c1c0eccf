#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/text_scanner.h"
#include "mesh/byte_reader.h"
#include "mesh/polygon_soup.h"

namespace tenon {

namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Scalar> to_scalar(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (name == names[i][0] || name == names[i][1]) return static_cast<Scalar>(i);
  }
  return std::nullopt;
}

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, little, big };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

Result<Header> read_header(TextScanner& scanner) {
  Header header;
  if (!scanner.next_line() || scanner.word() != "ply") {
    return scanner.error("this is no PLY file: its first line must be 'ply'");
  }
  bool has_format = false;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword == "end_header") {
      if (!has_format) return scanner.error("the header has no line 'format'");
      return header;
    }
    if (keyword == "format") {
      const std::string_view format = scanner.word();
      has_format = true;
      if (format == "binary_little_endian") {
        header.encoding = Encoding::little;
      } else if (format == "binary_big_endian") {
        header.encoding = Encoding::big;
      } else if (format != "ascii") {
        return scanner.error("the format must be ascii, binary_little_endian or binary_big_endian");
      }
    } else if (keyword == "element") {
      Element element;
      element.name = scanner.word();
      const auto count = to_integer(scanner.word());
      if (!count || *count < 0) return scanner.error("an element needs its count, a whole number from 0");
      element.count = static_cast<std::uint64_t>(*count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) return scanner.error("this property belongs to no element");
      Property property;
      std::string_view type = scanner.word();
      if (type == "list") {
        property.count_type = to_scalar(scanner.word());
        if (!property.count_type || *property.count_type >= Scalar::float32) {
          return scanner.error("the length of a list must be of an integer type");
        }
        type = scanner.word();
      }
      const auto scalar = to_scalar(type);
      if (!scalar) return scanner.error("'" + TextScanner::printable(type) + "' is no type of a PLY file");
      property.type = *scalar;
      property.name = scanner.word();
      header.elements.back().properties.push_back(std::move(property));
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      return scanner.error("'" + TextScanner::printable(keyword) + "' is no keyword of a PLY header");
    }
  }
  return scanner.error("the header has no end: the line 'end_header' is missing");
}

/// Numbers of the body, one after another, whatever their encoding. A double holds each type exactly.
class Body {
 public:
  Body(const MeshFile& file, TextScanner& scanner, Encoding encoding)
      : file_(file),
        text_(encoding == Encoding::text ? &scanner : nullptr),
        begin_(scanner.behind_line()),
        bytes_(std::string_view(file.bytes).substr(begin_),
               encoding == Encoding::big ? std::endian::big : std::endian::little) {}

  std::optional<double> number(Scalar type) {
    if (text_ != nullptr) return text_number();
    switch (type) {
      case Scalar::int8:
        return bytes_.read<std::int8_t>();
      case Scalar::uint8:
        return bytes_.read<std::uint8_t>();
      case Scalar::int16:
        return bytes_.read<std::int16_t>();
      case Scalar::uint16:
        return bytes_.read<std::uint16_t>();
      case Scalar::int32:
        return bytes_.read<std::int32_t>();
      case Scalar::uint32:
        return bytes_.read<std::uint32_t>();
      case Scalar::float32:
        return bytes_.read<float>();
      case Scalar::float64:
        return bytes_.read<double>();
    }
    return std::nullopt;
  }

  /// Whether nothing is left but blanks.
  bool is_at_end() {
    if (text_ != nullptr) return text_->word_across_lines().empty();
    for (ByteReader rest = bytes_; const auto byte = rest.read<char>();) {
      if (*byte != ' ' && *byte != '\n' && *byte != '\r' && *byte != '\0') return false;
    }
    return true;
  }

  Error error(const std::string& message) const {
    if (text_ != nullptr) return text_->error(message);
    return Error{ErrorKind::input,
                 message + " (at byte " + std::to_string(begin_ + bytes_.position()) + ")",
                 {file_.path, 0, 0, {}}};
  }

 private:
  std::optional<double> text_number() {
    const std::string_view word = text_->word_across_lines();
    // What is not finite stands there as a word; the caller finds out what it means.
    if (word == "nan" || word == "inf" || word == "-inf") return std::nan("");
    return to_number(word);
  }

  const MeshFile& file_;
  TextScanner* text_;
  std::size_t begin_;
  ByteReader bytes_;
};

class PlyReader {
 public:
  PlyReader(const Header& header, Body body) : header_(header), body_(body) {}

  Result<PolygonSoup> read() {
    for (const Element& element : header_.elements) {
      Status status = element.name == "vertex" ? read_vertices(element)
                      : element.name == "face" ? read_faces(element)
                                               : pass_over(element);
      if (!status) return status.error();
    }
    if (!body_.is_at_end()) {
      return body_.error("the PLY file goes on behind the elements that its header counts; correct the counts");
    }
    if (soup_.face_count() == 0) return body_.error("the PLY file has no faces; a cloud of points makes no solid");
    for (const std::uint32_t corner : soup_.corners) {
      if (corner < soup_.points.size()) continue;
      return body_.error("a face of the PLY file names vertex " + std::to_string(corner) + ", but there are only " +
                         std::to_string(soup_.points.size()) + ", counted from 0");
    }
    if (!soup_.normals.empty()) soup_.corner_normals = soup_.corners;
    return std::move(soup_);
  }

 private:
  Error cut_off(const Element& element, std::uint64_t i) const {
    return body_.error("the PLY file says it has " + std::to_string(element.count) + ' ' + element.name +
                       " elements, but number " + std::to_string(i) + " is cut off or no number");
  }

  Status read_vertices(const Element& element) {
    constexpr std::array<std::string_view, 6> names{"x", "y", "z", "nx", "ny", "nz"};
    std::array<double, 6> values{};
    std::vector<double*> targets;
    std::size_t places = 0, normals = 0;
    for (const Property& property : element.properties) {
      const auto at = std::find(names.begin(), names.end(), property.name) - names.begin();
      targets.push_back(at < 6 && !property.count_type ? &values[static_cast<std::size_t>(at)] : nullptr);
      if (targets.back() != nullptr) ++(at < 3 ? places : normals);
    }
    if (places != 3) return body_.error("the vertices of the PLY file need the properties x, y and z, once each");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < targets.size(); ++k) {
        if (!read_property(element.properties[k], targets[k])) return cut_off(element, i);
      }
      const Vec3 p{values[0], values[1], values[2]}, n{values[3], values[4], values[5]};
      if (!std::isfinite(dot(p, {0, 0, 0}))) {
        return body_.error("vertex " + std::to_string(i) + " of the PLY file is not finite; repair the file");
      }
      soup_.points.push_back(p);
      // A normal that is none is passed over: it only shades.
      if (normals == 3) soup_.normals.push_back(std::isfinite(dot(n, {0, 0, 0})) ? n : Vec3{});
    }
    return success();
  }

  Status read_faces(const Element& element) {
    const auto is_corners = [](const Property& p) {
      return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_corners)) {
      return body_.error("the faces of the PLY file need the property list vertex_indices");
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        face_.clear();
        if (!read_property(property, nullptr, is_corners(property) ? &face_ : nullptr)) return cut_off(element, i);
        if (!is_corners(property)) continue;
        if (face_.size() < 3) {
          return body_.error("face " + std::to_string(i) +
                             " of the PLY file has fewer than three corners, or one that is "
                             "no whole number from 0");
        }
        soup_.add_face(face_);
      }
    }
    return success();
  }

  Status pass_over(const Element& element) {
    if (element.properties.empty()) return success();
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (!read_property(property, nullptr)) return cut_off(element, i);
      }
    }
    return success();
  }

  // A value, or a list of corners; a list with a bad corner is left empty.
  bool read_property(const Property& property, double* value, std::vector<std::uint32_t>* list = nullptr) {
    if (!property.count_type) {
      const auto number = body_.number(property.type);
      if (number && value != nullptr) *value = *number;
      return number.has_value();
    }
    const auto count = body_.number(*property.count_type);
    if (!count || !(*count >= 0)) return false;
    bool good = true;
    for (double i = 0; i < *count; ++i) {
      const auto number = body_.number(property.type);
      if (!number) return false;
      good = good && *number >= 0 && *number < 4294967295.0 && *number == std::floor(*number);
      if (good && list != nullptr) list->push_back(static_cast<std::uint32_t>(*number));
    }
    if (!good && list != nullptr) list->clear();
    return true;
  }

  const Header& header_;
  Body body_;
  PolygonSoup soup_;
  std::vector<std::uint32_t> face_;
};

}  // namespace

Result<PolygonSoup> read_ply(const MeshFile& file) {
  TextScanner scanner(file.path, file.bytes);
  const Result<Header> header = read_header(scanner);
  if (!header) return header.error();
  return PlyReader(*header, Body(file, scanner, header->encoding)).read();
}

}  // namespace tenon
