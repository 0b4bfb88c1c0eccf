#include "mesh/build_mesh.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "mesh/idle_parts.h"
#include "mesh/self_intersection.h"
#include "mesh/triangulate.h"
#include "primitive/mesh_edges.h"

namespace tenon {

namespace {

using Corners = TriangleMesh::Corners;

// Cutting a polygon into triangles takes time with the square of its corners.
constexpr std::size_t most_corners = 10'000;
// Features below 2^-40 of the largest coordinate are promised nowhere; what is less flat than float can say is bent.
constexpr double flatness = 0x1p-22;

std::string place(const Vec3& p) {
  const auto text = [](double value) {
    std::string shown = std::to_string(value);
    shown.erase(shown.find_last_not_of('0') + 1);
    if (shown.back() == '.') shown.pop_back();
    return shown;
  };
  return '[' + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ']';
}

std::string times(std::size_t n) {
  return n == 0 ? "not" : n == 1 ? "once" : std::to_string(n) + " times";
}

/// Vertices by their coordinates: each place once.
class Welder {
 public:
  explicit Welder(std::vector<Vec3>& vertices) : vertices_(vertices) {}

  std::uint32_t vertex_at(const Vec3& p) {
    // -0 is 0.
    const Vec3 key = p + Vec3{};
    const auto [found, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(key);
    return found->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3& p) const {
      const std::hash<double> hash;
      return (hash(p.x) * 1099511628211u ^ hash(p.y)) * 1099511628211u ^ hash(p.z);
    }
  };
  std::vector<Vec3>& vertices_;
  std::unordered_map<Vec3, std::uint32_t, Hash> known_;
};

class MeshBuilder {
 public:
  MeshBuilder(const PolygonSoup& soup, std::string what, bool hull)
      : soup_(soup), what_(std::move(what)), hull_(hull) {}

  Result<BuiltMesh> build() {
    if (Status status = take_triangles(); !status) return status.error();
    if (!hull_) drop_copies();
    if (!hull_) {
      if (const auto open = find_open_edges(mesh().triangles)) return not_closed(*open);
      face_outward();
      tell_overlaps();
    }
    return std::move(built_);
  }

 private:
  TriangleMesh& mesh() { return built_.mesh; }

  Status take_triangles() {
    Welder welder(mesh().vertices);
    std::vector<std::uint32_t> vertex_of;
    for (const Vec3& p : soup_.points) vertex_of.push_back(welder.vertex_at(p));
    const bool smooth = !soup_.corner_normals.empty();
    if (smooth) mesh().normals = soup_.normals;
    std::vector<Corners> pieces;
    std::vector<std::uint32_t> places;
    std::size_t without_area = 0, bent = 0;
    for (std::size_t f = 0; f < soup_.face_count(); ++f) {
      const auto face = soup_.face(f);
      if (face.size() > most_corners) {
        return Error{ErrorKind::input,
                     "face " + std::to_string(f) + " of " + what_ + " has " + std::to_string(face.size()) +
                         " corners; split faces of more than " + std::to_string(most_corners),
                     {}};
      }
      // Cut up by places in the face, so that each piece finds its corners' normals too.
      std::vector<Vec3> corners;
      places.resize(face.size());
      std::iota(places.begin(), places.end(), 0u);
      for (const std::uint32_t corner : face) corners.push_back(soup_.points[corner]);
      pieces.clear();
      const double deviation = triangulate(places, corners, pieces);
      if (deviation > flatness) ++bent;
      for (const Corners& piece : pieces) {
        Corners triangle, normals;
        for (std::size_t i = 0; i < 3; ++i) {
          triangle[i] = vertex_of[face[piece[i]]];
          if (smooth) normals[i] = soup_.corner_normals[soup_.begin_of(f) + piece[i]];
        }
        // A face that has shrunk to a line has two edges that cancel; without it as much is closed as with it.
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
          ++without_area;
          continue;
        }
        mesh().triangles.push_back(triangle);
        if (smooth) mesh().corner_normals.push_back(normals);
      }
    }
    if (smooth) fill_missing_normals();
    if (bent > 0) {
      built_.notes.push_back(what_ + " has " + std::to_string(bent) +
                             (bent == 1 ? " face that is" : " faces that are") +
                             " not flat, and cut into triangles; the solid depends on how that is done");
    }
    if (without_area > 0) note(without_area, "without area; they are left out");
    return success();
  }

  // A corner without a normal gets that of its triangle.
  void fill_missing_normals() {
    TriangleMesh& m = mesh();
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      for (std::uint32_t& n : m.corner_normals[t]) {
        if (n != PolygonSoup::no_normal && m.normals[n] != Vec3{}) continue;
        const auto [a, b, c] = m.corners(t);
        n = static_cast<std::uint32_t>(m.normals.size());
        m.normals.push_back(normalize(cross(b - a, c - a)));
      }
    }
  }

