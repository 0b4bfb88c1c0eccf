#include "rays/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "csg/csg_tree.h"
#include "rays/chord_error.h"

namespace tenon::bench {

namespace {

using Json = nlohmann::json;

// The nearest depth of a leaf. What reaches behind the camera or past it is taken where the scene begins.
double nearest_depth(const BenchScene& scene, const Leaf& leaf) {
  const ScreenView& view = scene.camera.view();
  const Box3& b = leaf.bounds;
  double nearest = Box3::inf;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1) != 0 ? b.upper.x : b.lower.x, (i & 2) != 0 ? b.upper.y : b.lower.y,
                      (i & 4) != 0 ? b.upper.z : b.lower.z};
    nearest = std::min(nearest, dot(corner - view.eye, view.forward));
  }
  const double to_target = length(scene.scene.camera.at - scene.scene.camera.from);
  return std::max(nearest, 0.1 * to_target);
}

// The most a map stretches any direction: the square root of the largest eigenvalue of its product with its transpose,
// by power iteration, which converges from below and is within a thousandth after this many steps.
double largest_stretch(const Affine3& map) {
  Vec3 v{0.577, 0.578, 0.576};
  double stretch = 0;
  for (int i = 0; i < 64; ++i) {
    const Vec3 image = map.direction(v);
    stretch = length(image) / length(v);
    v = normalize(map.transposed_direction(image));
  }
  return stretch;
}

std::string_view operation_name(CsgOperation operation) {
  constexpr std::string_view names[] = {"leaf", "union", "intersection", "difference", "complement"};
  return names[static_cast<std::size_t>(operation)];
}

struct FieldJson {
  Json operator()(double v) const { return v; }
  Json operator()(bool v) const { return v; }
  Json operator()(const Vec3& v) const { return {v.x, v.y, v.z}; }
  // Kinds with such fields are refused by the mesh maker, which names them.
  template <class Other>
  Json operator()(const Other&) const {
    return {};
  }
};

Json leaf_json(const BenchScene& scene, const Leaf& leaf, int columns) {
  const PrimitiveStore& store = scene.scene.tree->primitives;
  const PrimitiveKind& kind = store.kind(leaf.primitive);
  const std::vector<FieldValue> values = store.values(leaf.primitive);
  Json fields = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) {
    fields[std::string(kind.fields[i].name)] = std::visit(FieldJson{}, values[i]);
  }
  const Affine3& map = leaf.placement.world_from_local();
  Json matrix = Json::array();  // column by column
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) matrix.push_back(map.m[row][column]);
    matrix.push_back(column == 3 ? 1 : 0);
  }
  const double error = chord_error(scene.camera.view().half_width, columns, nearest_depth(scene, leaf));
  return {{"kind", kind.name}, {"fields", fields}, {"matrix", matrix}, {"error", error / largest_stretch(map)}};
}

Error mesh_error(const std::string& what) {
  return {ErrorKind::machine, "making the mesh failed: " + what, {}};
}

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Result<TriangleMesh> parse_mesh(const std::string& bytes) {
  std::uint32_t counts[2] = {0, 0};
  if (bytes.size() < sizeof counts) return mesh_error("its file is too short");
  std::memcpy(counts, bytes.data(), sizeof counts);
  TriangleMesh mesh;
  mesh.vertices.resize(3 * std::size_t{counts[0]});
  mesh.triangles.resize(3 * std::size_t{counts[1]});
  const std::size_t vertex_bytes = mesh.vertices.size() * sizeof(float);
  const std::size_t index_bytes = mesh.triangles.size() * sizeof(unsigned);
  if (bytes.size() != sizeof counts + vertex_bytes + index_bytes) return mesh_error("its file has the wrong length");
  std::memcpy(mesh.vertices.data(), bytes.data() + sizeof counts, vertex_bytes);
  std::memcpy(mesh.triangles.data(), bytes.data() + sizeof counts + vertex_bytes, index_bytes);
  return mesh;
}

}  // namespace

std::string solid_json(const BenchScene& scene, int columns) {
  const CsgTree& tree = *scene.scene.tree;
  Json nodes = Json::array();
  for (const CsgNode& node : tree.nodes) {
    if (node.operation == CsgOperation::leaf) {
      nodes.push_back(leaf_json(scene, tree[node.leaf], columns));
      continue;
    }
    Json children = Json::array();
    for (const CsgNodeId child : tree.children_of(node)) children.push_back(child.get());
    nodes.push_back({{"operation", operation_name(node.operation)}, {"children", children}});
  }
  return Json{{"nodes", nodes}, {"root", tree.root.get()}}.dump();
}

double largest_error(const BenchScene& scene, int columns) {
  double largest = 0;
  for (const Leaf& leaf : scene.scene.tree->leaves) {
    largest = std::max(largest, chord_error(scene.camera.view().half_width, columns, nearest_depth(scene, leaf)));
  }
  return largest;
}

Result<MadeMesh> make_mesh(const BenchScene& scene, int columns, const std::string& folder) {
  const std::string base = folder + "/" + scene.name + "_" + std::to_string(columns);
  std::ofstream(base + ".json") << solid_json(scene, columns);
  const std::string line = "node bench/mesh/make_mesh.mjs '" + base + ".json' '" + base + ".bin'";
  std::FILE* program = popen(line.c_str(), "r");
  if (program == nullptr) return mesh_error("node cannot be started");
  char text[512] = "";
  const bool said = std::fgets(text, sizeof text, program) != nullptr;
  if (pclose(program) != 0 || !said) return mesh_error(line);
  Result<TriangleMesh> mesh = parse_mesh(read_file(base + ".bin"));
  if (!mesh) return mesh.error();
  const Json report = Json::parse(text, nullptr, false);
  if (!report.contains("cpu_seconds")) return mesh_error(line);
  return MadeMesh{std::move(*mesh), report["cpu_seconds"].get<double>()};
}

}  // namespace tenon::bench
