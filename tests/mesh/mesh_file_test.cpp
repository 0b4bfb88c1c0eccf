#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mesh/load_mesh.h"
#include "support/meshes.h"

namespace tenon {
namespace {

class MeshFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tenon-mesh-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Result<BuiltMesh> load(const std::string& name, const std::string& bytes, bool hull = false) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return load_mesh((folder_ / name).string(), hull);
  }
  // The message without the folder's name.
  std::string error(const std::string& name, const std::string& bytes) const {
    const auto loaded = load(name, bytes);
    if (loaded) return "none";
    const std::string text = format_error(loaded.error());
    return text.substr(text.find(name));
  }
  void expect_error(const std::string& name, const std::string& bytes, const std::string& part) const {
    const std::string text = error(name, bytes);
    EXPECT_NE(text.find(part), std::string::npos) << text;
  }

 private:
  std::filesystem::path folder_;
};

template <class T>
std::string raw(T value, bool swapped = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

const double points[4][3] = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string text_stl() {
  std::string text = "solid t\n";
  for (const auto& face : faces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : face) {
      text += "vertex";
      for (const double c : points[i]) text += ' ' + std::to_string(c);
      text += '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

std::string binary_stl() {
  std::string bytes = "solid, but binary";
  bytes.resize(80);
  bytes += raw(std::uint32_t{4});
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (const int i : face) {
      for (const double c : points[i]) bytes += raw(static_cast<float>(c));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string off(const std::string& face_lines = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", int count = 4) {
  return "OFF\n# a comment\n4 " + std::to_string(count) + " 6\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n" + face_lines;
}

std::string ply_header(const std::string& format, const std::string& type) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement vertex 4\nproperty " + type + " x\nproperty " +
         type + " y\nproperty " + type + " z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
}
std::string text_ply() {
  return ply_header("ascii", "double") + "0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}
std::string binary_ply(bool big) {
  std::string bytes = ply_header(big ? "binary_big_endian" : "binary_little_endian", "double");
  for (const auto& p : points) {
    for (const double c : p) bytes += raw(c, big);
  }
  for (const auto& face : faces) {
    bytes += '\3';
    for (const int i : face) bytes += raw(std::int32_t{i}, big);
  }
  return bytes;
}
const std::string obj =
    "# four\nmtllib none.mtl\no tetra\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf -4 -1 -2\nf 2/1 "
    "3/2 4/3\n";

TEST_F(MeshFileTest, EveryFormatGivesTheSameTetrahedron) {
  const std::pair<const char*, std::string> files[] = {
      {"a.stl", text_stl()},        {"b.STL", binary_stl()},     {"c.off", off()}, {"d.ply", text_ply()},
      {"e.ply", binary_ply(false)}, {"f.ply", binary_ply(true)}, {"g.obj", obj}};
  for (const auto& [name, bytes] : files) {
    const auto loaded = load(name, bytes);
    ASSERT_TRUE(loaded) << format_error(loaded.error());
    const TriangleMesh& mesh = loaded->mesh;
    EXPECT_EQ(mesh.vertices.size(), 4u) << name;
    EXPECT_EQ(mesh.triangles.size(), 4u) << name;
    EXPECT_TRUE(loaded->notes.empty()) << name;
    double largest = 0;
    for (const Vec3& v : mesh.vertices) largest = std::max(largest, v.x);
    // Every digit that the file has; a binary STL has those of a float.
    EXPECT_EQ(largest, std::string(name) == "b.STL" ? double{0.1f} : 0.1) << name;
  }
}

TEST_F(MeshFileTest, NormalsOfTheFileAreKept) {
  const auto loaded = load("n.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn -1 -1 -1\nvn 1 0 0\nf 1//1 3//2 2//2\n"
                           "f 1 2 4\nf 1 4 3\nf 2 3 4\n");
  ASSERT_TRUE(loaded) << format_error(loaded.error());
  const TriangleMesh& mesh = loaded->mesh;
  ASSERT_EQ(mesh.corner_normals.size(), 4u);
  EXPECT_EQ(mesh.normals[mesh.corner_normals[0][1]], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.normals[mesh.corner_normals[1][0]], (Vec3{0, -1, 0})) << "where there is none, the triangle's own";
}

TEST_F(MeshFileTest, WhatIsWrongIsSaidWithItsPlace) {
  expect_error("a.stl", "abcd", "it has 4 bytes, and the header alone takes 84");
  expect_error("a.stl", "", "it has 0 bytes");
  std::string stl = binary_stl();
  stl[80] = 9;
  expect_error("a.stl", stl, "says it has 9 triangles, but its 284 bytes hold 4");
  stl = binary_stl();
  stl.replace(84 + 12, 4, raw(std::nanf("")));
  expect_error("a.stl", stl, "triangle 0 of the STL file (at byte 84) has a corner that is not finite");
  expect_error("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 nan\n", "a.stl:4:12: error: a vertex needs three finite");
  expect_error("a.stl", "solid\nouter loop\nvertex 0 0 0\n", "ends within a facet");
  expect_error("a.off", "OFF\n4 4 0\n0 0 0\n", "says it has 4 points, but only 1 are there");
  expect_error("a.off", off("3 0 2 1\n", 1000000000), "says it has 1000000000 faces, but only 1 are there");
  expect_error("a.off", off("3 0 2 9\n", 1), "a.off:8:7: error: there is no point 9; they are numbered from 0 to 3");
  expect_error("a.obj", "v 0 0 0\nf 1 2 3\n", "a.obj:2:5: error: there is no point 2 before this line; there are 1");
  expect_error("a.obj", "v 0 0 1e999\n", "a.obj:1:7: error: 'v' needs three finite numbers");
  expect_error("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
               "property float z\nend_header\n1 2 3\n",
               "says it has 4000000000 vertex elements, but number 1 is cut off");
  std::string ply = binary_ply(false);
  ply.resize(ply.size() - 1);
  expect_error("a.ply", ply, "says it has 4 face elements, but number 3 is cut off");
  expect_error("a.off", off("3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n", 3),
               "a.off:11:1: error: the OFF file says it has 4 points and 3 faces, but more follows here");
  expect_error("a.ply", binary_ply(false) + "abc", "goes on behind the elements that its header counts");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty vec3 x\n",
               "a.ply:4:10: error: 'vec3' is no type");
  expect_error("a.dxf", "", "files that end in .stl, .obj, .off, .ply, .3mf or .amf, not '.dxf'");
}

TEST_F(MeshFileTest, WhatEnclosesNoSolidIsSaidWithCountAndFirstPlace) {
  expect_error("a.off", off("3 0 2 1\n3 0 1 3\n3 0 3 2\n", 3),
               "the mesh is not closed: 3 edges of its triangles do not match; first, the edge from [0, 0.1, 0] to "
               "[0.1, 0, 0] is used once in this direction and not in the other");
  expect_error("a.off", off("3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 3 2\n"), "do not all face one way: 3 edges");
  const auto surface = load("b.off", off("3 0 2 1\n3 0 1 3\n3 0 3 2\n", 3), true);
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->mesh.triangles.size(), 3u);
  // A T-junction: the edge from 1 to 2 has a vertex in its middle on one side only.
  const auto junction =
      error("c.off", "OFF\n5 5 0\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n1 1 0\n3 0 2 4\n3 0 4 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  EXPECT_NE(junction.find("3 edges"), std::string::npos) << junction;
}

TEST_F(MeshFileTest, WhatIsCertainIsMended) {
  const auto inside_out = load("a.off", off("3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n"));
  ASSERT_TRUE(inside_out);
  EXPECT_EQ(inside_out->mesh.triangles[0], (TriangleMesh::Corners{0, 2, 1}));
  const auto twice = load("b.off", off("3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 2 3 1\n3 0 0 1\n", 6));
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->mesh.triangles.size(), 4u);
  ASSERT_EQ(twice->notes.size(), 2u);
  EXPECT_EQ(twice->notes[0], "the mesh has 1 triangle without area; they are left out");
  EXPECT_EQ(twice->notes[1], "the mesh has 1 triangle that stand there already; each is taken once");
}

TEST_F(MeshFileTest, AMeshThatPassesThroughItselfIsToldSo) {
  // Two tetrahedra; the corner 4 of the second has passed through the face 1 2 3 of the first.
  const std::string two =
      "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.2 0.2 0.2\n1.2 0.2 0.2\n0.2 1.2 0.2\n0.2 0.2 1.2\n"
      "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n";
  const auto loaded = load("a.off", two);
  ASSERT_TRUE(loaded) << format_error(loaded.error());
  ASSERT_EQ(loaded->notes.size(), 1u);
  EXPECT_EQ(loaded->notes[0],
            "the mesh passes through itself: 3 pairs of its triangles; first, triangles 3 and 4 near [0.4, 0.4, 0.2]; "
            "the solid is the union of its parts, what the mesh winds around at least once");
}

std::string off_of(const TriangleMesh& mesh) {
  std::ostringstream off;
  off << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Vec3& v : mesh.vertices) off << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& [a, b, c] : mesh.triangles) off << "3 " << a << ' ' << b << ' ' << c << '\n';
  return off.str();
}

// A part that faces the wrong way would vanish unsaid, for all its edges match.
TEST_F(MeshFileTest, PartsThatAddNothingAreTold) {
  const auto inside_out = [](TriangleMesh mesh) {
    for (TriangleMesh::Corners& corners : mesh.triangles) std::swap(corners[1], corners[2]);
    return mesh;
  };
  const auto notes = [&](const TriangleMesh& mesh) {
    const auto loaded = load("a.off", off_of(mesh));
    EXPECT_TRUE(loaded);
    return loaded ? loaded->notes : std::vector<std::string>{};
  };
  using Notes = std::vector<std::string>;
  const TriangleMesh box = meshes::box({0, 0, 0}, {4, 4, 4});
  const TriangleMesh within = meshes::box({1, 1, 1}, {2, 2, 2}), beside = meshes::box({5, 1, 1}, {6, 2, 2});
  EXPECT_EQ(notes(meshes::together(box, beside)), Notes{});
  EXPECT_EQ(notes(meshes::together(box, inside_out(within))), Notes{});
  EXPECT_EQ(
      notes(meshes::together(box, within)),
      Notes{"of the 2 parts of the mesh 1 is within another, and faces outward, so that it adds nothing: turn its "
            "faces if it is meant as a hollow; first, the part of triangle 12 at [1, 1, 1]"});
  EXPECT_EQ(notes(meshes::together(meshes::together(box, inside_out(beside)), inside_out(within))),
            Notes{"of the 3 parts of the mesh 1 is inside out, with no solid around; nothing is left of it: turn its "
                  "faces; first, the part of triangle 12 at [5, 1, 1]"});
  // The part that is larger decides which way is outward.
  EXPECT_EQ(notes(meshes::together(beside, inside_out(box))),
            Notes{"of the 2 parts of the mesh 1 is inside out, with no solid around; nothing is left of it: turn its "
                  "faces; first, the part of triangle 0 at [5, 1, 1]"});
  // A hollow that touches the face above it, a solid in a hollow, and one beside a face.
  EXPECT_EQ(notes(meshes::together(box, inside_out(meshes::box({1, 1, 2}, {2, 2, 4})))), Notes{});
  EXPECT_EQ(notes(meshes::together(meshes::together(box, inside_out(meshes::box({1, 1, 1}, {3, 3, 3}))), within)),
            Notes{});
  EXPECT_EQ(notes(meshes::together(box, meshes::box({4, 1, 1}, {5, 2, 2}))), Notes{});
}

// Both need the face, though it stands there twice.
TEST_F(MeshFileTest, PartsThatShareAFaceStayClosed) {
  TriangleMesh both = meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({0, 0, 0}, {1, 1, 2}));
  const auto loaded = load("a.off", off_of(both));
  ASSERT_TRUE(loaded) << format_error(loaded.error());
  EXPECT_EQ(loaded->mesh.triangles.size(), 24u);
  ASSERT_EQ(loaded->notes.size(), 1u);
  EXPECT_EQ(loaded->notes[0].find("the mesh passes through itself: "), 0u);
}

TEST_F(MeshFileTest, AMeshWithoutVolumeIsToldSo) {
  const auto loaded = load("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->mesh.triangles.empty());
  EXPECT_EQ(loaded->notes, std::vector<std::string>{"the mesh encloses no volume, or too little to compute with"});
}

// Boxes whose faces and edges coincide where they overlap.
TEST_F(MeshFileTest, BoxesThatOverlapByHalfOfOneAreTold) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  for (const Vec3& shift : {Vec3{0.5, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.5, 0.5, 0.5}, Vec3{0, 0, -0.5}}) {
    const auto loaded = load("a.off", off_of(meshes::together(box, meshes::scaled(box, {1, 1, 1}, shift))));
    ASSERT_TRUE(loaded);
    ASSERT_EQ(loaded->notes.size(), 1u);
    EXPECT_EQ(loaded->notes[0].find("the mesh passes through itself: "), 0u);
  }
}

}  // namespace
}  // namespace tenon
