#include "mesh/polygon_soup.h"
#include "mesh/scan_point.h"

namespace tenon {

namespace {

/// Reads the points, normals and faces of a Wavefront OBJ file; materials, groups, texture coordinates, lines and
/// curves make no solid and are passed over.
class ObjReader {
 public:
  explicit ObjReader(const MeshFile& file) : scanner_(file.path, file.bytes) {}

  Result<PolygonSoup> read() {
    while (scanner_.next_content_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v" || keyword == "vn") {
        const auto v = to_vec3(scanner_);
        if (!v) return scanner_.error("'" + std::string(keyword) + "' needs three finite numbers");
        (keyword == "v" ? soup_.points : soup_.normals).push_back(*v);
      } else if (keyword == "f") {
        if (Status status = read_face(); !status) return status.error();
      }
    }
    if (soup_.face_count() == 0) {
      return scanner_.error("there is no face in this OBJ file; a face is a line such as 'f 1 2 3'");
    }
    if (!has_normals_) {
      soup_.normals.clear();
      soup_.corner_normals.clear();
    }
    return std::move(soup_);
  }

 private:
  // Counted from 1, or from -1 backwards.
  Result<std::uint32_t> index(std::string_view word, std::size_t count, const char* what) {
    const auto number = to_integer(word);
    if (!number) return scanner_.error("expected a corner here: the number of a point, such as 3, 3/1 or 3//2");
    const auto size = static_cast<long long>(count);
    const long long at = *number < 0 ? *number + size : *number - 1;
    if (*number == 0 || at < 0 || at >= size) {
      return scanner_.error("there is no " + std::string(what) + ' ' + std::to_string(*number) +
                            " before this line; there are " + std::to_string(count));
    }
    return static_cast<std::uint32_t>(at);
  }

  Status read_face() {
    face_.clear();
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      const std::size_t slash = word.find('/');
      const auto point = index(word.substr(0, slash), soup_.points.size(), "point");
      if (!point) return point.error();
      face_.push_back(*point);
      const std::size_t second = slash == std::string_view::npos ? slash : word.find('/', slash + 1);
      std::uint32_t normal = PolygonSoup::no_normal;
      if (second != std::string_view::npos && second + 1 < word.size()) {
        const auto found = index(word.substr(second + 1), soup_.normals.size(), "normal");
        if (!found) return found.error();
        normal = *found;
        has_normals_ = true;
      }
      soup_.corner_normals.push_back(normal);
    }
    if (face_.size() < 3) return scanner_.error("a face needs at least three corners");
    soup_.add_face(face_);
    return success();
  }

  TextScanner scanner_;
  PolygonSoup soup_;
  std::vector<std::uint32_t> face_;
  bool has_normals_ = false;
};

}  // namespace

Result<PolygonSoup> read_obj(const MeshFile& file) {
  return ObjReader(file).read();
}

}  // namespace tenon
