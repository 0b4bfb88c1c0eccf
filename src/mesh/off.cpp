#include "mesh/polygon_soup.h"
#include "mesh/scan_point.h"

namespace tenon {

// OFF: the keyword, three counts, the points a line each, the faces a line each with their number of corners first.
// Colours and normals behind them are passed over.
Result<PolygonSoup> read_off(const MeshFile& file) {
  TextScanner scanner(file.path, file.bytes);
  if (!scanner.next_content_line() || scanner.word() != "OFF") {
    return scanner.error("this is no OFF file that can be read: it must begin with the word OFF");
  }
  long long counts[2] = {0, 0};
  std::string_view word = scanner.word();
  for (long long& count : counts) {
    if (word.empty()) {
      if (!scanner.next_content_line()) return scanner.error("the OFF file ends before its counts");
      word = scanner.word();
    }
    const auto number = to_integer(word);
    if (!number || *number < 0) return scanner.error("expected the number of points and of faces here");
    count = *number;
    word = scanner.word();
  }
  const auto too_few = [&](const char* what, long long wanted, std::size_t found) {
    return scanner.error("the OFF file says it has " + std::to_string(wanted) + ' ' + what + ", but only " +
                         std::to_string(found) + " are there");
  };
  PolygonSoup soup;
  for (long long i = 0; i < counts[0]; ++i) {
    if (!scanner.next_content_line()) return too_few("points", counts[0], soup.points.size());
    const auto p = to_vec3(scanner);
    if (!p) return scanner.error("a point needs three finite numbers");
    soup.points.push_back(*p);
  }
  std::vector<std::uint32_t> face;
  for (long long i = 0; i < counts[1]; ++i) {
    if (!scanner.next_content_line()) return too_few("faces", counts[1], soup.face_count());
    const auto size = to_integer(scanner.word());
    if (!size || *size < 3) return scanner.error("expected the number of corners of a face here, at least 3");
    face.clear();
    for (long long k = 0; k < *size; ++k) {
      const auto corner = to_integer(scanner.word());
      if (!corner)
        return scanner.error("this face says it has " + std::to_string(*size) + " corners; here one is missing");
      if (*corner < 0 || *corner >= counts[0]) {
        return scanner.error("there is no point " + std::to_string(*corner) + "; they are numbered from 0 to " +
                             std::to_string(counts[0] - 1));
      }
      face.push_back(static_cast<std::uint32_t>(*corner));
    }
    soup.add_face(face);
  }
  if (scanner.next_content_line()) {
    scanner.word();
    return scanner.error("the OFF file says it has " + std::to_string(counts[0]) + " points and " +
                         std::to_string(counts[1]) + " faces, but more follows here; correct its counts");
  }
  return soup;
}

}  // namespace tenon
