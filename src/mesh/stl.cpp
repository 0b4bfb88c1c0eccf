#include <bit>
#include <cmath>

#include "mesh/byte_reader.h"
#include "mesh/polygon_soup.h"
#include "mesh/scan_point.h"

namespace tenon {

namespace {

// 80 bytes of anything, a count, and 50 bytes a triangle.
constexpr std::size_t header_size = 84, triangle_size = 50;

// Text begins with `solid`, but so do the headers of some binary files: those are as long as their count says.
bool is_text(const MeshFile& file) {
  const std::string_view bytes = file.bytes;
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos || bytes.substr(begin, 5) != "solid") return false;
  if (bytes.size() < header_size) return true;
  ByteReader reader(bytes.substr(header_size - 4), std::endian::little);
  if (header_size + std::uint64_t{triangle_size} * *reader.read<std::uint32_t>() == bytes.size()) return false;
  return bytes.find('\0') == std::string_view::npos;
}

Error binary_error(const MeshFile& file, const std::string& message) {
  return Error{ErrorKind::input, message, {file.path, 0, 0, {}}};
}

Result<PolygonSoup> read_binary(const MeshFile& file) {
  if (file.bytes.size() < header_size) {
    return binary_error(file, "this is no STL file: it has " + std::to_string(file.bytes.size()) +
                                  " bytes, and the header alone takes 84; export it again");
  }
  ByteReader reader(std::string_view(file.bytes).substr(header_size - 4), std::endian::little);
  const std::uint32_t count = *reader.read<std::uint32_t>();
  const std::size_t present = reader.left() / triangle_size;
  if (count != present || reader.left() % triangle_size != 0) {
    return binary_error(file, "the STL file says it has " + std::to_string(count) + " triangles, but its " +
                                  std::to_string(file.bytes.size()) + " bytes hold " + std::to_string(present) +
                                  (reader.left() % triangle_size != 0 ? " and a part of one" : "") +
                                  "; it is damaged or no STL file");
  }
  PolygonSoup soup;
  for (std::uint32_t t = 0; t < count; ++t) {
    for (int i = 0; i < 3; ++i) reader.read<float>();  // the normal, which follows from the corners
    std::uint32_t corners[3];
    for (std::uint32_t& corner : corners) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = *reader.read<float>();
      if (!std::isfinite(p.x + p.y + p.z)) {
        return binary_error(file, "triangle " + std::to_string(t) + " of the STL file (at byte " +
                                      std::to_string(header_size + std::size_t{t} * triangle_size) +
                                      ") has a corner that is not finite; repair the file");
      }
      corner = static_cast<std::uint32_t>(soup.points.size());
      soup.points.push_back(p);
    }
    soup.add_face(corners);
    reader.read<std::uint16_t>();
  }
  return soup;
}

Result<PolygonSoup> read_text(const MeshFile& file) {
  TextScanner scanner(file.path, file.bytes);
  PolygonSoup soup;
  std::vector<std::uint32_t> loop;
  bool in_loop = false;
  while (scanner.next_line()) {
    const std::string_view keyword = scanner.word();
    if (keyword.empty() || keyword == "solid" || keyword == "endsolid" || keyword == "facet" || keyword == "endfacet") {
      if (!in_loop) continue;
      return scanner.error("this loop of vertices has no 'endloop'; the STL file is damaged");
    }
    if (keyword == "outer") {
      if (in_loop) return scanner.error("this loop begins within another; the STL file is damaged");
      in_loop = true;
      loop.clear();
    } else if (keyword == "vertex") {
      if (!in_loop) return scanner.error("this vertex stands outside of a loop; the STL file is damaged");
      const auto p = to_vec3(scanner);
      if (!p) return scanner.error("a vertex needs three finite numbers");
      loop.push_back(static_cast<std::uint32_t>(soup.points.size()));
      soup.points.push_back(*p);
    } else if (keyword == "endloop") {
      if (!in_loop || loop.size() < 3) {
        return scanner.error("a facet needs three vertices, not " + std::to_string(in_loop ? loop.size() : 0));
      }
      soup.add_face(loop);
      in_loop = false;
    } else {
      return scanner.error("'" + TextScanner::printable(keyword) +
                           "' is no keyword of an STL file; expected facet, outer loop, vertex, endloop or endfacet");
    }
  }
  if (in_loop) return scanner.error("the STL file ends within a facet; it is cut off");
  return soup;
}

}  // namespace

Result<PolygonSoup> read_stl(const MeshFile& file) {
  return is_text(file) ? read_text(file) : read_binary(file);
}

}  // namespace tenon
