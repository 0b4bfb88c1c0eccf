#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "base/text_scanner.h"
#include "mesh/polygon_soup.h"
#include "mesh/zip_package.h"
#include "tenon/math/affine3.h"

namespace tenon {

namespace {

// A file may say little and mean much: how often objects are used has an end.
constexpr std::size_t most_triangles = std::size_t{1} << 26;
constexpr int deepest = 32;

/// Gathers the objects of a file where its constellations place them, and those that none places where they are.
class AmfReader {
 public:
  AmfReader(const MeshFile& file, const pugi::xml_node& amf) : file_(file) {
    for (const pugi::xml_node& object : amf.children("object")) add(object);
    for (const pugi::xml_node& constellation : amf.children("constellation")) add(constellation);
  }

  Result<PolygonSoup> read() {
    for (const auto& [id, node] : nodes_) {
      if (is_placed_.contains(id)) continue;
      if (Status status = place(id, {}, 0); !status) return status.error();
    }
    for (const auto& [id, node] : nodes_) {
      if (!is_reached_.contains(id)) return holds_itself(id);
    }
    if (soup_.face_count() == 0) return error("the AMF file has no triangles");
    return std::move(soup_);
  }

 private:
  Error error(const std::string& message) const { return Error{ErrorKind::input, message, {file_.path, 0, 0, {}}}; }
  Error too_many() const {
    return error("the AMF file places more than " + std::to_string(most_triangles) +
                 " points, triangles or instances; split it");
  }

  Error holds_itself(const std::string& id) const {
    return error("the constellations of the AMF file nest deeper than " + std::to_string(deepest) + " levels: '" +
                 TextScanner::printable(id) + "' is within one that holds itself");
  }

  void add(const pugi::xml_node& node) {
    nodes_.emplace(node.attribute("id").value(), node);
    for (const pugi::xml_node& instance : node.children("instance")) {
      is_placed_.emplace(instance.attribute("objectid").value());
    }
  }

  Status place(const std::string& id, const Affine3& map, int depth) {
    const auto found = nodes_.find(id);
    const std::string name = "'" + TextScanner::printable(id) + "'";
    if (found == nodes_.end()) return error("the AMF file places object " + name + ", which it does not have");
    if (depth > deepest) return holds_itself(id);
    is_reached_.emplace(id);
    for (const pugi::xml_node& mesh : found->second.children("mesh")) {
      if (Status status = add_mesh(mesh, map, name); !status) return status;
    }
    for (const pugi::xml_node& instance : found->second.children("instance")) {
      if (++places_ > most_triangles) return too_many();
      const auto inner = map_of(instance);
      if (!inner)
        return error("an instance in constellation " + name + " of the AMF file has a place that is no number");
      if (Status status = place(instance.attribute("objectid").value(), map * *inner, depth + 1); !status)
        return status;
    }
    return success();
  }

  // Turned around x, then y, then z, by degrees, and moved. What is not there is 0.
  static std::optional<Affine3> map_of(const pugi::xml_node& instance) {
    const char* const names[] = {"rx", "ry", "rz", "deltax", "deltay", "deltaz"};
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const pugi::xml_node node = instance.child(names[i]);
      if (!node) continue;
      const auto number = number_in(node);
      if (!number) return std::nullopt;
      values[i] = *number;
    }
    return Affine3::translate({values[3], values[4], values[5]}) * Affine3::rotate({values[0], values[1], values[2]});
  }

  static std::string_view text_of(const pugi::xml_node& node) {
    const std::string_view text = node.text().get(), space = " \t\r\n";
    const std::size_t first = text.find_first_not_of(space), last = text.find_last_not_of(space);
    return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
  }
  static std::optional<double> number_in(const pugi::xml_node& node) { return to_number(text_of(node)); }

  Status add_mesh(const pugi::xml_node& mesh, const Affine3& map, const std::string& name) {
    const std::string of_object = " of object " + name + " in the AMF file";
    const std::size_t first = soup_.points.size();
    for (const pugi::xml_node& vertex : mesh.child("vertices").children("vertex")) {
      const pugi::xml_node place = vertex.child("coordinates");
      const auto x = number_in(place.child("x")), y = number_in(place.child("y")), z = number_in(place.child("z"));
      const Vec3 p = x && y && z ? map.point({*x, *y, *z}) : Vec3{HUGE_VAL, 0, 0};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return error("vertex " + std::to_string(soup_.points.size() - first) + of_object +
                     " needs coordinates x, y and z, three finite numbers");
      }
      soup_.points.push_back(p);
      if (soup_.points.size() > most_triangles) return too_many();
    }
    const std::size_t count = soup_.points.size() - first;
    std::size_t number = 0;
    for (const pugi::xml_node& volume : mesh.children("volume")) {
      for (const pugi::xml_node& triangle : volume.children("triangle")) {
        std::array<std::uint32_t, 3> corners{};
        const char* const names[] = {"v1", "v2", "v3"};
        for (std::size_t i = 0; i < 3; ++i) {
          const auto corner = to_integer(text_of(triangle.child(names[i])));
          if (!corner || *corner < 0 || *corner >= static_cast<long long>(count)) {
            return error("triangle " + std::to_string(number) + of_object + " needs v1, v2 and v3, numbers from 0 to " +
                         std::to_string(count) + " - 1");
          }
          corners[i] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(*corner));
        }
        soup_.add_face(corners);
        ++number;
        if (soup_.face_count() > most_triangles) return too_many();
      }
    }
    return success();
  }

  const MeshFile& file_;
  std::map<std::string, pugi::xml_node> nodes_;  // objects and constellations, by their ids
  std::set<std::string> is_placed_, is_reached_;
  PolygonSoup soup_;
  std::size_t places_ = 0;
};

}  // namespace

// ISO/ASTM 52915:2016. Coordinates stay as they are, whatever the file's unit, and triangles flat, whatever the normals
// of their edges.
Result<PolygonSoup> read_amf(const MeshFile& file) {
  const auto at_file = [&](const std::string& message) {
    return Error{ErrorKind::input, message, {file.path, 0, 0, {}}};
  };
  // Plain text, or the one part of an archive.
  std::optional<std::string> unpacked;
  if (file.bytes.starts_with("PK")) {
    const ZipPackage package(file);
    if (package.is_open()) unpacked = package.read(package.first_name());
    if (!unpacked) return at_file("the AMF file is packed, and damaged or larger than 1 GiB");
  }
  const std::string& text = unpacked ? *unpacked : file.bytes;
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) {
    return at_file("the AMF file is no XML: " + std::string(parsed.description()) + " (at byte " +
                   std::to_string(parsed.offset) + ")");
  }
  const pugi::xml_node root = document.child("amf");
  if (!root) return at_file("this is no AMF file: it has no <amf>");
  return AmfReader(file, root).read();
}

}  // namespace tenon