  void note(std::size_t count, const std::string& about) {
    built_.notes.push_back(what_ + " has " + std::to_string(count) + " triangle" + (count == 1 ? " " : "s ") + about);
  }

  // A face that stands there twice the same way is taken once, unless both close the mesh: parts that share a face.
  void drop_copies() {
    const TriangleMesh& m = mesh();
    std::vector<std::pair<Corners, std::size_t>> sorted;
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      Corners key = m.triangles[t];
      std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
      sorted.emplace_back(key, t);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> is_copy(m.triangles.size());
    std::size_t copies = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[i - 1].first) continue;
      is_copy[sorted[i].second] = true;
      ++copies;
    }
    if (copies == 0) return;
    TriangleMesh rest = m;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      if (is_copy[t]) continue;
      rest.triangles[kept] = m.triangles[t];
      if (!m.corner_normals.empty()) rest.corner_normals[kept] = m.corner_normals[t];
      ++kept;
    }
    rest.triangles.resize(kept);
    if (!rest.corner_normals.empty()) rest.corner_normals.resize(kept);
    if (find_open_edges(rest.triangles) && !find_open_edges(m.triangles)) return;
    mesh() = std::move(rest);
    note(copies, "that stand there already; each is taken once");
  }

  Error not_closed(const OpenEdges& open) {
    const std::string edge = "the edge from " + place(mesh().vertices[open.from]) + " to " +
                             place(mesh().vertices[open.to]) + " is used " + times(open.forth) +
                             " in this direction and " + times(open.back) + " in the other";
    const std::string count = std::to_string(open.count) + (open.count == 1 ? " edge" : " edges");
    const char* problem =
        open.forth >= 2 ? " is not closed, or its faces do not all face one way: " : " is not closed: ";
    return Error{ErrorKind::input,
                 what_ + problem + count + " of its triangles do not match; first, " + edge +
                     "; repair it, or use its bare surface with hull = true",
                 {}};
  }

  void face_outward() {
    TriangleMesh& m = mesh();
    if (m.triangles.empty()) return;
    // Six times the volume, seen from a vertex.
    const Vec3 origin = m.vertices[m.triangles[0][0]];
    double volume = 0;
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const auto [a, b, c] = m.corners(t);
      volume += dot(a - origin, cross(b - origin, c - origin));
    }
    if (volume == 0) {
      m.triangles.clear();
      built_.notes.push_back(what_ + " encloses no volume, or too little to compute with");
    }
    if (!(volume < 0)) return;
    for (Corners& corners : m.triangles) std::swap(corners[1], corners[2]);
    for (Corners& corners : m.corner_normals) std::swap(corners[1], corners[2]);
    for (Vec3& n : m.normals) n = -n;
  }

  // The solid is well defined all the same, but seldom what was meant where parts overlap unseen.
  void tell_overlaps() {
    const auto crossing = find_self_intersection(mesh());
    if (crossing) tell(*crossing);
    const IdleParts idle = find_idle_parts(mesh());
    mesh().winds_once = !crossing && idle.winds_once;
    tell(idle.inside_out, idle.part_count, "inside out, with no solid around; nothing is left of it: turn its faces");
    if (crossing) return;
    tell(idle.swallowed, idle.part_count,
         "within another, and faces outward, so that it adds nothing: turn its faces if it is meant as a hollow");
  }

  void tell(const SelfIntersection& crossing) {
    const bool many = crossing.count >= SelfIntersection::most_counted;
    built_.notes.push_back(what_ + " passes through itself: " + (many ? "at least " : "") +
                           std::to_string(crossing.count) + (crossing.count == 1 ? " pair" : " pairs") +
                           " of its triangles; first, triangles " + std::to_string(crossing.first) + " and " +
                           std::to_string(crossing.second) + " near " + place(crossing.place) +
                           "; the solid is the union of its parts, what the mesh winds around at least once");
  }

  void tell(const IdleParts::Parts& idle, std::size_t part_count, const std::string& about) {
    if (idle.count == 0) return;
    const Vec3& corner = mesh().vertices[mesh().triangles[idle.first][0]];
    built_.notes.push_back("of the " + std::to_string(part_count) + " parts of " + what_ + ' ' +
                           std::to_string(idle.count) + (idle.count == 1 ? " is " : " are each ") + about +
                           "; first, the part of triangle " + std::to_string(idle.first) + " at " + place(corner));
  }

  const PolygonSoup& soup_;
  std::string what_;
  bool hull_;
  BuiltMesh built_;
};

}  // namespace

Result<BuiltMesh> build_mesh(const PolygonSoup& soup, const std::string& what, bool hull) {
  return MeshBuilder(soup, what, hull).build();
}

}  // namespace tenon
