#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "base/text_scanner.h"
#include "mesh/polygon_soup.h"
#include "mesh/zip_package.h"
#include "tenon/math/affine3.h"

namespace tenon {

namespace {

// A package may say little and mean much: how often parts of it are used has an end.
constexpr std::size_t most_triangles = std::size_t{1} << 26;
constexpr int deepest = 32;

constexpr const char* model_type = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

Error at_file(const MeshFile& file, const std::string& message) {
  return Error{ErrorKind::input, message, {file.path, 0, 0, {}}};
}

std::optional<Vec3> coordinates(const pugi::xml_node& vertex) {
  Vec3 p;
  const char* const names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto number = to_number(vertex.attribute(names[axis]).value());
    if (!number) return std::nullopt;
    p[axis] = *number;
  }
  return p;
}

// Twelve numbers, the columns of the map one after another. The identity where there are none.
std::optional<Affine3> transform_of(const pugi::xml_node& node) {
  Affine3 map;
  const pugi::xml_attribute attribute = node.attribute("transform");
  if (!attribute) return map;
  const std::string text = attribute.value(), path;
  TextScanner scanner(path, text);
  if (!scanner.next_line()) return std::nullopt;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      const auto number = to_number(scanner.word());
      if (!number) return std::nullopt;
      map.m[row][column] = *number;
    }
  }
  return map;
}

/// Gathers what the items of a model's <build> place.
class ModelReader {
 public:
  ModelReader(const MeshFile& file, const pugi::xml_node& model) : file_(file), model_(model) {
    for (const pugi::xml_node& object : model.child("resources").children("object")) {
      objects_.emplace(object.attribute("id").value(), object);
    }
  }

  Result<PolygonSoup> read() {
    for (const pugi::xml_node& item : model_.child("build").children("item")) {
      if (Status status = place(item, Affine3{}, 0); !status) return status.error();
    }
    if (soup_.face_count() == 0) {
      return at_file(file_, "the 3MF file builds no triangles: its <build> has no item with a mesh");
    }
    return std::move(soup_);
  }

 private:
  // An item or a component: an object, somewhere.
  Status place(const pugi::xml_node& reference, const Affine3& outer, int depth) {
    const std::string id = reference.attribute("objectid").value();
    const auto found = objects_.find(id);
    if (found == objects_.end()) {
      return at_file(file_, "the 3MF file places object '" + TextScanner::printable(id) + "', which it does not have");
    }
    if (depth > deepest) {
      return at_file(file_, "the components of the 3MF file nest deeper than " + std::to_string(deepest) +
                                " levels; object '" + TextScanner::printable(id) + "' may contain itself");
    }
    const auto inner = transform_of(reference);
    if (!inner) {
      return at_file(file_, "the transform of object '" + TextScanner::printable(id) +
                                "' in the 3MF file is not twelve finite numbers");
    }
    const Affine3 map = outer * *inner;
    const pugi::xml_node object = found->second;
    if (const pugi::xml_node mesh = object.child("mesh")) return add_mesh(mesh, map, id);
    for (const pugi::xml_node& component : object.child("components").children("component")) {
      // A package of nothing but references would otherwise take time without end.
      if (++places_ > most_triangles) return too_many();
      if (Status status = place(component, map, depth + 1); !status) return status;
    }
    return success();
  }

  Status add_mesh(const pugi::xml_node& mesh, const Affine3& map, const std::string& id) {
    const std::string of_object = " of object '" + TextScanner::printable(id) + "' in the 3MF file";
    const std::size_t first = soup_.points.size();
    for (const pugi::xml_node& vertex : mesh.child("vertices").children("vertex")) {
      const auto p = coordinates(vertex);
      if (!p) {
        return at_file(file_, "vertex " + std::to_string(soup_.points.size() - first) + of_object +
                                  " needs x, y and z, three finite numbers");
      }
      const Vec3 placed = map.point(*p);
      if (!std::isfinite(dot(placed, {0, 0, 0}))) {
        return at_file(file_, "vertex " + std::to_string(soup_.points.size() - first) + of_object +
                                  " is not finite where it is placed");
      }
      soup_.points.push_back(placed);
      if (soup_.points.size() > most_triangles) return too_many();
    }
    const std::size_t count = soup_.points.size() - first;
    // A map that mirrors turns the triangles inside out.
    const bool mirrors = map.determinant() < 0;
    std::size_t number = 0;
    for (const pugi::xml_node& triangle : mesh.child("triangles").children("triangle")) {
      std::array<std::uint32_t, 3> corners{};
      const char* const names[] = {"v1", "v2", "v3"};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto corner = to_integer(triangle.attribute(names[i]).value());
        if (!corner || *corner < 0 || *corner >= static_cast<long long>(count)) {
          return at_file(file_, "triangle " + std::to_string(number) + of_object +
                                    " needs v1, v2 and v3, numbers from 0 to " + std::to_string(count) + " - 1");
        }
        corners[i] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(*corner));
      }
      if (mirrors) std::swap(corners[1], corners[2]);
      soup_.add_face(corners);
      ++number;
      if (soup_.face_count() > most_triangles) return too_many();
    }
    return success();
  }

  Error too_many() const {
    return at_file(file_, "the 3MF file places more than " + std::to_string(most_triangles) +
                              " points, triangles or components; split it");
  }

  const MeshFile& file_;
  pugi::xml_node model_;
  std::map<std::string, pugi::xml_node> objects_;
  PolygonSoup soup_;
  std::size_t places_ = 0;
};

// The part that the package's relations name as its model.
std::string find_model(const ZipPackage& package) {
  const auto relations = package.read("_rels/.rels");
  pugi::xml_document document;
  if (relations && document.load_buffer(relations->data(), relations->size())) {
    for (const pugi::xml_node& relation : document.child("Relationships").children("Relationship")) {
      if (relation.attribute("Type").value() != std::string_view(model_type)) continue;
      std::string target = relation.attribute("Target").value();
      if (target.starts_with('/')) target.erase(0, 1);
      return target;
    }
  }
  return "3D/3dmodel.model";
}

}  // namespace

// 3MF Core Specification 1.3. Coordinates stay as they are, whatever the file's unit.
Result<PolygonSoup> read_3mf(const MeshFile& file) {
  const ZipPackage package(file);
  if (!package.is_open()) return at_file(file, "this is no 3MF file: it is no ZIP archive, or a damaged one");
  const std::string name = find_model(package);
  const auto model = package.read(name);
  if (!model) {
    return at_file(file, "the 3MF file has no model that can be read: the part '" + TextScanner::printable(name) +
                             "' is missing, damaged or larger than 1 GiB");
  }
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(model->data(), model->size());
  if (!parsed) {
    return at_file(file, "the model of the 3MF file is no XML: " + std::string(parsed.description()) + " (at byte " +
                             std::to_string(parsed.offset) + " of '" + TextScanner::printable(name) + "')");
  }
  const pugi::xml_node root = document.child("model");
  if (!root) return at_file(file, "the 3MF file has no <model>");
  return ModelReader(file, root).read();
}

}  // namespace tenon
